/// @file
/// Quantizes the points of a chunk and bins their records into the partitions of a lattice.
#pragma once

#include "Core/Base/Executor.h"
#include "Core/Resample/Kernel/VoxelKernel.h"
#include "Core/Resample/Stages/PointChunks.h"
#include "Core/Resample/Stages/PointRecordPool.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>

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
  /// What is kept of a chunk when it was binned.
  enum class Keep
  {
    Records, ///< Until the next chunk.
    Numbers, ///< And the numbers of their points; until the next chunk.
    All,     ///< And payloadLayout(), beside those of the chunks before.
  };

  /// For chunks of @p points points, of the lattice and the transform of @p request. Empties the pools.
  void prepare(const VoxelRequest& request, std::int64_t points);
  /// Quantizes and bins a chunk. Where all is kept, payloads are as payloadLayout() says.
  void quantizeAndBin(const VoxelRequest& request, const Chunks& chunks, std::size_t chunk, Keep keep,
    const Executor& executor);

  const PartitionPlan& plan() const { return plan_; }
  /// The payload of records where all is kept. Points in the order of a scan have their numbers alone:
  /// where neighbours in memory are in one partition, its tuples are read in order anyway.
  const PayloadLayout& payloadLayout() const { return payloadLayout_; }
  const PointQuantizer& quantizer() const { return quantizer_; }
  /// Those of the chunks that are kept; the last one is there as long as no other is binned.
  std::size_t pools() const { return used_; }
  const PointRecordPool& pool(std::size_t number) const { return pools_[number]; }
  /// Records of a partition.
  std::size_t count(std::uint32_t partition) const;
  std::size_t bytes() const;

private:
  bool areScattered(const PointView& points) const;

  alignas(kApart) PartitionPlan plan_;
  alignas(kApart) PointQuantizer quantizer_{};
  PayloadLayout payloadLayout_;
  std::deque<PointRecordPool> pools_;
  std::size_t used_ = 0;
};

} // namespace simd
} // namespace pointhaptics
