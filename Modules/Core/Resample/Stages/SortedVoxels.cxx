#include "Core/Resample/Stages/SortedVoxels.h"

#include "Core/Base/RadixSort.h"

#include <numeric>

namespace pointhaptics
{
namespace simd
{
namespace
{

/// Points of a piece, about: they stay in the second-level cache.
constexpr std::int64_t kPiecePoints = 1 << 14;
/// Points whose keys the ranges are chosen by, how many a range must have, and how many there are at most.
constexpr std::int64_t kSamples = 1 << 14;
constexpr std::size_t kSamplesPerRange = 16;
constexpr std::size_t kMostRanges = 64;

}

void PointSorter::prepare(
  const VoxelRequest& request, const Chunks& chunks, const std::vector<AttributeView>&, bool)
{
  const int indexBits = indexBitsOf(request.lattice);
  quantizer_ = makeQuantizer(request.transform, request.lattice, indexBits, positionBitsFor(indexBits));
  lattice_ = request.lattice;
  originals_ = chunks.originals();
  const PointView& points = chunks.points();
  Piece sample;
  for (std::int64_t i = 0; i < points.size(); i += points.size() / kSamples + 1)
  {
    quantize(points, { i, i + 1 }, sample);
  }
  std::sort(sample.points.begin(), sample.points.end(),
    [](const SortedPoint& a, const SortedPoint& b) { return a.key < b.key; });
  const std::size_t size = sample.points.size();
  const std::size_t ranges = std::clamp<std::size_t>(size / kSamplesPerRange, 1, kMostRanges);
  starts_.assign(1, 0);
  for (std::size_t range = 1; range < ranges; ++range)
  {
    starts_.push_back(sample.points[range * size / ranges].key);
  }
  starts_.push_back(~std::uint64_t(0));
}

void PointSorter::add(const VoxelRequest&, const Chunks& chunks, std::size_t chunk, const Executor& executor)
{
  const auto count = std::size_t(chunks.pointCount(chunk) / kPiecePoints + 1);
  pieces_.resize(std::max(pieces_.size(), used_ + count));
  forEachItem<std::vector<SortedPoint>>(executor, count,
    [&](std::size_t p, std::vector<SortedPoint>& other)
    {
      const auto firstRange = [&](std::size_t number) {
        return chunks.pieces(chunk) + chunks.pieceCount(chunk) * std::int64_t(number) / std::int64_t(count);
      };
      Piece& piece = pieces_[used_ + p];
      piece.points.clear();
      piece.invalid = 0;
      for (const PointRange* range = firstRange(p); range != firstRange(p + 1); ++range)
      {
        quantize(chunks.points(), *range, piece);
      }
      piece.size = piece.points.size();
      other.resize(std::max(other.size(), piece.size));
      radixSort(piece.points, other, piece.size, [](const SortedPoint& point) { return point.key; });
    });
  used_ += count;
}

void PointSorter::quantize(const PointView& points, PointRange range, Piece& piece) const
{
  const std::uint64_t mask = (std::uint64_t(1) << quantizer_.fractionBits) - 1;
  for (std::int64_t i = range.begin; i < range.end; ++i)
  {
    std::uint64_t position[3];
    const PointLocation location = quantizePoint(quantizer_, points[i], position);
    piece.invalid += location == PointLocation::Invalid;
    if (location == PointLocation::Inside)
    {
      const auto index = [&](int axis) { return std::int64_t(position[axis] >> quantizer_.fractionBits); };
      piece.points.push_back({ lattice_.key(index(0), index(1), index(2)), i,
        { position[0] & mask, position[1] & mask, position[2] & mask } });
    }
  }
}

std::size_t PointSorter::count(std::uint32_t range) const
{
  std::size_t sum = 0;
  forPoints(
    range, [&](const SortedPoint* first, const SortedPoint* last) { sum += std::size_t(last - first); });
  return sum;
}

std::int64_t PointSorter::inside() const
{
  return std::accumulate(pieces_.begin(), pieces_.begin() + std::ptrdiff_t(used_), std::int64_t(0),
    [](std::int64_t sum, const Piece& piece) { return sum + std::int64_t(piece.size); });
}

std::int64_t PointSorter::invalid() const
{
  return std::accumulate(pieces_.begin(), pieces_.begin() + std::ptrdiff_t(used_), std::int64_t(0),
    [](std::int64_t sum, const Piece& piece) { return sum + piece.invalid; });
}

std::size_t PointSorter::bytes() const
{
  return std::accumulate(pieces_.begin(), pieces_.end(), std::size_t(0),
    [](std::size_t sum, const Piece& piece) { return sum + piece.points.capacity() * sizeof(SortedPoint); });
}

void SortedVoxels::prepare(const VoxelRequest& request, const PointSorter& sorter, bool)
{
  sorter_ = &sorter;
  covariances_ = request.covariances;
}

std::size_t SortedVoxels::find(std::uint32_t range)
{
  points_.clear();
  sorter_->forPoints(range,
    [&](const SortedPoint* first, const SortedPoint* last) { points_.insert(points_.end(), first, last); });
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

} // namespace simd
} // namespace pointhaptics
