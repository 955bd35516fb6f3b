#include "Haptics/Contact/BallRadius.h"

#include "Haptics/Contact/PointMoments.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace
{

/// Over the radius from the bandwidth, which is some 2.9 spacings.
constexpr double kRadiusOfField = 0.8;
constexpr double kFieldInSpacings = 2.9;
/// It counts half where there are midpoints: from their least spacing on, in full this part of it below.
constexpr double kFieldRamp = 0.15;
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
/// Points are of one sheet where their RMS distance from a plane is less, over the reach; and at its rim
/// where their middle lies further aside.
constexpr double kOneSheet = 0.1;
constexpr double kRimOffset = 0.3;
/// The same of one flat sheet, with little noise.
constexpr double kFlatSheet = 0.05;
/// Part of the ball that must have room beside a rim.
constexpr double kRoom = 0.9;
/// Points within so many index cells are no sheet aside. A point is a stray beside a sheet that has so many
/// times as many points within half of the reach, and whose plane it is that far from, over the distance of
/// the sheet's points.
constexpr double kStrayReach = 4.0;
constexpr double kDenserThanStray = 8.0;
constexpr double kOffSheet = 0.5;
/// The same of a sheet in whose plane the point is: so many times as many points must be on one side, as a
/// sheet may go on much sparser.
constexpr double kFarDenser = 64.0;
/// Points so many typical spacings apart are a surface only where they are of one sheet, and their middle
/// lies no further aside.
constexpr double kMiddle = 0.5;
constexpr double kScatteredSpacings = 4.0;
/// Part of kPoints that must be there, where they are few because they lie aside.
constexpr double kLeastPartOfPoints = 0.5;
/// A sheet may go on much sparser on one side of a point: where the middle of the points about it lies that
/// far aside in their plane, over the reach, the disk beside it on the other side that has so many points is
/// sought, in steps of kReachGrowth. There the sheet goes on, if their spacing is so many times as large, no
/// more than so many typical ones, as a ball as large would touch too many points of the denser side; and
/// their middle no further from the disk's, over its radius: beyond a slot they are on its far side.
constexpr double kStepOffset = 0.18;
constexpr double kSparser = 1.4;
constexpr double kMostSpacings = 10.0;
constexpr double kSidePoints = 8.0;
constexpr int kSides = 11;
constexpr double kSideOffset = 0.45;
/// The ball of a cloud of less than kPoints points, over its extent.
constexpr double kOfFewPoints = 0.02;
constexpr double kPi = 3.14159265358979323846;

/// Calls visit(offset from @p seed) for the points within @p reach of it.
template <typename Visitor>
void visitPoints(
  const HapticScene& scene, const BallCells& near, const Vec3& seed, double reach, Visitor&& visit) noexcept
{
  if (near.holds(scene.contactPyramid(), seed, reach))
  {
    near.visitBall(seed, reach, [&](const Vec3& offset, double) { visit(-offset); });
    return;
  }
  scene.contactPyramid().visitBall(
    0, seed, reach, [&](std::uint32_t, const Cell& cell, double) { visit(cell.mean - seed); });
}

/// Whether the points within @p reach are a row: it has no normal, and is of no sheet.
bool isRow(const HapticScene& scene, const BallCells& near, const Vec3& seed, double reach) noexcept
{
  PointMoments points;
  visitPoints(scene, near, seed, reach, [&](const Vec3& offset) { points.add(offset); });
  return symmetricEigen(points.covariance()).values[1] < kOneSheet * kOneSheet * reach * reach;
}

/// Whether they are one flat sheet that goes on all around.
bool isFlat(const HapticScene& scene, const BallCells& near, const Vec3& seed, double reach) noexcept
{
  PointMoments points;
  visitPoints(scene, near, seed, reach, [&](const Vec3& offset) { points.add(offset); });
  const double flat = kFlatSheet * reach;
  return symmetricEigen(points.covariance()).values[0] < flat * flat &&
    norm(points.mean()) < kRimOffset * reach;
}

/// Whether the points about @p place, from the seed and within half of @p reach, are a sheet that the seed is
/// a stray beside.
bool isSheetAside(const HapticScene& scene, const BallCells& near, const Vec3& seed, double reach,
  const Vec3& place, double countAtSeed) noexcept
{
  PointMoments points;
  visitPoints(scene, near, seed + place, 0.5 * reach, [&](const Vec3& offset) { points.add(offset); });
  if (points.count < std::max(kPoints, kDenserThanStray * countAtSeed))
  {
    return false;
  }
  const auto spread = symmetricEigen(points.covariance());
  const double least = kOneSheet * 0.5 * reach;
  return spread.values[1] >= least * least &&
    std::abs(dot(place, spread.vectors[0])) > kOffSheet * norm(place);
}

/// Whether the points that were found within @p reach are not about the seed, but of a sheet beside it.
bool isStray(const HapticScene& scene, const BallCells& near, const Vec3& seed, double reach) noexcept
{
  if (reach < kStrayReach * scene.contactCell())
  {
    return false;
  }
  const double half = 0.5 * reach;
  double count = 0.0;
  double outside = 0.0;
  Vec3 sum;
  Vec3 first;
  double least = reach * reach;
  visitPoints(scene, near, seed, reach,
    [&](const Vec3& offset)
    {
      const double d2 = norm2(offset);
      if (d2 < half * half)
      {
        count += 1.0;
        return;
      }
      outside += 1.0;
      sum += offset;
      first = d2 < least ? offset : first;
      least = std::min(least, d2);
    });
  const bool isOnOneSide = norm(sum) > kMiddle * reach * outside;
  return outside > count &&
    ((isOnOneSide && outside > kFarDenser * count) || isSheetAside(scene, near, seed, reach, first, count) ||
      isSheetAside(scene, near, seed, reach, sum / outside, count));
}

/// Whether points as far apart as @p spacing, though the cloud has much denser ones elsewhere, are of no
/// surface, but scattered.
bool areScattered(
  const HapticScene& scene, const BallCells& near, const Vec3& seed, double reach, double spacing) noexcept
{
  if (kFieldInSpacings * spacing < kScatteredSpacings * scene.typicalScale().proxyRadius)
  {
    return false;
  }
  PointMoments points;
  visitPoints(scene, near, seed, reach, [&](const Vec3& offset) { points.add(offset); });
  return points.count < kLeastPartOfPoints * kPoints ||
    symmetricEigen(points.covariance()).values[0] > kOneSheet * kOneSheet * reach * reach ||
    norm(points.mean()) > kMiddle * reach;
}

/// Few points far from all others, beside a sheet or scattered in the air, are of none: they have no spacing,
/// and the field about them is as wide as they are far apart.
bool isOfNoSheet(
  const HapticScene& scene, const BallCells& near, const Vec3& seed, double reach, double spacing) noexcept
{
  return isStray(scene, near, seed, reach) || areScattered(scene, near, seed, reach, spacing);
}

/// Part of a disk that points fill whose middle lies @p aside, over its radius.
double filledPart(double aside) noexcept
{
  return std::clamp(1.0 - kPartPerOffset * (aside - kChanceOffset), kLeastPart, 1.0);
}

/// The spacing at @p seed if that is at the rim of a hole, or of the sheet, with room for a ball that the
/// spacing asks for; else @p spacing. There a ball that leans into the hole sees the sheet aslant, and few of
/// its points. @param middle of the points within @p reach, from the seed.
double rimSpacing(const HapticScene& scene, const BallCells& near, const Vec3& seed, double reach,
  const Vec3& middle, double spacing) noexcept
{
  const double aside = norm(middle) / reach;
  if (aside < kRimOffset)
  {
    return spacing;
  }
  PointMoments points;
  visitPoints(scene, near, seed, reach, [&](const Vec3& offset) { points.add(offset); });
  if (symmetricEigen(points.covariance()).values[0] > kOneSheet * kOneSheet * reach * reach)
  {
    return spacing;
  }
  const double own = reach * std::sqrt(kPi * filledPart(aside) / points.count);
  const double radius = kBallRadiusInSpacings * own;
  bool hasRoom = own < spacing;
  if (hasRoom)
  {
    visitPoints(scene, near, seed - (radius / norm(middle)) * middle, kRoom * radius,
      [&](const Vec3&) { hasRoom = false; });
  }
  return hasRoom ? own : spacing;
}

/// The spacing of the seed's sheet on its sparser side, where its density steps; 0: it does not, or the noise
/// is too large to tell. The points about the seed are those of the denser side then: a ball as small would
/// fall through beside it. @param middle of the points within @p reach, from the seed.
double sparserSide(const HapticScene& scene, const BallCells& near, const Vec3& seed, double reach,
  const Vec3& middle) noexcept
{
  if (norm(middle) < kStepOffset * reach)
  {
    return 0.0;
  }
  PointMoments points;
  visitPoints(scene, near, seed, reach, [&](const Vec3& offset) { points.add(offset); });
  const auto spread = symmetricEigen(points.covariance());
  const double flat = kFlatSheet * reach;
  const Vec3 up = spread.vectors[0];
  const Vec3 foot = dot(middle, up) * up;
  if (points.count < kLeastPartOfPoints * kPoints || spread.values[0] > flat * flat ||
    scene.noise(seed) > flat || norm(foot) > kOneSheet * reach || norm(middle - foot) < kStepOffset * reach)
  {
    return 0.0;
  }
  const Vec3 aside = normalized(foot - middle);
  double rim = 0.0;
  visitPoints(scene, near, seed, reach, [&](const Vec3& offset) { rim = std::max(rim, dot(offset, aside)); });
  const double apart = reach * std::sqrt(kPi / points.count);
  double radius = apart;
  for (int i = 0; i < kSides; ++i, radius *= kReachGrowth)
  {
    PointMoments side;
    visitPoints(scene, near, seed + foot + (rim + radius) * aside, radius,
      [&](const Vec3& offset)
      {
        if (std::abs(dot(offset, up)) < kSheetDepth * radius)
        {
          side.add(offset);
        }
      });
    if (side.count >= kSidePoints)
    {
      const double spacing = radius * std::sqrt(kPi / side.count);
      const double even = kFlatSheet * radius;
      const bool goesOn =
        norm(side.mean()) < kSideOffset * radius && symmetricEigen(side.covariance()).values[0] < even * even;
      const bool isTooFar = kFieldInSpacings * spacing > kMostSpacings * scene.typicalScale().proxyRadius;
      return goesOn && !isTooFar && spacing > kSparser * apart ? spacing : 0.0;
    }
  }
  return 0.0;
}

/// Part of the field's radius that counts at @p typical of it: where there are midpoints the spacing is half
/// that of the points.
double fieldPart(const HapticScene& scene, double typical) noexcept
{
  const double sparse = kFieldInSpacings * scene.sparseSpacing();
  return sparse > 0.0 ? 1.0 - 0.5 * std::clamp(1.0 + (typical / sparse - 1.0) / kFieldRamp, 0.0, 1.0) : 1.0;
}

}

