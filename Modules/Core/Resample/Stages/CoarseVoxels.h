/// @file
/// Voxels of coarser lattices: exact sums of the finer voxels, without another pass over the points.
#pragma once

#include "Core/Base/Executor.h"
#include "Core/Base/Lattice.h"
#include "Core/Base/ProgressObserver.h"
#include "Core/Resample/Stages/PartitionSums.h"
#include "Core/Resample/Stages/VoxelRuns.h"
#include "Core/Resample/Stages/VoxelSink.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pointhaptics
{
namespace simd
{

/// The lattice 2^@p halvings times as fine, from the same corner.
Lattice finerLattice(const Lattice& lattice, int halvings);

/// Sums of the coarse voxels of one row: of four fine rows, two in each of two layers.
class CoarseRow
{
public:
  /// Which fine row: whether the indices of its voxels are odd.
  struct Parity
  {
    bool y;
    bool z;
  };

  /// @p fractionBits: of offsets in the fine voxels.
  void prepare(std::int64_t fineColumns, int fractionBits, bool withSecondMoments);
  /// Adds the sums of a fine voxel, or a part of them; secondMoments may be null. @tparam Sum: holds twice as
  /// much.
  template <typename Sum>
  void add(std::uint64_t x, Parity parity, std::int64_t count, const Sum (&sums)[3],
    const SecondMoments* secondMoments);
  /// Appends the voxels, whose first possible one has @p firstKey, to @p run, and clears them.
  void flush(std::uint64_t firstKey, VoxelRun& run);
  std::size_t bytes() const
  {
    return occupancy_.capacity() * sizeof(std::uint64_t) + sums_.capacity() * sizeof(VoxelSums) +
      secondMoments_.capacity() * sizeof(SecondMoments);
  }

private:
  void append(
    const VoxelSums& sums, const SecondMoments* secondMoments, std::uint64_t firstKey, VoxelRun& run) const;
  void flushListed(std::uint64_t firstKey, VoxelRun& run);

  int fractionBits_ = 0;
  bool withSecondMoments_ = false;
  /// A row too wide for sums of all its columns: the sums of the fine voxels are listed and sorted.
  bool isListed_ = false;
  // Between rows all are zeros, or have no elements.
  std::vector<std::uint64_t> occupancy_; ///< A bit for each occupied column; unused where listed.
  std::vector<VoxelSums> sums_;          ///< By column, or listed with the column as the key.
  std::vector<SecondMoments> secondMoments_;
  std::vector<std::uint32_t> order_;
};

/// Sums the coarse voxels of a lattice's. Several threads may use one at once.
class CoarseVoxels
{
public:
  /// What a thread works in.
  struct Scratch
  {
    CoarseRow row;
    VoxelRun run;

    std::size_t bytes() const
    {
      return row.bytes() + run.voxels.capacity() * sizeof(WideSums) +
        run.secondMoments.capacity() * sizeof(SecondMoments);
    }
  };

  /// @p fractionBits: of offsets in the fine voxels.
  CoarseVoxels(const Lattice& fine, int fractionBits, bool withSecondMoments);

  /// Those of the partitions [first, last), which are whole coarse layers.
  VoxelRun ofPartitions(const PartitionPlan& plan, const std::vector<AccumulatedPartition>& partitions,
    std::uint32_t first, std::uint32_t last, Scratch& scratch) const;
  /// Those of all voxels, in ranges of whole coarse layers. @return false where @p observer, which may be
  /// null, ended the work. @pre all ranges are joined
  bool ofRuns(
    const VoxelRuns& fine, VoxelRuns& coarse, const Executor& executor, ProgressObserver* observer) const;

private:
  class FineVoxels;
  template <class Span>
  class Chain;
  struct PackedSpan;
  struct AccumulatedSpan;
  struct WideSpan;

  /// Fine voxels in one of two forms, twice: to walk through even layers and through odd ones.
  using Sources = std::vector<FineVoxels*>[2];

  std::uint64_t coarseLayerOf(std::uint64_t key) const { return key / layerKeys_ / 2; }
  VoxelRun sumLayers(
    const Sources& sources, std::uint64_t firstLayer, std::uint64_t lastLayer, Scratch& scratch) const;
  void sumLayer(const Sources& sources, std::uint64_t layer, Scratch& scratch) const;

  Lattice fine_;
  Lattice coarse_;
  int fractionBits_;
  bool withSecondMoments_;
  std::uint64_t rowKeys_;
  std::uint64_t layerKeys_;
};

/// Of each fine voxel, the position of the coarse one it lies in. Keys ascend. @return false where
/// @p observer, which may be null, ended the work.
bool findParents(const std::uint64_t* fineKeys, std::int64_t fineVoxels, const Lattice& fine,
  const std::uint64_t* coarseKeys, std::int64_t coarseVoxels, const Lattice& coarse,
  std::vector<std::int64_t>& parents, const Executor& executor, ProgressObserver* observer);

} // namespace simd
} // namespace pointhaptics
