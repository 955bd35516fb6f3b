/// @file
/// Voxels of lattices that are not divided into partitions: points are sorted by the keys of their voxels.
#pragma once

#include "Core/Base/Executor.h"
#include "Core/Base/Lattice.h"
#include "Core/Resample/Kernel/PointRecordWriter.h"
#include "Core/Resample/Stages/PointChunks.h"
#include "Core/Resample/Stages/PointQuantizer.h"
#include "Core/Resample/Stages/VoxelWriter.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pointhaptics::simd
{

/// A point inside: its voxel, its number among the chunks' points, and its offset in the voxel.
struct SortedPoint
{
  std::uint64_t key;
  std::int64_t number;
  std::array<std::uint64_t, 3> offset;
};

/// Quantizes points and bins them into ranges of keys with about as many points each: the partitions of this
/// path.
class PointSorter
{
public:
  /// As of PointBinner.
  static constexpr std::int64_t kChunkPoints = std::int64_t(1) << 18;
  static constexpr std::size_t kHeldChunks = 1;

  void prepare(const VoxelRequest& request, const Chunks& chunks, const std::vector<AttributeView>&, bool);
  /// Forgets the points.
  void start(const Chunks&, std::size_t, std::size_t, const Executor& executor);
  /// Quantizes and bins those of a chunk.
  void add(const VoxelRequest& request, const Chunks& chunks, std::size_t chunk, const Executor& executor);

  std::uint32_t partitions() const { return std::uint32_t(starts_.size()); }
  int fractionBits() const { return quantizer_.fractionBits; }
  PayloadLayout payloadLayout() const { return {}; }
  const std::uint32_t* originals() const { return originals_; }
  /// Appends the points of a range.
  void copyPoints(std::uint32_t range, std::vector<SortedPoint>& to) const;
  std::size_t mostVoxels(std::uint32_t range) const;
  std::int64_t inside() const;
  std::int64_t invalid() const;
  std::size_t bytes() const;

private:
  /// What one thread has found.
  struct Bins
  {
    std::vector<std::vector<SortedPoint>> ranges;
    std::int64_t invalid = 0;
  };
  void quantize(const PointView& points, PointRange range, Bins& bins) const;

  PointQuantizer quantizer_{};
  Lattice lattice_;
  const std::uint32_t* originals_ = nullptr;
  std::vector<Bins> bins_;
  std::vector<std::uint64_t> starts_; ///< First keys of the ranges.
};

/// Some points of a range, and their voxels, counted from the first of the range.
struct SortedBlock
{
  static constexpr int kMostPoints = kBlockRecords;
  static constexpr const std::uint32_t* payloads = nullptr;

  const SortedPoint* from = nullptr;
  int count = 0;
  std::int64_t points[kMostPoints];
  std::int64_t voxels[kMostPoints];

  /// Offset of a point in its voxel, in quanta.
  std::array<double, 3> offset(int i) const
  {
    const auto& q = from[i].offset;
    return { double(std::int64_t(q[0])), double(std::int64_t(q[1])), double(std::int64_t(q[2])) };
  }
};

/// The voxels of one range at a time, as BinnedVoxels has those of a partition; for one thread at a time.
class SortedVoxels
{
public:
  using Source = PointSorter;

  void prepare(const VoxelRequest& request, const PointSorter& sorter);
  std::size_t find(std::uint32_t range);
  void sum();
  void drop() {}

  std::size_t size() const { return size_; }
  std::int64_t count(std::size_t voxel) const { return run_.voxels[voxel].count; }
  std::array<double, 3> sums(std::size_t voxel) const { return run_.voxels[voxel].sums(); }
  VoxelRun wide() const { return run_; }
  void write(const Kernels&, VoxelWriter& writer, std::size_t offset) const
  {
    writer.write(offset, run_, 0, size_);
  }
  template <typename Visit>
  void visit(const Visit& visit) const;
  std::size_t bytes() const
  {
    return (points_.capacity() + other_.capacity()) * sizeof(SortedPoint) + run_.bytes();
  }

private:
  const PointSorter* sorter_ = nullptr;
  bool covariances_ = false;
  std::vector<SortedPoint> points_; ///< In ascending order of keys.
  std::vector<SortedPoint> other_;
  std::size_t size_ = 0; ///< Voxels.
  VoxelRun run_;
};

template <typename Visit>
void SortedVoxels::visit(const Visit& visit) const
{
  SortedBlock block;
  std::int64_t voxel = -1;
  for (std::size_t first = 0; first < points_.size(); first += SortedBlock::kMostPoints)
  {
    block.from = points_.data() + first;
    block.count = int(std::min<std::size_t>(points_.size() - first, SortedBlock::kMostPoints));
    for (int i = 0; i < block.count; ++i)
    {
      const std::size_t at = first + std::size_t(i);
      voxel += at == 0 || points_[at].key != points_[at - 1].key;
      block.voxels[i] = voxel;
      block.points[i] = sorter_->originals() ? sorter_->originals()[points_[at].number] : points_[at].number;
    }
    visit(block);
  }
}

} // namespace pointhaptics::simd
