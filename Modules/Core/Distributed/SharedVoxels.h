/// @file
/// Mean resampling of a cloud whose points lie on several ranks: each rank accumulates its own, and the sums
/// of voxels are exchanged and merged.
#pragma once

#include "Core/Base/PointView.h"
#include "Core/Base/Status.h"
#include "Core/Distributed/Ranks.h"
#include "Core/Resample/AttributeMean.h"
#include "Core/Resample/AttributeTuples.h"
#include "Core/Resample/VoxelAccumulator.h"

#include <cstdint>
#include <vector>

namespace pointhaptics
{

/// The box about those of all ranks.
Bounds commonBounds(Ranks& ranks, const Bounds& own);
/// The range of an array whose values lie on all ranks.
AttributeRange commonRange(Ranks& ranks, const AttributeRange& own);
/// The sum of the numbers of all ranks, on each.
std::int64_t commonSum(Ranks& ranks, std::int64_t own);

/// Which rank gets which voxels: contiguous ranges of keys with about as many voxels each.
///
/// Voxels are exact sums, so it makes no difference where they are merged: the voxels of all ranks, one rank
/// after the other, are those of one run over all points, bit for bit, however the points are split. What is
/// sent is in proportion to the active voxels (64 bytes each, 160 with covariances, and the sums of arrays),
/// not to the points. One thread at a time.
class SharedVoxels
{
public:
  /// @p own: the sums of the points of this rank, all of them on the same lattice. @p levels: the cells of so
  /// many levels are not cut by the ranges. Afterwards voxels() are the merged ones of this rank's range.
  /// Errors, on all ranks: InvalidParameter (other lattices, more points than an accumulator takes).
  Status share(Ranks& ranks, VoxelAccumulator& own, int levels = 1);
  VoxelAccumulator& voxels() { return voxels_; }
  /// Points outside the lattice and those not finite, of all ranks.
  std::int64_t clippedPoints() const { return clipped_; }
  std::int64_t invalidPoints() const { return invalid_; }

  /// Exchanges what an array has in the voxels of share(): @p own has one entry for each voxel of this rank's
  /// points, @p merged, just prepared, one for each of voxels(). Tuples: AttributeMean, AttributeTuples, AttributeReducer.
  /// @return false on ranks that got what does not fit.
  template <typename Tuples>
  bool exchange(Ranks& ranks, const Tuples& own, Tuples& merged) const
  {
    std::vector<std::string> messages(places_.size());
    for (std::size_t r = 0; r < messages.size(); ++r)
    {
      own.serialize(ends_[r], ends_[r + 1], messages[r]);
    }
    messages = ranks.exchange(std::move(messages));
    bool fits = true;
    for (std::size_t r = 0; r < messages.size(); ++r)
    {
      fits = merged.merge(messages[r], places_[r]) && fits;
    }
    return fits;
  }

private:
  std::vector<std::uint64_t> chooseCuts(Ranks& ranks, VoxelAccumulator& own, int levels) const;
  Status merge(const std::vector<std::string>& messages, VoxelAccumulator& own);
  void findEnds(const std::vector<std::uint64_t>& ownKeys, const std::vector<std::uint64_t>& cuts);

  VoxelAccumulator voxels_{ Lattice() };
  std::int64_t clipped_ = 0;
  std::int64_t invalid_ = 0;
  std::vector<std::int64_t> ends_;                ///< Of the own voxels for each rank; 0 before the first.
  std::vector<std::vector<std::int64_t>> places_; ///< In voxels(), of those that each rank sent.
};

} // namespace pointhaptics
