/// @file
/// Quantizes points and bins their records into the partitions of a lattice.
#pragma once

#include "Core/Base/Executor.h"
#include "Core/Resample/Kernel/VoxelKernel.h"
#include "Core/Resample/Stages/PointChunks.h"
#include "Core/Resample/Stages/PointRecordPool.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pointhaptics::simd
{

/// How the voxels of a lattice are divided into partitions: blocks of rows (voxels along x) of a layer, or
/// blocks of layers. Keys ascend from partition to partition.
struct PartitionPlan
{
  std::uint32_t columns = 1;
  std::uint32_t rowsPerLayer = 1;
  /// Rows in the half of the lattice that the bit of z left out of records stands for; 0: it is never set.
  std::uint32_t upperRows = 0;
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
    const std::uint32_t first = firstRow(partition);
    return { fractionBits, columns, rowsPerLayer, first, upperRows > 0 ? first % upperRows : first };
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

/// The first two stages.
class PointBinner
{
public:
  static constexpr std::int64_t kChunkPoints = simd::kChunkPoints;
  /// So many are summed together; the sums of more are merged.
  static constexpr std::size_t kHeldChunks = 4;

  /// For the lattice and the transform of @p request. @p arrays: to go with the records, as many as have
  /// room; @p numbered: with the numbers of their points.
  void prepare(const VoxelRequest& request, const Chunks& chunks, const std::vector<AttributeView>& arrays,
    bool numbered);
  /// Makes room for chunks @p first to before @p last, and forgets those before.
  void start(const Chunks& chunks, std::size_t first, std::size_t last, const Executor& executor);
  /// Quantizes and bins one of them.
  void add(const VoxelRequest& request, const Chunks& chunks, std::size_t chunk, const Executor& executor);

  const PartitionPlan& plan() const { return plan_; }
  std::uint32_t partitions() const { return plan_.partitions; }
  int fractionBits() const { return plan_.fractionBits; }
  /// Layout of a record's payload.
  const PayloadLayout& payloadLayout() const { return payloadLayout_; }
  const PointRecordPool& pool() const { return pool_; }
  /// An upper bound of a partition's voxels.
  std::size_t mostVoxels(std::uint32_t partition) const
  {
    return std::min(pool_.count(partition), plan_.cells());
  }
  std::int64_t inside() const { return pool_.total(&PointRecordWriter::inside); }
  std::int64_t invalid() const { return pool_.total(&PointRecordWriter::invalid); }
  std::size_t bytes() const { return pool_.bytes(); }

private:
  alignas(kApart) PartitionPlan plan_;
  alignas(kApart) PointQuantizer quantizer_{};
  PayloadLayout payloadLayout_;
  std::int64_t firstNumber_ = 0; ///< Others are counted from this in records: they fit four bytes.
  PointRecordPool pool_;
};

} // namespace pointhaptics::simd
