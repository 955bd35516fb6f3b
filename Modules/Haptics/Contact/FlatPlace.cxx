#include "Haptics/Contact/FlatPlace.h"

#include "Haptics/Contact/BallLengths.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace
{

/// Points are flat up to this RMS distance from their plane, over the ball's radius; fewer than kPlanePoints
/// are not.
constexpr double kFlat = 0.5 * ball::kBump;
constexpr double kPlanePoints = 6.0;
/// Points in a row have no normal: up to this RMS distance from a line, over the radius.
constexpr double kLine = ball::kBump;
/// The place continues where a point lies within a stride of the foot of the HIP and this far beyond it, over
/// the radius. With 0.05 a hand falls through a wedge of 20 degrees.
constexpr double kAhead = 0.04;

}

bool FlatPlace::find(
  const BallCells& cells, const Vec3& center, double radius, double reach, Vec3& away) noexcept
{
  Vec3 mean;
  SymEigen eigen;
  // Points further from the plane than the RMS belong to another face: the second round leaves them out.
  for (const bool trims : { false, true })
  {
    const double gate = std::sqrt(std::max(0.0, eigen.values[0]));
    double count = 0.0;
    Vec3 sum;
    SymMat3 squares;
    cells.visitBall(center, reach,
      [&](const Vec3& offset, double)
      {
        if (!trims || std::abs(dot(offset - mean, eigen.vectors[0])) <= gate)
        {
          count += 1.0;
          sum += offset;
          squares += outerProduct(offset);
        }
      });
    if (count < kPlanePoints && trims)
    {
      break;
    }
    mean = count > 0.0 ? sum / count : Vec3();
    SymMat3 middle = outerProduct(mean);
    middle *= -1.0;
    squares *= count > 0.0 ? 1.0 / count : 0.0;
    squares += middle;
    eigen = symmetricEigen(squares);
    away = trims ? away : normalized(mean);
    if (!trims &&
      (count < kPlanePoints || eigen.values[0] > kFlat * kFlat * radius * radius ||
        eigen.values[1] < kLine * kLine * radius * radius))
    {
      return false;
    }
  }
  this->set(center - mean, dot(eigen.vectors[0], away) < 0.0 ? -eigen.vectors[0] : eigen.vectors[0], center);
  return true;
}

void FlatPlace::carry(const AffineTransform& change) noexcept
{
  normal_ = normalized(change.applyToNormal(normal_), normal_);
  point_ = change.apply(point_);
  foundAt_ = change.apply(foundAt_);
}

bool FlatPlace::continuesUnder(
  const HapticScene& scene, const Vec3& hip, const Vec3& slipped, double radius) const noexcept
{
  const Vec3 foot = hip - height(hip) * normal_;
  const Vec3 ahead = normalized(this->along(slipped - hip));
  return scene.contactPyramid().anyWithin(0, foot, ball::kStride * radius,
    [&](const Cell& cell)
    {
      const Vec3 beyond = cell.mean - foot;
      return dot(beyond, ahead) > kAhead * radius && std::abs(dot(beyond, normal_)) < kFlat * radius;
    });
}

double FlatPlace::wayAside(
  const Vec3& center, const Vec3& hip, const Vec3& direction, double most) const noexcept
{
  const Vec3 lean = this->along(hip - center);
  const Vec3 sideways = this->along(direction);
  const double speed2 = norm2(sideways);
  const double half = dot(lean, sideways);
  const double room = std::max(0.0, half * half + speed2 * (most * most - norm2(lean)));
  return speed2 > 0.0 ? std::max(0.0, (half + std::sqrt(room)) / speed2) : INFINITY;
}

} // namespace pointhaptics
