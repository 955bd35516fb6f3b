#include "ShownCloud.h"

#include "CloudAppearance.h"
#include "PolyDataAccess.h"
#include "ProgressiveOrder.h"
#include "SmpExecutor.h"
#include "vtkSplatMapper.h"

#include "Core/Neighbors/LocalShape.h"
#include "Core/Neighbors/NeighborQuery.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkShortArray.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <new>
#include <vector>

namespace pointhaptics
{
namespace
{

/// Diameter of a splat over the spacing where nothing is flat; and the addition where it is.
constexpr double kPointDiameter = 1.1;
constexpr double kFlatDiameter = 1.1;
/// Diameter of a splat over the spacing of the rays of a frame, flat or not: the rays lie in a grid, whose
/// diagonals must close.
constexpr double kGridDiameter = 1.5;
constexpr double kNoGrowth = 64.0;
/// A cloud this many times as wide as it is high may be terrain.
constexpr double kLowParts = 3.0;
constexpr double kSmallestShownPixels = 2.0;
/// The pixels bound the splats, not the median of their lengths: a sweep is sparse far away.
constexpr double kFarthestRatio = 1e6;
/// An object is a surface from this mean flatness on.
constexpr double kSurfaceFlatness = 0.63;
/// Gaps up to this many median spacings are closed where a surface is not flat: single points beside it stay
/// small.
constexpr double kWidestGap = 3.0;
/// Height, pixels, of the window that the first picture is computed for.
constexpr double kUsualHeight = 800.0;
/// Clouds of more points are sampled: one point is measured in every place that the first picture can show.
constexpr std::int64_t kAllMeasured = 3000000;
constexpr double kFinestPixels = 0.5; ///< As LevelOfDetail has it.

class AbortQuestion : public ProgressObserver
{
public:
  explicit AbortQuestion(const std::function<bool(double)>& goesOn)
    : goesOn_(goesOn)
  {
  }
  bool report(double part) override { return goesOn_(part); }

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
  const bool all = std::int64_t(drawn.size()) == cloud->GetNumberOfPoints();
  vtkNew<vtkIdList> ids;
  if (!all)
  {
    ids->SetNumberOfIds(vtkIdType(drawn.size()));
    std::copy(drawn.begin(), drawn.end(), ids->GetPointer(0));
    vtkNew<vtkPoints> points;
    points->SetDataType(cloud->GetPoints()->GetDataType());
    cloud->GetPoints()->GetPoints(ids, points);
    result->SetPoints(points);
  }
  else
  {
    result->SetPoints(cloud->GetPoints());
  }
  result->GetFieldData()->ShallowCopy(cloud->GetFieldData());
  for (vtkDataArray* array : neededArrays(cloud, request))
  {
    vtkSmartPointer<vtkDataArray> kept = array;
    if (!all)
    {
      kept = vtkSmartPointer<vtkDataArray>::Take(array->NewInstance());
      kept->SetName(array->GetName());
      kept->SetNumberOfComponents(array->GetNumberOfComponents());
      kept->SetNumberOfTuples(ids->GetNumberOfIds());
      array->GetTuples(ids, kept);
    }
    const int index = result->GetPointData()->AddArray(kept);
    if (array == cloud->GetPointData()->GetScalars() && hasColors(cloud))
    {
      result->GetPointData()->SetActiveAttribute(index, vtkDataSetAttributes::SCALARS);
    }
  }
  return result;
}

/// Usual diameter for a spacing.
double usualDiameter(double flatness, double spacing)
{
  return (kPointDiameter + kFlatDiameter * flatness) * spacing;
}

void addSplats(vtkPolyData* points, const LocalShape& shape, const CloudLook& look, vtkDataArray* ownNormals)
{
  const bool isFrame = look.kind == CloudKind::Frame;
  const bool facesSensor = look.kind == CloudKind::Sweep || look.kind == CloudKind::Indoors;
  const double widest = kWidestGap * shape.medianSpacing;
  const vtkIdType count = points->GetNumberOfPoints();
  vtkNew<vtkFloatArray> lengths;
  lengths->SetName(kSplatLengthName);
  lengths->SetNumberOfValues(count);
  vtkNew<vtkShortArray> normals;
  normals->SetName(kSplatNormalName);
  normals->SetNumberOfComponents(3);
  normals->SetNumberOfTuples(count);
  short* out = normals->GetPointer(0);
  vtkNew<vtkUnsignedCharArray> growths;
  growths->SetName(kSplatGrowthName);
  growths->SetNumberOfValues(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    const PointShape& each = shape.points[std::size_t(i)];
    const double usual = usualDiameter(double(each.flatness), double(each.spacing));
    const double least = isFrame ? kGridDiameter * double(each.spacing)
      : look.closesAll           ? usualDiameter(1.0, std::min(double(each.spacing), widest))
                                 : 0.0;
    const double length = std::max({ usual, least, 2.0 * double(each.flatness) * double(each.reach) });
    lengths->SetValue(i, float(length));
    growths->SetValue(
      i, static_cast<unsigned char>(usual > 0.0 ? kNoGrowth * length / usual + 0.5 : kNoGrowth));
    Vec3 n{ double(each.normal[0]), double(each.normal[1]), double(each.normal[2]) };
    if (ownNormals)
    {
      Vec3 own;
      ownNormals->GetTuple(i, &own.x);
      n = normalized(own, n);
    }
    Vec3 p;
    points->GetPoint(i, &p.x);
    const double side = facesSensor && dot(n, p) > 0.0 ? -1.0 : 1.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      *out++ =
        short(std::lround(side * kSplatNormalUnit * std::clamp(double(each.flatness) * n[axis], -1.0, 1.0)));
    }
  }
  points->GetPointData()->AddArray(lengths);
  points->GetPointData()->AddArray(growths);
  points->GetPointData()->AddArray(normals);
}

/// Bounds of the points. vtkPoints' own must not be used, as other threads may read them at the same time.
Bounds boundsOf(const PointView& points)
{
  Bounds bounds;
  for (std::int64_t i = 0; i < points.size(); ++i)
  {
    bounds.include(points[i]);
  }
  return bounds;
}

/// Approximate edge of a pixel in the first picture.
double firstPixel(const PointView& points)
{
  const Vec3 extent = boundsOf(points).extent();
  return std::max({ extent.x, extent.y, extent.z }) / kUsualHeight;
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
  const SmpExecutor executor;
  NeighborQuery query;
  query.build(view, executor);
  LocalShape shape;
  LocalShapeSettings settings;
  settings.pixel = firstPixel(view);
  if (view.size() > kAllMeasured)
  {
    // A few neighbours that are apart reach as far as many that are close.
    settings.apart = kFinestPixels * settings.pixel;
    settings.numberOfNeighbors = LocalShapeSettings::kFewest;
  }
  AbortQuestion observer(goesOn);
  if (measureLocalShape(view, query, settings, shape, executor, &observer) != Status::Ok)
  {
    return nullptr;
  }
  const CloudKind decided = request.kind ? *request.kind : cloudKind(view, shape, request.orientation);
  shown->look = cloudLook(decided, view, shape, request.orientation);
  shown->medianSpacing = shape.medianSpacing;
  if (decided == CloudKind::Frame)
  {
    spaceByRays(view, shape);
  }
  shown->look.closesAll =
    decided == CloudKind::Frame || (decided == CloudKind::Object && shape.meanFlatness > kSurfaceFlatness);
  addColors(*shown, request, query, shape);
  vtkDataArray* own =
    std::int64_t(drawn.size()) == cloud->GetNumberOfPoints() ? cloud->GetPointData()->GetNormals() : nullptr;
  addSplats(shown->points, shape, shown->look, own);
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
  const Vec3 extent = boundsOf(access.view()).extent();
  const bool isLow = kLowParts * extent.z < std::max(extent.x, extent.y) && request.orientation.up.z > 0.5;
  const CloudKind guess = request.orientation.fromSensor ? CloudKind::Frame
    : isLow                                              ? CloudKind::Terrain
                                                         : CloudKind::Object;
  LocalShape unknown;
  unknown.points.resize(drawn.size());
  unknown.meanFlatness = 1.0; // most objects are statues and parts
  shown->look = cloudLook(request.kind.value_or(guess), access.view(), unknown, request.orientation);
  addColors(*shown, request, NeighborQuery(), unknown);
  shown->order = std::make_shared<const std::vector<std::uint32_t>>(progressiveOrder(access.view()));
  return shown;
}

void ShownMeasurement::start(vtkSmartPointer<vtkPolyData> cloud, const ShownRequest& request)
{
  this->cancel();
  cancelled_ = false;
  const auto measure = [this, cloud = std::move(cloud), request]() -> std::shared_ptr<ShownCloud>
  {
    try
    {
      return makeShownCloud(cloud, request, [this](double) { return !cancelled_; });
    }
    catch (const std::bad_alloc&)
    {
      return nullptr; // it stays plain
    }
  };
  result_ = std::async(std::launch::async, measure);
}

std::shared_ptr<ShownCloud> ShownMeasurement::take(bool waits)
{
  const bool isThere =
    result_.valid() && (waits || result_.wait_for(std::chrono::seconds(0)) == std::future_status::ready);
  return isThere ? result_.get() : nullptr;
}

void ShownMeasurement::cancel()
{
  cancelled_ = true;
  if (result_.valid())
  {
    result_.wait();
    result_ = {};
  }
}

void drawShown(const ShownCloud& shown, vtkSplatMapper* mapper)
{
  mapper->SetInputData(shown.points);
  mapper->SetSizeArrayName(kSplatLengthName);
  mapper->SetSizeScale(1.0);
  mapper->SetLargestRatio(kFarthestRatio);
  mapper->SetPixelRange(kSmallestShownPixels, shown.look.largestPixels);
  mapper->SetNormalArrayName(kSplatNormalName);
  mapper->SetNormalUnit(kSplatNormalUnit);
  mapper->SetAmbientLight(true);
  mapper->SetSurfaces(true);
  mapper->SetHidesBackFaces(shown.look.hidesBackFaces);
  mapper->SetClosesAll(shown.look.closesAll);
  mapper->SetForeshortens(shown.look.kind != CloudKind::Frame);
  mapper->SetLightStrength(shown.colors.lightStrength);
}

void addDensity(vtkPolyData* points)
{
  vtkDataArray* lengths = points->GetPointData()->GetArray(kSplatLengthName);
  vtkDataArray* normals = points->GetPointData()->GetArray(kSplatNormalName);
  vtkDataArray* growths = points->GetPointData()->GetArray(kSplatGrowthName);
  if (!lengths || !normals || !growths)
  {
    return; // not measured yet
  }
  vtkNew<vtkFloatArray> density;
  density->SetName("Density");
  density->SetNumberOfValues(points->GetNumberOfPoints());
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    Vec3 n;
    normals->GetTuple(i, &n.x);
    const double usual = std::abs(lengths->GetComponent(i, 0)) * kNoGrowth / growths->GetComponent(i, 0);
    const double spacing = usual / usualDiameter(norm(n) / kSplatNormalUnit, 1.0);
    density->SetValue(i, spacing > 0.0 ? float(1.0 / (spacing * spacing)) : NAN);
  }
  points->GetPointData()->AddArray(density);
}

} // namespace pointhaptics
