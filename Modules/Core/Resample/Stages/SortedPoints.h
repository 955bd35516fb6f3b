/// @file
/// Points of a chunk in the order of their voxels' keys: for lattices that are not divided into partitions.
#pragma once

#include "Core/Base/Executor.h"
#include "Core/Base/Lattice.h"
#include "Core/Resample/Kernel/VoxelKernel.h"
#include "Core/Resample/Stages/PointChunks.h"
#include "Core/Resample/Stages/VoxelRuns.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pointhaptics
{
namespace simd
{

/// Points of a chunk on this path.
constexpr std::int64_t kSortedChunk = std::int64_t(1) << 18;

/// Threads quantize and sort slices of a chunk. Then they take ranges of keys, about as many points each, and
/// find those of a range in all slices: no two of them have a voxel in common.
class SortedPoints
{
public:
  /// A point inside, and where it is: its number among the chunks' points, or its position's in the slice.
  struct Entry
  {
    std::uint64_t key;
    std::int64_t point;
  };

  /// Chooses the ranges by the keys of some of the points.
  void choose(const PointQuantizer& quantizer, const Lattice& lattice, const Chunks& chunks);
  std::size_t ranges() const { return starts_.size() - 1; }
  /// Sorts the points of a chunk, for forEntries().
  void sort(const Chunks& chunks, std::size_t chunk, const Executor& executor);
  /// Calls visit(first, last) with the entries of a range, in several pieces that ascend.
  template <typename Visit>
  void forEntries(std::size_t range, Visit&& visit) const
  {
    for (const Slice& slice : slices_)
    {
      visit(slice.entries.data() + place(slice.entries, starts_[range]),
        slice.entries.data() + place(slice.entries, starts_[range + 1]));
    }
  }
  /// Sums the points of a chunk, and adds the sums to the runs of their ranges.
  void sum(
    const Chunks& chunks, std::size_t chunk, bool secondMoments, VoxelRuns& runs, const Executor& executor);
  /// Of the last chunk.
  std::int64_t inside() const;
  std::int64_t invalid() const;
  std::size_t bytes() const;

private:
  struct Position
  {
    std::uint64_t onAxis[3];
  };
  struct Slice
  {
    std::int64_t firstPiece = 0;
    std::int64_t lastPiece = 0;
    std::vector<Entry> entries;
    VoxelRun run;
    std::int64_t inside = 0;
    std::int64_t invalid = 0;
  };
  struct Scratch
  {
    std::vector<Entry> other;
    std::vector<Position> positions;
  };
  /// The first of elements with a key of at least @p key.
  template <typename Element>
  static std::size_t place(const std::vector<Element>& elements, std::uint64_t key)
  {
    return std::size_t(std::lower_bound(elements.begin(), elements.end(), key,
                         [](const Element& element, std::uint64_t k) { return element.key < k; }) -
      elements.begin());
  }
  std::uint64_t keyOf(const Position& position) const;
  void cut(const Chunks& chunks, std::size_t chunk);
  void sortSlice(
    const Chunks& chunks, std::size_t chunk, bool keepsPositions, Slice& slice, Scratch& scratch) const;
  void sumSlice(bool secondMoments, Slice& slice, const Scratch& scratch) const;

  PointQuantizer quantizer_{};
  Lattice lattice_;
  std::vector<std::uint64_t> starts_; ///< Of the ranges, and an end.
  std::vector<Slice> slices_;
};

} // namespace simd
} // namespace pointhaptics
