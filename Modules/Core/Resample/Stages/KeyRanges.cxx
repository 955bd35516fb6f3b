#include "Core/Resample/Stages/KeyRanges.h"

#include "Core/Base/RadixSort.h"
#include "Core/Resample/Stages/PointQuantizer.h"

#include <algorithm>
#include <utility>

namespace pointhaptics
{
namespace simd
{
namespace
{

/// Keys the ranges are chosen by, and how many a range must have of them.
constexpr std::int64_t kSamples = 8192;
constexpr std::size_t kSamplesPerRange = 32;
/// Entries ahead whose points are fetched.
constexpr std::size_t kAhead = 16;

}

void KeyRanges::choose(const PointQuantizer& quantizer, const Lattice& lattice, const Chunks& chunks)
{
  lattice_ = lattice;
  fractionBits_ = quantizer.fractionBits;
  std::int64_t points = 0;
  for (std::size_t chunk = 0; chunk < chunks.count(); ++chunk)
  {
    points += chunks.pointCount(chunk);
  }
  const std::int64_t step = std::max<std::int64_t>(1, points / kSamples);
  std::vector<std::uint64_t> keys;
  std::int64_t skipped = 0; // Points before the next sample.
  for (std::size_t chunk = 0; chunk < chunks.count(); ++chunk)
  {
    for (std::int64_t p = 0; p < chunks.pieceCount(chunk); ++p)
    {
      const PointRange piece = chunks.pieces(chunk)[p];
      std::int64_t i = piece.begin + skipped;
      for (; i < piece.end; i += step)
      {
        QuantizedPoint placed;
        if (quantizePoint(quantizer, chunks.points()[i], placed.position) == PointLocation::Inside)
        {
          keys.push_back(keyOf(placed));
        }
      }
      skipped = i - piece.end;
    }
  }
  std::sort(keys.begin(), keys.end());
  count_ = std::min(std::max<std::size_t>(keys.size() / kSamplesPerRange, 1), kMostRanges);
  starts_.fill(~std::uint64_t(0));
  for (std::size_t range = 1; range < count_; ++range)
  {
    starts_[range - 1] = keys[range * keys.size() / count_];
  }
}

void KeyRanges::cut(const Chunks& chunks, std::size_t chunk)
{
  slices_.clear();
  std::size_t points = 0;
  const std::int64_t pieces = chunks.pieceCount(chunk);
  for (std::int64_t p = 0; p < pieces; ++p)
  {
    if (slices_.empty() || points - slices_.back().firstPoint >= std::size_t(kPieceSize))
    {
      slices_.push_back({ p, points });
    }
    const PointRange piece = chunks.pieces(chunk)[p];
    points += std::size_t(piece.end - piece.begin);
  }
  slices_.push_back({ pieces, points });
}

void KeyRanges::bin(const PointQuantizer& quantizer, const Lattice& lattice, const Chunks& chunks,
  std::size_t chunk, bool numbered, const Executor& executor)
{
  lattice_ = lattice;
  fractionBits_ = quantizer.fractionBits;
  cut(chunks, chunk);
  const std::size_t slices = slices_.size() - 1;
  const std::size_t points = slices_.back().firstPoint;
  quantized_.reserve(points, Pages::Huge);
  rangeOf_.reserve(points);
  order_.reserve(points);
  numbers_.reserve(numbered ? points : 0);
  offsets_.assign(slices * count_, 0);
  std::atomic<std::int64_t> invalid{ 0 };
  forRange(executor, std::int64_t(slices), 1,
    [&](std::int64_t begin, std::int64_t end)
    {
      std::int64_t bad = 0;
      for (std::int64_t slice = begin; slice < end; ++slice)
      {
        bad += quantizeSlice(quantizer, chunks, chunk, std::size_t(slice), numbered);
      }
      invalid += bad;
    });
  invalid_ = invalid;
  std::uint32_t sum = 0;
  for (std::size_t range = 0; range < count_; ++range)
  {
    begins_[range] = sum;
    for (std::size_t slice = 0; slice < slices; ++slice)
    {
      std::uint32_t& offset = offsets_[slice * count_ + range];
      sum += std::exchange(offset, sum);
    }
  }
  begins_[count_] = sum;
  forRange(executor, std::int64_t(slices), 1,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t slice = begin; slice < end; ++slice)
      {
        binSlice(std::size_t(slice));
      }
    });
}

