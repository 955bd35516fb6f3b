/// @file
/// Points of a chunk, binned into ranges of their voxels' keys: for lattices whose positions do not fit the
/// records of PointRecordPool.
#pragma once

#include "Core/Base/Buffer.h"
#include "Core/Base/Executor.h"
#include "Core/Base/Lattice.h"
#include "Core/Resample/Kernel/VoxelKernel.h"
#include "Core/Resample/Stages/PointChunks.h"
#include "Core/Resample/Stages/VoxelRuns.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pointhaptics
{
namespace simd
{

/// Points of a chunk on this path.
constexpr std::int64_t kGeneralChunk = std::int64_t(1) << 19;

/// Ranges with about as many points each, and the points of a chunk in each of them. Keys ascend from range
/// to range. Different ranges may be read by several threads at once.
class KeyRanges
{
public:
  struct Entry
  {
    std::uint64_t key;
    std::uint32_t point; ///< Counted in the chunk.
  };
  /// Points of a range in the order of their keys.
  struct Sorted
  {
    Buffer<Entry> entries;
    Buffer<Entry> other;
    std::size_t size = 0;
  };

  /// Chooses ranges by the keys of some of the points.
  void choose(const PointQuantizer& quantizer, const Lattice& lattice, const Chunks& chunks);
  std::size_t count() const { return count_; }
  /// Quantizes and bins the points of a chunk. @p numbered: for pointOf().
  void bin(const PointQuantizer& quantizer, const Lattice& lattice, const Chunks& chunks, std::size_t chunk,
    bool numbered, const Executor& executor);
  std::int64_t inside() const { return std::int64_t(begins_[count_]); }
  std::int64_t invalid() const { return invalid_; }
  /// Sorts the points of a range.
  void sort(std::size_t range, Sorted& sorted) const;
  /// The sums of a range's voxels.
  VoxelRun sumsOf(std::size_t range, Sorted& scratch, bool secondMoments) const;
  /// The number among the chunks' points.
  std::int64_t pointOf(std::uint32_t point) const { return numbers_[point]; }
  std::size_t bytes() const;

private:
  static constexpr int kRangeBits = 6;
  static constexpr std::size_t kMostRanges = std::size_t(1) << kRangeBits;
  static constexpr std::uint8_t kNowhere = 255;

  /// voxel index << fractionBits | offset in the voxel
  struct QuantizedPoint
  {
    std::uint64_t position[3];
  };
  /// Pieces of a chunk, at least kPieceSize points together where there are as many.
  struct Slice
  {
    std::int64_t firstPiece;
    std::size_t firstPoint;
  };

  /// Branch-free: the branches would be unpredictable.
  std::size_t rangeOf(std::uint64_t key) const
  {
    std::size_t range = 0;
    for (int bit = kRangeBits - 1; bit >= 0; --bit)
    {
      const std::size_t step = std::size_t(1) << bit;
      range |= std::size_t(key >= starts_[range + step - 1]) << bit;
    }
    return range;
  }
  std::uint64_t keyOf(const QuantizedPoint& placed) const
  {
    return lattice_.key(std::int64_t(placed.position[0] >> fractionBits_),
      std::int64_t(placed.position[1] >> fractionBits_), std::int64_t(placed.position[2] >> fractionBits_));
  }
  void cut(const Chunks& chunks, std::size_t chunk);
  std::int64_t quantizeSlice(const PointQuantizer& quantizer, const Chunks& chunks, std::size_t chunk,
    std::size_t slice, bool numbered);
  void binSlice(std::size_t slice);

  std::size_t count_ = 1;
  std::array<std::uint64_t, kMostRanges - 1> starts_{}; ///< Of all ranges but the first.
  Lattice lattice_;
  int fractionBits_ = 0;
  std::int64_t invalid_ = 0;
  std::vector<Slice> slices_; ///< And an end.
  Buffer<QuantizedPoint> quantized_;
  Buffer<std::uint8_t> rangeOf_;
  Buffer<std::int64_t> numbers_;
  /// How many points of a slice go to each range; then where the next one of them goes.
  std::vector<std::uint32_t> offsets_;
  std::array<std::uint32_t, kMostRanges + 1> begins_{}; ///< Of the ranges in order_.
  Buffer<std::uint32_t> order_;                         ///< Points, range by range.
};

} // namespace simd
} // namespace pointhaptics
