#include "IO/Info/CloudExtent.h"

#include "Core/Base/Boxes.h"

#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>
#include <mutex>

namespace pointhaptics
{

Vec3 floatSteps(const Bounds& box)
{
  Vec3 steps;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto most = static_cast<float>(std::max(std::abs(box.minimum[axis]), std::abs(box.maximum[axis])));
    steps[axis] = static_cast<double>(most - std::nextafter(most, 0.0f));
  }
  return steps;
}

CloudExtent extentOf(vtkPolyData* cloud, const AffineTransform& transform, const Executor& executor)
{
  CloudExtent extent;
  std::mutex mutex;
  forRange(executor, cloud->GetNumberOfPoints(),
    [&](std::int64_t begin, std::int64_t end)
    {
      CloudExtent part;
      for (Vec3 p; begin < end; ++begin)
      {
        cloud->GetPoint(begin, &p.x);
        const bool isPlace = isFinite(p);
        part.finite += isPlace ? 1 : 0;
        part.atZero += isAtZero(p) ? 1 : 0;
        if (isPlace && !isAtZero(p))
        {
          part.returned.include(transform.apply(p));
        }
      }
      const std::lock_guard<std::mutex> lock(mutex);
      extent.finite += part.finite;
      extent.atZero += part.atZero;
      if (!part.returned.empty())
      {
        extent.returned.include(part.returned.minimum);
        extent.returned.include(part.returned.maximum);
      }
    });
  extent.invalid = cloud->GetNumberOfPoints() - extent.finite;
  extent.all = extent.returned;
  if (extent.atZero > 0)
  {
    extent.all.include(transform.apply(Vec3()));
  }
  if (areNoReturns(extent.atZero, extent.finite))
  {
    extent.noReturns = extent.atZero;
  }
  else
  {
    extent.returned = extent.all;
  }
  return extent;
}

} // namespace pointhaptics
