/// @file
/// How large the proxy's ball must be among the points about it.
#pragma once

#include "Core/Surface/FitCells.h"
#include "Haptics/Contact/BallCells.h"
#include "Haptics/HapticScene.h"

namespace pointhaptics
{

/// The radius over the index cell and over the local spacing of the points, at least: a smaller ball falls
/// through the gaps of a random sample.
constexpr double kBallRadiusInCells = 2.0;
constexpr double kBallRadiusInSpacings = 2.4;

/// The radius that the cloud asks for at its point @p seed (a finest cell's mean), seen from a ball at @p
/// center: points of other sheets do not count. A row of points is of no sheet, and is counted whole. A few
/// points far from all others, strays beside a sheet, and points scattered where the cloud is much sparser
/// than elsewhere are needles, of a ball as small as the cells; of a cloud of a few points it is a small part
/// of the extent. At a rim the points' own plane counts, if beside it the ball has the room that their
/// spacing asks for: a ball that leans into a hole sees the sheet aslant, and would take the points for 1.6
/// times as sparse as they are. Where the density of a flat sheet steps, the spacing of its sparser side
/// counts, up to ten typical ones and where there is little noise: most of the points about the seed are of
/// the other. Lattice frame, metres.
/// @param fields the memory for the scene's fields. @param near gathered points; others are sought. No
/// allocation; one thread for each @p fields.
double ballRadius(const HapticScene& scene, FitCells& fields, const BallCells& near, const Vec3& seed,
  const Vec3& center) noexcept;

} // namespace pointhaptics
