// Marks that a person sets in a cloud: the two ends of a distance, and the box outside of which nothing is
// shown.
#include "Core/Base/Boxes.h"
#include "ViewScene.h"

#include "CloudAppearance.h"
#include "CoordinateText.h"
#include "PointPicking.h"
#include "PolyDataAccess.h"
#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkLookupTable.h>
#include <vtkMatrix4x4.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkVariant.h>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace pointhaptics
{
namespace
{

constexpr double kPickPixels = 8.0; ///< Reach of a pick.
/// A profile has the points beside its line up to this part of its length, or as many spacings if that is
/// more.
constexpr double kProfilePart = 0.005;
constexpr double kProfileSpacings = 1.0;
constexpr std::size_t kMostOfProfile = 20000;

/// A place of the file where it is drawn.
Vec3 placeOf(vtkPolyData* cloud, const std::vector<double>& numbers, std::size_t index)
{
  return toLocalFrame(cloud, { numbers[3 * index], numbers[3 * index + 1], numbers[3 * index + 2] });
}

} // namespace

bool ViewScene::placeAt(int x, int y, Vec3& place)
{
  PickedPoint picked;
  if (!drawsFelt_ &&
    pickPoint(shown_->points, renderer_, x, y, kPickPixels, picked, pointsMatrix_, drawnBy(pointsActor_)))
  {
    shown_->points->GetPoint(picked.index, &place.x);
    return true;
  }
  if (drawsFelt_ && pickPoint(bandwidth_->GetOutput(), renderer_, x, y, kPickPixels, picked))
  {
    place = picked.inCloud.value_or(place);
    return picked.inCloud.has_value();
  }
  return false;
}

std::vector<std::string> ViewScene::measuredText() const
{
  const std::vector<double>& ends = picture_.measure;
  return loaded_.cloud && ends.size() == 6
    ? distanceText(loaded_.cloud, placeOf(loaded_.cloud, ends, 0), placeOf(loaded_.cloud, ends, 1),
        unit_.name, shown_ ? shown_->medianSpacing : 0.0)
    : std::vector<std::string>();
}

ProfilePoints ViewScene::profile() const
{
  const std::vector<double>& ends = picture_.measure;
  if (!shown_ || ends.size() != 6)
  {
    return {};
  }
  const Vec3 from = placeOf(loaded_.cloud, ends, 0);
  const Vec3 whole = placeOf(loaded_.cloud, ends, 1) - from;
  const double width = std::max(kProfilePart * norm(whole), kProfileSpacings * shown_->medianSpacing);
  const Vec3& up = loaded_.orientation.up;
  const Vec3 level = whole - dot(whole, up) * up;
  const double length = norm(level);
  const Vec3 along = normalized(level);
  const Vec3 aside = cross(up, along);
  const auto isKept = notHidden(shown_->points, picture_.hidden);
  const std::optional<Bounds> box = clipBox(clip_, loaded_.cloud);
  const PointAccess access(shown_->points->GetPoints());
  const PointView points = access.view();
  ProfilePoints found;
  for (std::int64_t i = 0; length > 0.0 && i < points.size(); ++i)
  {
    const Vec3 place = points[i];
    const Vec3 way = place - from;
    const double distance = dot(way, along);
    if (distance >= 0.0 && distance <= length && std::abs(dot(way, aside)) <= width && isKept(i) &&
      (!box || contains(*box, place)))
    {
      found.push_back({ distance, dot(place, up) });
    }
  }
  const std::size_t step = 1 + found.size() / kMostOfProfile; // every k-th tells enough
  for (std::size_t i = 0; i * step < found.size(); ++i)
  {
    found[i] = found[i * step];
  }
  found.resize((found.size() + step - 1) / step);
  return found;
}

/// Shows the marks; a figure has none.
void ViewScene::applyMarks()
{
  const std::size_t count =
    figure_ || !loaded_.cloud ? 0 : std::min<std::size_t>(2, picture_.measure.size() / 3);
  std::vector<Vec3> places;
  for (std::size_t i = 0; i < count; ++i)
  {
    places.push_back(placeOf(loaded_.cloud, picture_.measure, i));
  }
  distance_.setPlaces(std::move(places));
  distance_.setWords(this->measuredText());
  distance_.setModel(pointsMatrix_);
}

const Bounds& ViewScene::cloudBounds()
{
  if (cloudBounds_.empty() && loaded_.cloud)
  {
    cloudBounds_ = loaded_.near.empty() ? extentOf(loaded_.cloud).all : loaded_.near;
  }
  return cloudBounds_;
}

void ViewScene::setClip(const std::vector<double>& clip)
{
  clip_ = clip;
  const Vec3 infinite{ INFINITY, INFINITY, INFINITY };
  const Bounds box = clipBox(clip_, loaded_.cloud).value_or(Bounds{ -1.0 * infinite, infinite });
  pointsMapper_->Settings().clipBox = { box.minimum.x, box.maximum.x, box.minimum.y, box.maximum.y,
    box.minimum.z, box.maximum.z };
}

/// Only the drawn points have the arrays that hide.
void ViewScene::clipFelt()
{
  if (loaded_.cloud)
  {
    vtkPolyData* points = picture_.hidden.empty() ? loaded_.cloud : shown_->points;
    resampler_->SetInputData(shownPart(points, clip_, picture_.hidden));
    loaded_.scene.reset();
  }
}

/// Hidden points have negative lengths; a cloud that is not measured has none, and draws all.
void ViewScene::applyHidden()
{
  auto* lengths = vtkFloatArray::SafeDownCast(shown_->points->GetPointData()->GetArray(kSplatLengthName));
  if (!lengths)
  {
    return;
  }
  const auto isKept = notHidden(shown_->points, picture_.hidden);
  for (vtkIdType i = 0; i < lengths->GetNumberOfValues(); ++i)
  {
    const float length = std::abs(lengths->GetValue(i));
    lengths->SetValue(i, isKept(i) ? length : -length);
  }
  lengths->Modified();
  shown_->points->Modified();
}

/// Greys what is hidden.
void ViewScene::markHidden(vtkLookupTable* legend, const std::string& array) const
{
  for (vtkIdType row = 0; row < legend->GetNumberOfAnnotatedValues(); ++row)
  {
    const double value = legend->GetAnnotatedValue(row).ToDouble();
    const bool isHidden = std::any_of(picture_.hidden.begin(), picture_.hidden.end(),
      [&](const HiddenValues& each)
      { return each.array == array && value >= each.low && value <= each.high; });
    if (isHidden)
    {
      legend->SetAnnotation(legend->GetAnnotatedValue(row), legend->GetAnnotation(row) + " (hidden)");
      legend->SetTableValue(row, 0.3, 0.3, 0.3, 1.0);
    }
  }
}

bool ViewScene::canHideBy(const std::string& array) const
{
  vtkPolyData* points = array == "Density" ? loaded_.cloud : shown_->points;
  return findColorSource(points, array).has_value();
}

std::vector<std::string> ViewScene::fileNames() const
{
  vtkAbstractArray* names =
    loaded_.cloud ? loaded_.cloud->GetFieldData()->GetAbstractArray(kFileArrayName) : nullptr;
  std::vector<std::string> files;
  for (vtkIdType i = 0; names && i < names->GetNumberOfValues(); ++i)
  {
    files.push_back(names->GetVariantValue(i).ToString());
  }
  return files;
}

} // namespace pointhaptics
