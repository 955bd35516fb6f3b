#include "Shapes/IdealForce.h"

#include "Shapes/ShapeFoot.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pointhaptics
{
namespace
{

constexpr double kOnSurface = 1e-6;
constexpr std::int64_t kSample = 1000;
constexpr double kHalfEdge = 0.05; ///< Half the edge of the cube that holds all shapes, metres.
/// A foot point this far off the normal's line, over the distance, lies on a rim.
constexpr double kRimSlope = 1e-4;

double largestCoordinate(const Vec3& p)
{
  return std::max({ std::abs(p.x), std::abs(p.y), std::abs(p.z) });
}

template <typename Condition>
bool holdsForSample(const PointView& points, Condition&& condition)
{
  std::int64_t seen = 0;
  const std::int64_t step = std::max<std::int64_t>(1, points.size() / kSample);
  for (std::int64_t i = 0; i < points.size(); i += step)
  {
    const Vec3 p = points[i];
    if (isFinite(p))
    {
      ++seen;
      if (!condition(p))
      {
        return false;
      }
    }
  }
  return seen > 0;
}

} // namespace

bool recognizeShape(const PointView& points, Shape& shape)
{
  const auto mayBeOnShape = [](const Vec3& p) { return largestCoordinate(p) < kHalfEdge + kOnSurface; };
  if (!holdsForSample(points, mayBeOnShape))
  {
    return false; // the idol's first foot point takes longer than all others
  }
  for (int i = 0; i < kNumberOfShapes; ++i)
  {
    Shape candidate = static_cast<Shape>(i);
    const auto isOnSurface = [&](const Vec3& p)
    { return std::abs(closestPoint(candidate, p).distance) < kOnSurface; };
    if (holdsForSample(points, isOnSurface))
    {
      const auto isOutsideHole = [](const Vec3& p)
      { return std::hypot(p.x, p.y) > detail::kHoleRadius - kOnSurface; };
      const bool hasHole =
        candidate == Shape::Plane && holdsForSample(points, isOutsideHole) && points.size() >= kSample / 2;
      shape = hasHole ? Shape::Hole : candidate;
      return true;
    }
  }
  return false;
}

double IdealForce::at(const Vec3& hip, const AffineTransform& modelToWorkspace, double stiffness) noexcept
{
  double scale = 1.0;
  if (!modelToWorkspace.isSimilarity(scale) || !isFinite(hip) || shape_ == Shape::Sheet)
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  const Vec3 hand = modelToWorkspace.inverse().apply(hip);
  const SurfacePoint foot = closestPoint(shape_, hand);
  const Vec3 away = hand - foot.point;
  const double length = std::abs(foot.distance);
  const bool isPastRim = norm(away - dot(away, foot.normal) * foot.normal) > kRimSlope * length + kOnSurface;
  const double side = foot.distance < 0.0 ? -1.0 : 1.0;
  if (side_ == 0.0 || isPastRim || side == side_)
  {
    side_ = side;
    return 0.0;
  }
  return stiffness * scale * length;
}

} // namespace pointhaptics
