/// @file
/// The right answer of a resampling, by sorting and long double, and how far an answer is from it.
#pragma once

#include "Benchmark/Resample/Rivals/Rival.h"

#include "Core/Base/Lattice.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace pointhaptics::bench::resample
{

struct ExpectedMeans
{
  std::vector<std::uint64_t> keys; ///< Ascending.
  std::vector<std::int64_t> counts;
  std::vector<std::array<long double, 3>> means;
};

/// @p points finite, about 24 bytes each while it runs. Points outside the lattice are left out. Gives what
/// Core/Reference/ReferenceVoxelMean.h gives (a test says so), in less memory.
ExpectedMeans expectedMeans(const PointView& points, const Lattice& lattice);

struct Verdict
{
  bool right = false;
  std::int64_t voxels = 0;
  std::int64_t expectedVoxels = 0;
  std::int64_t wrongVoxels = 0; ///< Missing, surplus, with a wrong count or a mean off by more than rounding.
  double worstError = 0.0;      ///< Largest coordinate error of a mean in voxels, where it lies in its voxel.
  std::string text;             ///< For the table.
};

/// In ExactMeans and TheirVoxels nothing may be wrong, the order must be by key, and means may differ by
/// 2^-31 voxel and by rounding to float. Of Means one voxel in a thousand, or one in ten thousand points, may
/// be wrong (points at faces), means by 1e-3 voxel.
Verdict judge(const ResampleAnswer& answer, const ExpectedMeans& expected, ComparedWith with);

} // namespace pointhaptics::bench::resample
