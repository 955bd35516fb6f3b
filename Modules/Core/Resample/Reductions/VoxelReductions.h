/// @file
/// Results of the points of voxels beside their sums.
#pragma once

#include "Core/Resample/Kernel/Loops.h"
#include "Core/Resample/Kernel/PointRecordWriter.h"
#include "Core/Resample/Reductions/AttributeTuples.h"
#include "Core/Resample/Reductions/NearestPoints.h"
#include "Core/Resample/Stages/VoxelTally.h"
#include "Core/Resample/VoxelResampler.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace pointhaptics::simd
{

/// Columns that turn normals: the products of a normal's components with these are added.
std::array<Vec3, 3> normalColumns(const AffineTransform& transform);

/// Reduces the points of the voxels of one partition at a time, in one visit: their arrays, the point that
/// stands for each, and where each point went. For one thread at a time.
class VoxelReductions
{
public:
  /// @p request must outlive this. @p arrays: its attributes, and what else is reduced like them; their
  /// ranges are known. @p voxelIndex: of each point; null unless asked for.
  VoxelReductions(const VoxelRequest& request, const std::vector<AttributeRequest>& arrays,
    const PayloadLayout& payloads, int fractionBits, std::int64_t* voxelIndex);

  /// @p voxels: BinnedVoxels or SortedVoxels, summed; @p first of all voxels there is their first.
  template <typename Voxels>
  void reduce(const Voxels& voxels, std::size_t first)
  {
    counts_.resize(voxels.size());
    for (std::size_t v = 0; v < counts_.size(); ++v)
    {
      counts_[v] = voxels.count(v);
    }
    for (Array& array : arrays_)
    {
      isSum(array.kind.statistic) ? array.sums.prepare(array.kind, array.range, counts_)
                                  : array.tuples.prepare(array.kind, counts_);
    }
    if (nearest_)
    {
      nearest_->prepare(voxels);
    }
    voxels.visit(
      [&](const auto& block)
      {
        this->fetch(block.points, block.count);
        this->note(block.points, block.voxels, block.count, std::int64_t(first));
        this->addTuples(block.payloads, block.points, block.voxels, block.count);
        if (nearest_)
        {
          nearest_->add(block);
        }
      });
  }
  /// Writes what became of the voxels, whose counts are there, from @p first on in @p writer.
  void write(VoxelWriter& writer, std::size_t first) const;
  /// Takes the tallies of the arrays in the voxels, one for each array.
  std::vector<VoxelTally> takeTallies();

private:
  struct Array
  {
    AttributeView view;
    AccumulatedArray kind;
    AttributeRange range;
    TallySums sums;
    AttributeTuples tuples; ///< Where they are not summed.
  };
  void fetch(const std::int64_t* points, int count) const;
  void note(const std::int64_t* points, const std::int64_t* voxels, int count, std::int64_t first) const;
  void addTuples(
    const std::uint32_t* payloads, const std::int64_t* points, const std::int64_t* voxels, int count);

  PayloadLayout payloads_;
  std::int64_t* voxelIndex_;
  const Kernels& kernels_;
  std::array<Vec3, 3> columns_;
  std::vector<Array> arrays_;
  std::optional<NearestPoints> nearest_;
  std::vector<std::int64_t> counts_; ///< Number of points of each voxel.
};

} // namespace pointhaptics::simd
