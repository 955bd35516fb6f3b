// Marks that a person sets in a cloud: the two ends of a distance, and the box outside of which nothing is
// shown.
#include "ViewScene.h"

#include "ClippedCloud.h"
#include "CoordinateText.h"
#include "PointPicking.h"
#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include <vtkMatrix4x4.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace pointhaptics
{
namespace
{

/// Reaches of a pick, nearest first: the point under the pointer goes before those beside and in front of it.
constexpr double kPickPixels[] = { 2.0, 4.0, 8.0 };

Vec3 placeOf(const std::vector<double>& numbers, std::size_t index)
{
  return { numbers[3 * index], numbers[3 * index + 1], numbers[3 * index + 2] };
}

} // namespace

bool ViewScene::placeAt(int x, int y, Vec3& place)
{
  PickedPoint picked;
  for (const double pixels : kPickPixels)
  {
    if (!drawsFelt_ &&
      pickPoint(shown_->points, renderer_, x, y, pixels, picked, pointsMatrix_, drawnBy(pointsActor_)))
    {
      shown_->points->GetPoint(picked.index, &place.x);
      return true;
    }
    if (drawsFelt_ && pickPoint(bandwidth_->GetOutput(), renderer_, x, y, pixels, picked) && picked.inCloud)
    {
      place = *picked.inCloud;
      return true;
    }
  }
  return false;
}

std::vector<std::string> ViewScene::measuredText() const
{
  const std::vector<double>& ends = picture_.measure;
  return cloud_ && ends.size() == 6 ? distanceText(cloud_, placeOf(ends, 0), placeOf(ends, 1), unit_.name,
                                        shown_ ? shown_->medianSpacing : 0.0)
                                    : std::vector<std::string>();
}

/// Shows the marks; a figure has none.
void ViewScene::applyMarks()
{
  const std::size_t count = figure_ ? 0 : std::min<std::size_t>(2, picture_.measure.size() / 3);
  std::vector<Vec3> places;
  for (std::size_t i = 0; i < count; ++i)
  {
    places.push_back(placeOf(picture_.measure, i));
  }
  distance_.setPlaces(std::move(places));
  distance_.setWords(this->measuredText());
  distance_.setModel(pointsMatrix_);
}

const Bounds& ViewScene::cloudBounds()
{
  if (cloudBounds_.empty() && cloud_)
  {
    cloudBounds_ = near_.empty() ? extentOf(cloud_).all : near_;
  }
  return cloudBounds_;
}

void ViewScene::setClip(const std::vector<double>& clip)
{
  clip_ = clip;
  const vtkNew<vtkSplatMapper> all;
  const std::array<double, 6>& whole = all->GetClipBox();
  pointsMapper_->SetClipBox(clip_.size() == whole.size() ? clip_.data() : whole.data());
}

void ViewScene::clipFelt()
{
  if (cloud_)
  {
    resampler_->SetInputData(clippedCloud(cloud_, clipBox(clip_)));
    scene_.reset();
  }
}

} // namespace pointhaptics
