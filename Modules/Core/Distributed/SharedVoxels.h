/// @file
/// Mean resampling of a cloud whose points lie on several ranks: each rank accumulates its own, and the sums
/// of voxels are exchanged and merged.
#pragma once

#include "Core/Base/PointView.h"
#include "Core/Base/Status.h"
#include "Core/Distributed/Ranks.h"
#include "Core/Resample/VoxelAccumulator.h"

#include <cstdint>
#include <vector>

namespace pointhaptics
{

/// The box about those of all ranks.
Bounds commonBounds(Ranks& ranks, const Bounds& own);

/// Which keys of voxels belong to which rank: contiguous ranges with about as many of the voxels that ranks
/// have; rank r has those from [r] to before [r + 1]. Collective. @p own: the keys that this rank has points
/// for, ascending.
std::vector<std::uint64_t> shareKeys(Ranks& ranks, const std::vector<std::uint64_t>& own);

/// Returns for each of the keys @p own, ascending, the number that the rank of its range gives it; -1 where
/// it has none. Collective; 16 bytes a key are sent. @p ranges: of shareKeys(). @p keys, ascending, and @p
/// numbers: of this rank's range.
std::vector<std::int64_t> numbersOfKeys(Ranks& ranks, const std::vector<std::uint64_t>& ranges,
  const std::vector<std::uint64_t>& own, const std::vector<std::uint64_t>& keys,
  const std::vector<std::int64_t>& numbers);

/// Collective: gives each rank all sums of the voxels in its range of keys. @p voxels: before, the sums of
/// the points of this rank, on the same lattice on all; afterwards those of its range. Points outside the
/// lattice and those not finite are counted on one rank. @p ranges: of shareKeys().
///
/// Voxels are exact sums, so it makes no difference where they are merged: the voxels of all ranks, one rank
/// after the other, are those of one run over all points, bit for bit, however the points are split. What is
/// sent is in proportion to the active voxels (48 bytes each, 144 with covariances, and the sums of arrays),
/// not to the points.
///
/// Errors, on all ranks: InvalidParameter (other lattices or arrays, more points than an accumulator takes).
Status shareVoxels(Ranks& ranks, const std::vector<std::uint64_t>& ranges, VoxelAccumulator& voxels);

} // namespace pointhaptics