double ballRadius(const HapticScene& scene, FitCells& fields, const BallCells& near, const Vec3& seed,
  const Vec3& center) noexcept
{
  const Vec3 up = normalized(center - seed);
  double points = 0.0;
  double total = 0.0;
  double reach = kFirstReach * scene.contactCell();
  Vec3 middle;
  for (int i = 0; i < kReaches && points < kPoints; ++i, reach *= kReachGrowth)
  {
    double all = 0.0;
    double count = 0.0;
    Vec3 sum;
    Vec3 sumOfAll;
    visitPoints(scene, near, seed, reach,
      [&](const Vec3& offset)
      {
        all += 1.0;
        sumOfAll += offset;
        if (std::abs(dot(offset, up)) < kSheetDepth * reach)
        {
          count += 1.0;
          sum += offset;
        }
      });
    middle = sumOfAll / std::max(1.0, all);
    // Where the sheet ends the points fill a part of the disk alone, and their middle lies aside.
    const double part = filledPart(norm(sum) / (std::max(1.0, count) * reach));
    // Two sheets have twice the points of one; where the gate leaves fewer the surface is bent.
    points = std::max({ 1.0, count / part, all / kMostSheets });
    // Seen aslant a row would seem to be as sparse again: the ball would be caught in the gaps beside it.
    points = points < kPoints && all >= kPoints && isRow(scene, near, seed, reach) ? all : points;
    total = all;
  }
  reach /= kReachGrowth;
  // A ball that became too small for a sparse sheet sees it aslant, and would stay too small.
  points = points < kPoints && total >= kPoints && isFlat(scene, near, seed, reach) ? total : points;
  const double apart = reach * std::sqrt(kPi / points);
  // A cloud of a few points has no surface: its cells are as large as they are far apart.
  const double least = kBallRadiusInCells * scene.contactCell();
  const double extent = norm(scene.bounds().extent());
  if (double(scene.contactPyramid().level(0).cells.size()) < kPoints)
  {
    return extent > 0.0 ? std::min(least, kOfFewPoints * extent) : least;
  }
  const double sparser = sparserSide(scene, near, seed, reach, middle);
  if (sparser == 0.0 && (points < kPoints || isOfNoSheet(scene, near, seed, reach, apart)))
  {
    return least;
  }
  const double spacing = sparser > 0.0 ? sparser : rimSpacing(scene, near, seed, reach, middle, apart);
  // Few points say little: the field, which is smooth, keeps clumps of them from making the ball too small.
  Vec3 ignored;
  const double typical = scene.fitScale(seed, fields, ignored).proxyRadius;
  const double field = kRadiusOfField * typical * fieldPart(scene, typical);
  return std::max({ least, kBallRadiusInSpacings * spacing, field });
}

} // namespace pointhaptics
