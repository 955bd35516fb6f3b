/// @file
/// The sums of an accumulator. Private to Core.
#pragma once

#include "Core/Resample/Stages/VoxelRuns.h"
#include "Core/Resample/VoxelAccumulator.h"

#include <cstdint>

namespace pointhaptics
{

/// Sums of the points of some calls.
class VoxelAccumulator::Sums
{
public:
  simd::VoxelRuns runs;
  std::int64_t points = 0;
  std::int64_t clipped = 0;
  std::int64_t invalid = 0;
};

} // namespace pointhaptics
