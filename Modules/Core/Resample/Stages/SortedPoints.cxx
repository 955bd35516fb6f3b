#include "Core/Resample/Stages/SortedPoints.h"

#include "Core/Base/RadixSort.h"
#include "Core/Resample/Stages/PointQuantizer.h"

#include <algorithm>
#include <numeric>

namespace pointhaptics
{
namespace simd
{
namespace
{

/// Keys the ranges are chosen by, how many a range must have of them, and how many ranges there are at most.
constexpr std::int64_t kSamples = 8192;
constexpr std::size_t kSamplesPerRange = 32;
constexpr std::size_t kMostRanges = 64;
/// Points of a slice, at least: their positions stay in the second-level cache.
constexpr std::int64_t kSlicePoints = 1 << 14;

}

std::uint64_t SortedPoints::keyOf(const Position& position) const
{
  const auto index = [&](int axis) { return std::int64_t(position.onAxis[axis] >> quantizer_.fractionBits); };
  return lattice_.key(index(0), index(1), index(2));
}

void SortedPoints::choose(const PointQuantizer& quantizer, const Lattice& lattice, const Chunks& chunks)
{
  quantizer_ = quantizer;
  lattice_ = lattice;
  std::int64_t pieces = 0;
  for (std::size_t chunk = 0; chunk < chunks.count(); ++chunk)
  {
    pieces += chunks.pieceCount(chunk);
  }
  const std::int64_t ofPiece = kSamples / std::max<std::int64_t>(pieces, 1) + 1;
  const std::int64_t step = pieces / kSamples + 1;
  std::vector<std::uint64_t> keys;
  for (std::size_t chunk = 0; chunk < chunks.count(); ++chunk)
  {
    for (std::int64_t p = 0; p < chunks.pieceCount(chunk); p += step)
    {
      const PointRange piece = chunks.pieces(chunk)[p];
      for (std::int64_t i = piece.begin; i < piece.end; i += (piece.end - piece.begin) / ofPiece + 1)
      {
        Position position;
        if (quantizePoint(quantizer, chunks.points()[i], position.onAxis) == PointLocation::Inside)
        {
          keys.push_back(keyOf(position));
        }
      }
    }
  }
  std::sort(keys.begin(), keys.end());
  const std::size_t ranges = std::clamp<std::size_t>(keys.size() / kSamplesPerRange, 1, kMostRanges);
  starts_.assign(1, 0);
  for (std::size_t range = 1; range < ranges; ++range)
  {
    starts_.push_back(keys[range * keys.size() / ranges]);
  }
  starts_.push_back(~std::uint64_t(0));
}

/// Divides a chunk into slices of whole pieces.
void SortedPoints::cut(const Chunks& chunks, std::size_t chunk)
{
  std::size_t slices = 0;
  std::int64_t points = 0;
  for (std::int64_t p = 0; p < chunks.pieceCount(chunk); ++p)
  {
    if (points == 0)
    {
      slices_.resize(std::max(slices_.size(), slices + 1));
      slices_[slices++].firstPiece = p;
    }
    const PointRange piece = chunks.pieces(chunk)[p];
    points += piece.end - piece.begin;
    slices_[slices - 1].lastPiece = p + 1;
    points = points < kSlicePoints ? points : 0;
  }
  slices_.resize(slices);
}

void SortedPoints::sortSlice(
  const Chunks& chunks, std::size_t chunk, bool keepsPositions, Slice& slice, Scratch& scratch) const
{
  slice.entries.clear();
  slice.invalid = 0;
  scratch.positions.clear();
  for (std::int64_t p = slice.firstPiece; p < slice.lastPiece; ++p)
  {
    const PointRange piece = chunks.pieces(chunk)[p];
    for (std::int64_t i = piece.begin; i < piece.end; ++i)
    {
      Position position;
      const PointLocation location = quantizePoint(quantizer_, chunks.points()[i], position.onAxis);
      slice.invalid += location == PointLocation::Invalid;
      if (location == PointLocation::Inside)
      {
        slice.entries.push_back(
          { keyOf(position), keepsPositions ? std::int64_t(scratch.positions.size()) : i });
        scratch.positions.push_back(position);
      }
    }
  }
  slice.inside = std::int64_t(slice.entries.size());
  scratch.other.resize(slice.entries.size());
  radixSort(slice.entries, scratch.other, slice.entries.size(), [](const Entry& entry) { return entry.key; });
}

void SortedPoints::sumSlice(bool secondMoments, Slice& slice, const Scratch& scratch) const
{
  static_assert(2 * kSortedChunk <= std::int64_t(1) << (64 - kPositionBits), "sums of a chunk fit 64 bits");
  const std::uint64_t mask = (std::uint64_t(1) << quantizer_.fractionBits) - 1;
  const SecondMoments none{};
  slice.run.clear();
  for (const Entry& entry : slice.entries)
  {
    if (slice.run.voxels.empty() || slice.run.voxels.back().key != entry.key)
    {
      slice.run.push({ entry.key, 0, { 0, 0, 0 }, 0 }, secondMoments ? &none : nullptr);
    }
    const std::uint64_t* position = scratch.positions[std::size_t(entry.point)].onAxis;
    WideSums& voxel = slice.run.voxels.back();
    ++voxel.count;
    for (int axis = 0; axis < 3; ++axis)
    {
      voxel.low[axis] += position[axis] & mask;
    }
    if (secondMoments)
    {
      addProducts(slice.run.secondMoments.back(), position[0] & mask, position[1] & mask, position[2] & mask);
    }
  }
}

void SortedPoints::sort(const Chunks& chunks, std::size_t chunk, const Executor& executor)
{
  cut(chunks, chunk);
  forEachItem<Scratch>(executor, slices_.size(),
    [&](std::size_t slice, Scratch& scratch) { sortSlice(chunks, chunk, false, slices_[slice], scratch); });
}

void SortedPoints::sum(
  const Chunks& chunks, std::size_t chunk, bool secondMoments, VoxelRuns& runs, const Executor& executor)
{
  cut(chunks, chunk);
  forEachItem<Scratch>(executor, slices_.size(),
    [&](std::size_t slice, Scratch& scratch)
    {
      sortSlice(chunks, chunk, true, slices_[slice], scratch);
      sumSlice(secondMoments, slices_[slice], scratch);
    });
  forEachItem(executor, ranges(),
    [&](std::size_t range)
    {
      for (const Slice& slice : slices_)
      {
        VoxelRun part;
        part.append(
          slice.run, place(slice.run.voxels, starts_[range]), place(slice.run.voxels, starts_[range + 1]));
        runs.add(range, std::move(part));
      }
    });
}

std::int64_t SortedPoints::inside() const
{
  return std::accumulate(slices_.begin(), slices_.end(), std::int64_t(0),
    [](std::int64_t sum, const Slice& slice) { return sum + slice.inside; });
}

std::int64_t SortedPoints::invalid() const
{
  return std::accumulate(slices_.begin(), slices_.end(), std::int64_t(0),
    [](std::int64_t sum, const Slice& slice) { return sum + slice.invalid; });
}

std::size_t SortedPoints::bytes() const
{
  return std::accumulate(slices_.begin(), slices_.end(), std::size_t(0),
    [](std::size_t sum, const Slice& slice)
    { return sum + slice.run.bytes() + slice.entries.capacity() * sizeof(Entry); });
}

} // namespace simd
} // namespace pointhaptics
