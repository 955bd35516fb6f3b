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

/// Names of the units in messages: options of a program, arguments of a function.
struct UnitNames
{
  std::string cloud = "--unit";
  std::string path = "--path-unit";
  std::string time = "--path-time-unit";
};

/// Converts the numbers of @p path to metres and seconds.
void applyUnits(const PathUnits& units, HipPath& path);

/// Says in one sentence, with the cure, that @p path, in metres and seconds, is likely to be in other units;
/// else empty. A hand reaches 2 m, moves by millimetres a second at least, and is sampled more often than
/// once in half a second. @p cloud: box of the felt points, metres; may be empty. Costs a pass over the path.
std::string unlikelyUnits(const HipPath& path, const Bounds& cloud, const UnitNames& names = {});
/// Says that a @p path which passes @p cloud without a touch would fit it in another unit of the cloud; else
/// empty.
std::string unlikelyCloudUnit(const HipPath& path, const Bounds& cloud, const UnitNames& names = {});

} // namespace pointhaptics
