/// @file
/// Units of the numbers of a hand path, and checks of them by the sizes of path and cloud.
#pragma once

#include "Core/Base/PointView.h"
#include "Devices/HipPath.h"

#include <string>

namespace pointhaptics
{

/// Units of the numbers in a path's file.
struct PathUnits
{
  double metres = 1.0;  ///< Above 0.
  double seconds = 1.0; ///< Above 0.
};

/// What those who choose units call them: options of a program, arguments of a function.
struct UnitNames
{
  std::string cloud = "--unit";
  std::string path = "--path-unit";
  std::string time = "--path-time-unit";
};

/// Converts the numbers of @p path to metres and seconds.
void applyUnits(const PathUnits& units, HipPath& path);

/// A hand reaches 2 m, moves by millimetres a second at least, and is told more often than once in half a
/// second. Where @p path, in metres and seconds, does not, and would in other units, says so in one sentence
/// with the cure; else empty. @p cloud: box of what is felt, metres; may be empty. Costs a pass over the
/// path.
std::string unlikelyUnits(const HipPath& path, const Bounds& cloud, const UnitNames& names = {});
/// For a @p path that passes @p cloud without a touch: says so where the cloud would be as large as the path
/// in another unit.
std::string unlikelyCloudUnit(const HipPath& path, const Bounds& cloud, const UnitNames& names = {});

} // namespace pointhaptics