/// @return the number of points that are not finite.
std::int64_t KeyRanges::quantizeSlice(
  const PointQuantizer& quantizer, const Chunks& chunks, std::size_t chunk, std::size_t slice, bool numbered)
{
  std::int64_t invalid = 0;
  std::uint32_t* counts = offsets_.data() + slice * count_;
  std::size_t to = slices_[slice].firstPoint;
  for (std::int64_t p = slices_[slice].firstPiece; p < slices_[slice + 1].firstPiece; ++p)
  {
    const PointRange piece = chunks.pieces(chunk)[p];
    for (std::int64_t i = piece.begin; i < piece.end; ++i, ++to)
    {
      const PointLocation location = quantizePoint(quantizer, chunks.points()[i], quantized_[to].position);
      invalid += location == PointLocation::Invalid;
      rangeOf_[to] = kNowhere;
      if (location == PointLocation::Inside)
      {
        const std::size_t range = rangeOf(keyOf(quantized_[to]));
        rangeOf_[to] = std::uint8_t(range);
        ++counts[range];
      }
      if (numbered)
      {
        numbers_[to] = i;
      }
    }
  }
  return invalid;
}

void KeyRanges::binSlice(std::size_t slice)
{
  std::uint32_t* offsets = offsets_.data() + slice * count_;
  for (std::size_t i = slices_[slice].firstPoint; i < slices_[slice + 1].firstPoint; ++i)
  {
    if (rangeOf_[i] != kNowhere)
    {
      order_[offsets[rangeOf_[i]]++] = std::uint32_t(i);
    }
  }
}

void KeyRanges::sort(std::size_t range, Sorted& sorted) const
{
  const std::uint32_t* points = order_.data() + begins_[range];
  sorted.size = begins_[range + 1] - begins_[range];
  sorted.entries.reserve(sorted.size);
  sorted.other.reserve(sorted.size);
  for (std::size_t i = 0; i < sorted.size; ++i)
  {
    __builtin_prefetch(&quantized_[points[std::min(i + kAhead, sorted.size - 1)]]);
    sorted.entries[i] = { keyOf(quantized_[points[i]]), points[i] };
  }
  radixSort(sorted.entries, sorted.other, sorted.size, [](const Entry& entry) { return entry.key; });
}

VoxelRun KeyRanges::sumsOf(std::size_t range, Sorted& scratch, bool secondMoments) const
{
  sort(range, scratch);
  const Buffer<Entry>& entries = scratch.entries;
  std::size_t voxels = 0;
  for (std::size_t i = 0; i < scratch.size; ++i)
  {
    voxels += i == 0 || entries[i].key != entries[i - 1].key;
  }
  VoxelRun run;
  run.voxels.reserve(voxels);
  run.secondMoments.reserve(secondMoments ? voxels : 0);
  const std::uint64_t mask = (std::uint64_t(1) << fractionBits_) - 1;
  for (std::size_t i = 0; i < scratch.size; ++i)
  {
    __builtin_prefetch(&quantized_[entries[std::min(i + kAhead, scratch.size - 1)].point]);
    if (i == 0 || entries[i].key != entries[i - 1].key)
    {
      run.voxels.push_back({ entries[i].key, 0, { 0, 0, 0 }, 0 });
      if (secondMoments)
      {
        run.secondMoments.push_back(SecondMoments{ { 0, 0, 0, 0, 0, 0 } });
      }
    }
    static_assert(kGeneralChunk <= std::int64_t(1) << (64 - kPositionBits), "sums of a chunk fit 64 bits");
    const std::uint64_t* position = quantized_[entries[i].point].position;
    const std::uint64_t fraction[3] = { position[0] & mask, position[1] & mask, position[2] & mask };
    WideSums& voxel = run.voxels.back();
    ++voxel.count;
    for (int axis = 0; axis < 3; ++axis)
    {
      voxel.low[axis] += fraction[axis];
    }
    if (secondMoments)
    {
      addProducts(run.secondMoments.back(), fraction[0], fraction[1], fraction[2]);
    }
  }
  return run;
}

std::size_t KeyRanges::bytes() const
{
  return quantized_.bytes() + rangeOf_.bytes() + numbers_.bytes() + order_.bytes() +
    slices_.capacity() * sizeof(Slice) + offsets_.capacity() * sizeof(std::uint32_t);
}

} // namespace simd
} // namespace pointhaptics
