#include "Haptics/Contact/BallRadius.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace
{

/// Over the radius from the bandwidth, which is some 2.9 spacings.
constexpr double kRadiusOfField = 0.8;
/// The spacing is that of so many points: the ball about one of them that has them is sought from this many
/// index cells on, in steps.
constexpr double kPoints = 16.0;
constexpr double kFirstReach = 2.0;
constexpr double kReachGrowth = 1.3;
constexpr int kReaches = 12;
/// Points further than this part of that reach from the tangent plane are of another sheet.
constexpr double kSheetDepth = 0.15;
/// The middle of half a disk is 0.42 radii aside; that of a few points on a whole one lies aside by chance.
constexpr double kChanceOffset = 0.2;
constexpr double kPartPerOffset = 2.3;
constexpr double kLeastPart = 0.25;
constexpr double kMostSheets = 2.0;

}

double ballRadius(const HapticScene& scene, FitCells& fields, const BallCells& near, const Vec3& seed,
  const Vec3& center) noexcept
{
  constexpr double kPi = 3.14159265358979323846;
  const Vec3 up = normalized(center - seed);
  double points = 0.0;
  double reach = kFirstReach * scene.cellSize();
  for (int i = 0; i < kReaches && points < kPoints; ++i, reach *= kReachGrowth)
  {
    double all = 0.0;
    double count = 0.0;
    Vec3 sum;
    const auto add = [&](const Vec3& offset)
    {
      all += 1.0;
      if (std::abs(dot(offset, up)) < kSheetDepth * reach)
      {
        count += 1.0;
        sum += offset;
      }
    };
    if (near.holds(scene.pyramid(), seed, reach))
    {
      near.visitBall(seed, reach, [&](const Vec3& offset, double) { add(-offset); });
    }
    else
    {
      scene.pyramid().visitBall(
        0, seed, reach, [&](std::uint32_t, const Cell& cell, double) { add(cell.mean - seed); });
    }
    // Where the sheet ends the points fill a part of the disk alone, and their middle lies aside.
    const double aside = norm(sum) / (std::max(1.0, count) * reach);
    const double part = std::clamp(1.0 - kPartPerOffset * (aside - kChanceOffset), kLeastPart, 1.0);
    // Two sheets have twice the points of one; where the gate leaves fewer the surface is bent.
    points = std::max({ 1.0, count / part, all / kMostSheets });
  }
  const double spacing = reach / kReachGrowth * std::sqrt(kPi / points);
  // Few points say little: the field, which is smooth, keeps clumps of them from making the ball too small.
  Vec3 ignored;
  const double field = kRadiusOfField * scene.fitScale(seed, fields, ignored).proxyRadius;
  return std::max({ kBallRadiusInCells * scene.cellSize(), kBallRadiusInSpacings * spacing, field });
}

} // namespace pointhaptics
