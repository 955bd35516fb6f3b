/// @file
/// Points of a chunk in the order of their voxels' keys: for lattices that are not divided into partitions.
#pragma once

#include "Core/Base/Executor.h"
#include "Core/Base/Lattice.h"
#include "Core/Resample/Kernel/VoxelKernel.h"
#include "Core/Resample/Stages/PointChunks.h"
#include "Core/Resample/Stages/VoxelRuns.h"

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace pointhaptics
{
namespace simd
{

/// Points of a chunk on this path.
constexpr std::int64_t kSortedChunk = std::int64_t(1) << 18;

/// Threads quantize and sort slices of a chunk, and sum each. Then they take ranges of keys, and add what the
/// slices have of them: no two threads have a voxel in common.
class SortedPoints
{
public:
  /// A point inside: its voxel, its number among the chunks' points, and its offset in the voxel.
  struct Entry
  {
    std::uint64_t key;
    std::int64_t point;
    std::uint64_t offset[3];
  };

  void prepare(const PointQuantizer& quantizer, const Lattice& lattice)
  {
    quantizer_ = quantizer;
    lattice_ = lattice;
  }
  /// Sorts the points of each slice of a chunk.
  void sort(const Chunks& chunks, std::size_t chunk, const Executor& executor);
  /// Chooses ranges with about as many points each, by some of the points. @return no sums for each.
  std::vector<VoxelRuns> chooseRanges(const PointView& points);
  /// Adds the sums of the points to their ranges.
  void sum(bool secondMoments, std::vector<VoxelRuns>& ranges, const Executor& executor);
  std::size_t slices() const { return slices_.size(); }
  /// Those of a slice with keys from @p first to @p last.
  std::pair<const Entry*, const Entry*> entries(
    std::size_t slice, std::uint64_t first, std::uint64_t last) const;
  std::int64_t inside() const;
  std::int64_t invalid() const;
  std::size_t bytes() const;

private:
  struct Slice
  {
    std::vector<Entry> entries;
    std::size_t size = 0;
    VoxelRun run; ///< Their sums.
    std::int64_t invalid = 0;
  };
  void quantize(const PointView& points, PointRange range, Slice& slice) const;
  static void sumSlice(bool secondMoments, Slice& slice);

  PointQuantizer quantizer_{};
  Lattice lattice_;
  std::vector<Slice> slices_;
  std::vector<std::uint64_t> starts_; ///< Of the ranges, and an end.
};

} // namespace simd
} // namespace pointhaptics
