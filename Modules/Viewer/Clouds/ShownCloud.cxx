#include "ShownCloud.h"

#include "ClippedCloud.h"
#include "CloudAppearance.h"
#include "PolyDataAccess.h"
#include "ProgressiveOrder.h"
#include "SmpExecutor.h"
#include "vtkSplatMapper.h"

#include "Core/Resample/TransformedBounds.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <chrono>
#include <new>

namespace pointhaptics
{
namespace
{

/// A cloud this many times as wide as it is high may be terrain.
constexpr double kLowParts = 3.0;
/// Part of making a ShownCloud that is measuring; colours and sizes follow.
constexpr double kMeasuring = 0.9;

class AbortQuestion : public ProgressObserver
{
public:
  explicit AbortQuestion(const std::function<bool(double)>& goesOn)
    : goesOn_(goesOn)
  {
  }
  bool report(double part) override { return goesOn_(kMeasuring * part); }

private:
  const std::function<bool(double)>& goesOn_;
};

/// The arrays of @p cloud that a picture may need.
std::vector<vtkDataArray*> neededArrays(vtkPolyData* cloud, const ShownRequest& request)
{
  vtkPointData* data = cloud->GetPointData();
  std::vector<vtkDataArray*> arrays = { hasColors(cloud) ? data->GetScalars() : nullptr,
    request.ignoresIntensity ? nullptr : findArrayAnyCase(cloud, "intensity"),
    findArrayAnyCase(cloud, "classification"), findArrayAnyCase(cloud, "returnnumber"),
    data->GetArray(kFileArrayName) };
  for (const std::string& name : request.keptArrays())
  {
    const std::optional<ColorSource> source = findColorSource(cloud, name);
    arrays.push_back(source ? data->GetArray(source->array.c_str()) : nullptr);
  }
  std::sort(arrays.begin(), arrays.end());
  arrays.erase(std::unique(arrays.begin(), arrays.end()), arrays.end());
  arrays.erase(std::remove(arrays.begin(), arrays.end(), nullptr), arrays.end());
  return arrays;
}

/// The points @p drawn of @p cloud with these arrays; those of the cloud itself where all are drawn.
vtkSmartPointer<vtkPolyData> pick(
  vtkPolyData* cloud, const std::vector<std::uint32_t>& drawn, const ShownRequest& request)
{
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(cloud->GetPoints());
  result->GetFieldData()->ShallowCopy(cloud->GetFieldData());
  for (vtkDataArray* array : neededArrays(cloud, request))
  {
    const int index = result->GetPointData()->AddArray(array);
    if (array == cloud->GetPointData()->GetScalars() && hasColors(cloud))
    {
      result->GetPointData()->SetActiveAttribute(index, vtkDataSetAttributes::SCALARS);
    }
  }
  if (std::int64_t(drawn.size()) == cloud->GetNumberOfPoints())
  {
    return result;
  }
  vtkNew<vtkIdList> ids;
  ids->SetNumberOfIds(vtkIdType(drawn.size()));
  std::copy(drawn.begin(), drawn.end(), ids->GetPointer(0));
  return pointsOfCloud(result, ids);
}

/// True if @p colors need no array that @p points do not have.
bool fits(const CloudColors& colors, vtkPolyData* points)
{
  vtkPointData* data = points->GetPointData();
  return (colors.rule != ColorRule::Rgb || hasColors(points)) &&
    (colors.array.empty() || data->HasArray(colors.array.c_str())) &&
    (colors.intensity.empty() || data->HasArray(colors.intensity.c_str()));
}

void addColors(
  ShownCloud& shown, const ShownRequest& request, const NeighborQuery& query, const LocalShape& shape)
{
  shown.colors = request.colors && fits(*request.colors, shown.points)
    ? *request.colors
    : chooseColors(shown.points, query, shape, shown.look);
  if (const auto colors = makeColors(shown.points, shown.colors, shown.look))
  {
    colors->SetName(kLookColorName);
    shown.points->GetPointData()->AddArray(colors);
  }
}

} // namespace

std::vector<std::string> ShownRequest::keptArrays() const
{
  std::vector<std::string> names = { keptArray };
  for (const HiddenValues& each : hidden)
  {
    names.push_back(each.array);
  }
  return names;
}

std::shared_ptr<ShownCloud> makeShownCloud(
  vtkPolyData* cloud, const ShownRequest& request, const std::function<bool(double)>& goesOn)
{
  auto shown = std::make_shared<ShownCloud>();
  const std::vector<std::uint32_t> drawn = drawnPoints(PointAccess(cloud->GetPoints()).view());
  if (drawn.empty())
  {
    return nullptr;
  }
  shown->points = pick(cloud, drawn, request);
  const PointAccess access(shown->points->GetPoints());
  const PointView view = access.view();
  MeasuredCloud measured;
  AbortQuestion observer(goesOn);
  if (!measureCloud(view, request.orientation, request.kind, measured, &observer))
  {
    return nullptr;
  }
  takeOwnShapes(cloud, drawn, measured);
  shown->look = measured.look;
  shown->medianSpacing = measured.shape.medianSpacing;
  addColors(*shown, request, measured.query, measured.shape);
  addSplats(shown->points, measured);
  return shown;
}

std::shared_ptr<ShownCloud> makePlainCloud(vtkPolyData* cloud, const ShownRequest& request)
{
  auto shown = std::make_shared<ShownCloud>();
  const std::vector<std::uint32_t> drawn = drawnPoints(PointAccess(cloud->GetPoints()).view());
  if (drawn.empty())
  {
    return nullptr;
  }
  shown->points = pick(cloud, drawn, request);
  const PointAccess access(shown->points->GetPoints());
  const Vec3 extent = transformedBounds(access.view(), AffineTransform(), SmpExecutor()).extent();
  const bool isLow = kLowParts * extent.z < std::max(extent.x, extent.y) && request.orientation.up.z > 0.5;
  const CloudKind guess = request.orientation.fromSensor ? CloudKind::Frame
    : isLow                                              ? CloudKind::Terrain
                                                         : CloudKind::Object;
  LocalShape unknown;
  unknown.meanFlatness = 1.0; // most objects are statues and parts
  shown->look = cloudLook(request.kind.value_or(guess), access.view(), unknown, request.orientation);
  addColors(*shown, request, NeighborQuery(), unknown);
  shown->order = std::make_shared<const ProgressiveOrder>(progressiveOrder(access.view()));
  return shown;
}

void ShownMeasurement::start(vtkSmartPointer<vtkPolyData> cloud, const ShownRequest& request)
{
  const auto measure = [this, cloud = std::move(cloud), request]() -> std::shared_ptr<ShownCloud>
  {
    try
    {
      return makeShownCloud(cloud, request,
        [this](double part)
        {
          part_ = part;
          return !cancelled_;
        });
    }
    catch (const std::bad_alloc&)
    {
      return nullptr; // it stays plain
    }
  };
  result_ = std::async(std::launch::async, measure);
}

bool ShownMeasurement::isReady(bool waits) const
{
  if (waits)
  {
    result_.wait();
  }
  return result_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

ShownMeasurement::~ShownMeasurement()
{
  cancelled_ = true;
  if (result_.valid())
  {
    result_.wait();
  }
}

void drawShown(const ShownCloud& shown, vtkSplatMapper* mapper)
{
  mapper->SetInputData(shown.points);
  setUpSplats(mapper, shown.look);
  mapper->Settings().lightStrength = shown.colors.lightStrength;
}

} // namespace pointhaptics
