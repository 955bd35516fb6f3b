/// @file
/// Number of servo ticks that a hand path takes.
#pragma once

#include "Devices/PathUnits.h"

#include "PointHapticsSceneModule.h" // For export macro

#include <cstdint>
#include <string>

namespace pointhaptics
{

/// Why nobody can follow @p path, with row, value and cure: it has no point, a number is not finite, or times
/// do not ascend. Empty: nothing is wrong.
POINTHAPTICSSCENE_EXPORT std::string pathProblem(const HipPath& path);

/// Ticks of @p rateHz from the path's first point to its last, both included. False where they are more than
/// @p most:
/// @p message then says so, with @p fileName and the cure, which may be one of @p units (unlikelyUnits()).
/// @pre the path is not empty.
POINTHAPTICSSCENE_EXPORT bool countTicks(const HipPath& path, const std::string& fileName, double rateHz,
  double most, std::int64_t& ticks, std::string& message, const UnitNames& units = {});

} // namespace pointhaptics
