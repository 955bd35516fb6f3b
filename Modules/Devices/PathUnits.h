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

/// Options that choose units. Empty: there are none, and the cure is to multiply the numbers.
struct UnitNames
{
  std::string cloud;
  std::string path;
  std::string time;
};

/// Converts the numbers of @p path to metres and seconds.
void applyUnits(const PathUnits& units, HipPath& path);

/// A hand reaches 2 m, moves by millimetres a second at least, and is told more often than once in half a
/// second. Where @p path, in metres and seconds, does not, and would in other units, says so in one sentence
/// with the cure; else empty. @p cloud: box of what is felt, metres; may be empty. @p isTouched: false where
/// the path has passed the cloud, which then may be in another unit. @p isCloudKnown: the unit of the cloud
/// is not doubted, as somebody chose it or its file says it. Costs a pass over the path.
std::string unlikelyUnits(const HipPath& path, const Bounds& cloud, const UnitNames& names = {},
  bool isTouched = true, bool isCloudKnown = false);

} // namespace pointhaptics
