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

/// Points of a slice, about: they stay in the second-level cache.
constexpr std::int64_t kSlicePoints = 1 << 14;
/// Points whose keys the ranges are chosen by, how many a range must have, and how many there are at most.
constexpr std::int64_t kSamples = 1 << 14;
constexpr std::size_t kSamplesPerRange = 16;
constexpr std::size_t kMostRanges = 64;

}

std::vector<VoxelRuns> SortedPoints::chooseRanges(const PointView& points)
{
  Slice sample;
  for (std::int64_t i = 0; i < points.size(); i += points.size() / kSamples + 1)
  {
    quantize(points, { i, i + 1 }, sample);
  }
  std::vector<Entry>& entries = sample.entries;
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.key < b.key; });
  const std::size_t ranges = std::clamp<std::size_t>(entries.size() / kSamplesPerRange, 1, kMostRanges);
  starts_.assign(1, 0);
  for (std::size_t range = 1; range < ranges; ++range)
  {
    starts_.push_back(entries[range * entries.size() / ranges].key);
  }
  starts_.push_back(~std::uint64_t(0));
  return std::vector<VoxelRuns>(ranges);
}

void SortedPoints::sort(const Chunks& chunks, std::size_t chunk, const Executor& executor)
{
  slices_.resize(std::size_t(chunks.pointCount(chunk) / kSlicePoints + 1));
  forEachItem<std::vector<Entry>>(executor, slices_.size(),
    [&](std::size_t s, std::vector<Entry>& other)
    {
      const auto firstPiece = [&](std::size_t slice)
      {
        return chunks.pieces(chunk) +
          chunks.pieceCount(chunk) * std::int64_t(slice) / std::int64_t(slices_.size());
      };
      Slice& slice = slices_[s];
      slice.entries.clear();
      slice.invalid = 0;
      for (const PointRange* piece = firstPiece(s); piece != firstPiece(s + 1); ++piece)
      {
        quantize(chunks.points(), *piece, slice);
      }
      slice.size = slice.entries.size();
      other.resize(std::max(other.size(), slice.size));
      radixSort(slice.entries, other, slice.size, [](const Entry& entry) { return entry.key; });
    });
}

void SortedPoints::quantize(const PointView& points, PointRange range, Slice& slice) const
{
  const std::uint64_t mask = (std::uint64_t(1) << quantizer_.fractionBits) - 1;
  for (std::int64_t i = range.begin; i < range.end; ++i)
  {
    std::uint64_t position[3];
    const PointLocation location = quantizePoint(quantizer_, points[i], position);
    slice.invalid += location == PointLocation::Invalid;
    if (location == PointLocation::Inside)
    {
      const auto index = [&](int axis) { return std::int64_t(position[axis] >> quantizer_.fractionBits); };
      slice.entries.push_back({ lattice_.key(index(0), index(1), index(2)), i,
        { position[0] & mask, position[1] & mask, position[2] & mask } });
    }
  }
}

void SortedPoints::sum(bool secondMoments, std::vector<VoxelRuns>& ranges, const Executor& executor)
{
  forEachItem(executor, slices_.size(), [&](std::size_t s) { sumSlice(secondMoments, slices_[s]); });
  forEachItem(executor, ranges.size(),
    [&](std::size_t range)
    {
      for (const Slice& slice : slices_)
      {
        VoxelRun part;
        part.append(slice.run, slice.run.find(starts_[range]), slice.run.find(starts_[range + 1]));
        ranges[range].add(std::move(part));
      }
    });
}

void SortedPoints::sumSlice(bool secondMoments, Slice& slice)
{
  static_assert(2 * kSortedChunk <= std::int64_t(1) << (64 - kPositionBits), "sums of a chunk fit 64 bits");
  const SecondMoments none{};
  VoxelRun& run = slice.run;
  run.clear();
  for (std::size_t i = 0; i < slice.size; ++i)
  {
    const Entry& entry = slice.entries[i];
    if (i == 0 || slice.entries[i - 1].key != entry.key)
    {
      run.push({ entry.key, 0, { 0, 0, 0 }, 0 }, secondMoments ? &none : nullptr);
    }
    WideSums& voxel = run.voxels.back();
    ++voxel.count;
    for (int axis = 0; axis < 3; ++axis)
    {
      voxel.low[axis] += entry.offset[axis];
    }
    if (secondMoments)
    {
      addProducts(run.secondMoments.back(), entry.offset[0], entry.offset[1], entry.offset[2]);
    }
  }
}

std::pair<const SortedPoints::Entry*, const SortedPoints::Entry*> SortedPoints::entries(
  std::size_t slice, std::uint64_t first, std::uint64_t last) const
{
  const Entry* const begin = slices_[slice].entries.data();
  const Entry* const end = begin + slices_[slice].size;
  return { std::partition_point(begin, end, [=](const Entry& entry) { return entry.key < first; }),
    std::partition_point(begin, end, [=](const Entry& entry) { return entry.key <= last; }) };
}

std::int64_t SortedPoints::inside() const
{
  return std::accumulate(slices_.begin(), slices_.end(), std::int64_t(0),
    [](std::int64_t sum, const Slice& slice) { return sum + std::int64_t(slice.size); });
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
