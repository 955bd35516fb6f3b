/// @file
/// Quantizes the points of a chunk and bins their records into the partitions of a lattice.
#pragma once

#include "Core/Base/Executor.h"
#include "Core/Resample/Kernel/VoxelKernel.h"
#include "Core/Resample/PointRows.h"
#include "Core/Resample/Stages/PointChunks.h"
#include "Core/Resample/Stages/PointRecordPool.h"

#include <cstddef>
#include <cstdint>

namespace pointhaptics
{
namespace simd
{

/// How the voxels of a lattice are divided into partitions: blocks of rows (voxels along x) of a layer, or
/// blocks of layers. Keys ascend from partition to partition.
struct PartitionPlan
{
  std::uint32_t columns = 1;
  std::uint32_t rowsPerLayer = 1;
  std::uint32_t upperRows = 0; ///< See CellMap.
  int fractionBits = 0;
  std::uint32_t blocksPerLayer = 1;
  int rowShift = 0;   ///< Rows of a block, as a power of two.
  int layerShift = 0; ///< Layers of a block, likewise; above 0 only with one block per layer.
  std::uint32_t partitions = 1;

  std::uint32_t firstRow(std::uint32_t partition) const
  {
    return ((partition / blocksPerLayer) << layerShift) * rowsPerLayer +
      ((partition % blocksPerLayer) << rowShift);
  }
  CellMap cellMap(std::uint32_t partition) const
  {
    const std::uint32_t firstInLayer =
      layerShift == 0 ? (partition % blocksPerLayer) << rowShift : CellMap::kSeveralLayers;
    return { fractionBits, columns, rowsPerLayer, firstRow(partition), upperRows, firstInLayer };
  }
  std::uint64_t firstKey(std::uint32_t partition) const
  {
    return std::uint64_t(firstRow(partition)) * columns;
  }
  /// Cells of the largest partition.
  std::size_t cells() const
  {
    const std::size_t rows =
      blocksPerLayer > 1 ? std::size_t(1) << rowShift : std::size_t(rowsPerLayer) << layerShift;
    return columns * rows;
  }
};

/// Whether the voxels of a lattice can be divided into partitions whose rank tables stay in the caches: more
/// than two voxels on an axis and no more than 2^kMaximumIndexBits, and about 8.6 billion in all.
bool fitsPartitions(const Lattice& lattice, int indexBits);
/// A plan for @p points points at a time. @pre fitsPartitions()
PartitionPlan makePlan(const Lattice& lattice, int indexBits, std::int64_t points);

/// An upper bound of a partition's voxels, from its records and accumulated voxels.
std::size_t mostVoxels(const PartitionPlan& plan, std::size_t records, std::size_t accumulated);

/// The first two stages.
class PointBinner
{
public:
  /// For chunks of @p points points, of the lattice and the transform of @p request.
  void prepare(const VoxelRequest& request, std::int64_t points);
  /// The tuples of a request lie beside the records.
  void chooseRows(const VoxelRequest& request) { rows_.choose(request.tuples); }
  /// Empties the pool; quantizes and bins a chunk, with rows or without.
  void quantizeAndBin(const VoxelRequest& request, const Chunks& chunks, std::size_t chunk, bool withRows,
    const Executor& executor);

  const PartitionPlan& plan() const { return plan_; }
  const PointRecordPool& pool() const { return pool_; }
  const RowLayout& rows() const { return rows_; }

private:
  alignas(kApart) PartitionPlan plan_;
  alignas(kApart) PointQuantizer quantizer_{};
  alignas(kApart) PointRecordPool pool_;
  RowLayout rows_;
};

} // namespace simd
} // namespace pointhaptics
