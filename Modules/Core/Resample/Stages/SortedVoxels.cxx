#include "Core/Resample/Stages/SortedVoxels.h"

#include "Core/Base/RadixSort.h"

#include <numeric>

namespace pointhaptics::simd
{
namespace
{

/// Points whose keys the ranges are chosen by, how many a range must have, and how many there are at most.
constexpr std::int64_t kSamples = 1 << 14;
constexpr std::size_t kSamplesPerRange = 16;
constexpr std::size_t kMostRanges = 64;

}

void PointSorter::prepare(
  const VoxelRequest& request, const Chunks& chunks, const std::vector<AttributeView>&, bool)
{
  quantizer_ = makeQuantizer(request.transform, request.lattice);
  lattice_ = request.lattice;
  originals_ = chunks.originals();
  const PointView& points = chunks.points();
  starts_ = { 0 };
  Bins sample = { std::vector<std::vector<SortedPoint>>(1) };
  for (std::int64_t i = 0; i < points.size(); i += points.size() / kSamples + 1)
  {
    quantize(points, { i, i + 1 }, sample);
  }
  std::vector<SortedPoint>& some = sample.ranges[0];
  std::sort(
    some.begin(), some.end(), [](const SortedPoint& a, const SortedPoint& b) { return a.key < b.key; });
  const std::size_t ranges = std::clamp<std::size_t>(some.size() / kSamplesPerRange, 1, kMostRanges);
  for (std::size_t range = 1; range < ranges; ++range)
  {
    starts_.push_back(some[range * some.size() / ranges].key);
  }
}

void PointSorter::start(const Chunks&, std::size_t, std::size_t, const Executor& executor)
{
  bins_.resize(std::max(bins_.size(), std::size_t(std::max(executor.concurrency(), 1))));
  for (Bins& bins : bins_)
  {
    bins.ranges.resize(partitions());
    bins.invalid = 0;
    std::for_each(bins.ranges.begin(), bins.ranges.end(), [](auto& range) { range.clear(); });
  }
}

void PointSorter::add(const VoxelRequest&, const Chunks& chunks, std::size_t chunk, const Executor& executor)
{
  forEachItemWith(
    executor, std::size_t(chunks.pieceCount(chunk)),
    [&](std::size_t thread) -> Bins& { return bins_[thread]; },
    [&](std::size_t piece, Bins& bins) { quantize(chunks.points(), chunks.pieces(chunk)[piece], bins); });
}

void PointSorter::quantize(const PointView& points, PointRange range, Bins& bins) const
{
  const std::uint64_t mask = (std::uint64_t(1) << quantizer_.fractionBits) - 1;
  for (std::int64_t i = range.begin; i < range.end; ++i)
  {
    std::uint64_t position[3];
    const PointLocation location = quantizePoint(quantizer_, points[i], position);
    bins.invalid += location == PointLocation::Invalid;
    if (location == PointLocation::Inside)
    {
      const auto index = [&](int axis) { return std::int64_t(position[axis] >> quantizer_.fractionBits); };
      const std::uint64_t key = lattice_.key(index(0), index(1), index(2));
      const std::uint64_t* start = starts_.data();
      for (std::size_t left = starts_.size(); left > 1; left -= left / 2)
      {
        start += start[left / 2] <= key ? left / 2 : 0; // Without a branch, which would be unpredictable.
      }
      bins.ranges[std::size_t(start - starts_.data())].push_back(
        { key, i, { position[0] & mask, position[1] & mask, position[2] & mask } });
    }
  }
}

void PointSorter::copyPoints(std::uint32_t range, std::vector<SortedPoint>& to) const
{
  for (const Bins& bins : bins_)
  {
    to.insert(to.end(), bins.ranges[range].begin(), bins.ranges[range].end());
  }
}

std::size_t PointSorter::mostVoxels(std::uint32_t range) const
{
  return std::accumulate(bins_.begin(), bins_.end(), std::size_t(0),
    [=](std::size_t sum, const Bins& bins) { return sum + bins.ranges[range].size(); });
}

std::int64_t PointSorter::inside() const
{
  std::size_t sum = 0;
  for (std::uint32_t range = 0; range < partitions(); ++range)
  {
    sum += this->mostVoxels(range);
  }
  return std::int64_t(sum);
}

std::int64_t PointSorter::invalid() const
{
  return std::accumulate(bins_.begin(), bins_.end(), std::int64_t(0),
    [](std::int64_t sum, const Bins& bins) { return sum + bins.invalid; });
}

std::size_t PointSorter::bytes() const
{
  std::size_t sum = 0;
  for (const Bins& bins : bins_)
  {
    for (const std::vector<SortedPoint>& range : bins.ranges)
    {
      sum += range.capacity() * sizeof(SortedPoint);
    }
  }
  return sum;
}

void SortedVoxels::prepare(const VoxelRequest& request, const PointSorter& sorter)
{
  sorter_ = &sorter;
  covariances_ = request.covariances;
}

std::size_t SortedVoxels::find(std::uint32_t range)
{
  points_.clear();
  sorter_->copyPoints(range, points_);
  other_.resize(points_.size());
  radixSort(points_, other_, points_.size(), [](const SortedPoint& point) { return point.key; });
  size_ = 0;
  for (std::size_t i = 0; i < points_.size(); ++i)
  {
    size_ += i == 0 || points_[i].key != points_[i - 1].key;
  }
  return size_;
}

void SortedVoxels::sum()
{
  run_.start(size_, covariances_);
  std::size_t voxel = 0;
  for (std::size_t i = 0; i < points_.size(); ++i)
  {
    voxel += i > 0 && points_[i].key != points_[i - 1].key;
    run_.voxels[voxel].key = points_[i].key;
    run_.addPoint(voxel, points_[i].offset);
  }
}

} // namespace pointhaptics::simd
