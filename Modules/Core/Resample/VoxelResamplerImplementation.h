/// @file
/// What VoxelResampler keeps, and its steps. Private to Core.
#pragma once

#include "Core/Base/Buffer.h"
#include "Core/Resample/Stages/CoarseVoxels.h"
#include "Core/Resample/Stages/KeyRanges.h"
#include "Core/Resample/Stages/PartitionSums.h"
#include "Core/Resample/Stages/PointChunks.h"
#include "Core/Resample/Stages/PointPlacement.h"
#include "Core/Resample/Stages/RecordPool.h"
#include "Core/Resample/Stages/VoxelLevel.h"
#include "Core/Resample/Stages/VoxelRuns.h"
#include "Core/Resample/VoxelResampler.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <numeric>
#include <vector>

namespace pointhaptics
{

/// Of the cloud that @p index is of.
inline std::int64_t finitePoints(const PointIndex& index)
{
  return index.cloudSize() - index.invalidPoints();
}

/// Collects rows from all over the memory their tuples are in, a block at a time.
class RowCollector
{
public:
  explicit RowCollector(const RowLayout& layout)
    : layout_(layout)
  {
    std::iota(places_, places_ + kernel::kBlockRecords, 0);
  }
  /// Those of at most kBlockRecords points, until the next call.
  PointRows collect(const std::int64_t* points, int count)
  {
    rows_.reserve(kernel::kBlockRecords * layout_.bytes());
    layout_.copy(points, places_, count, rows_.data());
    return { rows_.data(), layout_.bytes(), layout_.offsets() };
  }

private:
  const RowLayout& layout_;
  std::uint32_t places_[kernel::kBlockRecords];
  Buffer<char> rows_;
};

class VoxelResampler::Implementation
{
public:
  Status run(const VoxelRequest& request, const Executor& executor, ProgressObserver* observer);
  Status assign(
    const VoxelRequest& request, const Visitor& visit, const Executor& executor, ProgressObserver* observer);
  void assignInSets(const VoxelRequest& request, const SetWork& work, const Executor& executor);
  bool poolHoldsAll() const { return poolHoldsAll_; }

  std::vector<kernel::Level> levels = std::vector<kernel::Level>(1);
  std::int64_t clipped = 0;
  std::int64_t invalid = 0;

  std::size_t scratchBytes() const;

private:
  /// With what a thread makes coarse voxels in.
  struct Worker : kernel::PartitionWorker
  {
    kernel::CoarseVoxels::Scratch coarse;
  };
  class WorkerLease;

  void clear();
  /// How often the voxels of a lattice are halved so that they can be dealt out to partitions; -1: they
  /// cannot.
  static int halvingsOf(const Lattice& lattice);
  Status runPlanned(const VoxelRequest& request, const Executor& executor, ProgressObserver* observer);
  Status runGeneral(const VoxelRequest& request, const Executor& executor, ProgressObserver* observer);
  void fillPool(const VoxelRequest& request, const kernel::Chunks& chunks, std::size_t chunk, bool withRows,
    const Executor& executor);
  void chooseRows(const VoxelRequest& request);
  template <typename Work>
  void forPartitions(const VoxelRequest& request, const Executor& executor, Work&& work);
  void carryChunk(const VoxelRequest& request, const Executor& executor);
  void closeBatch(const VoxelRequest& request, const Executor& executor);
  Status finishRuns(const VoxelRequest& request, const Executor& executor, ProgressObserver* observer);
  void keepBatches(const VoxelRequest& request, kernel::PartitionWorker& worker, std::uint32_t partition);
  void finish(const VoxelRequest& request, const Executor& executor);
  /// The part of the work of run() that the finest level is.
  static double shareOfFinest(const VoxelRequest& request) { return request.levels > 1 ? 0.5 : 1.0; }
  bool writeRuns(const VoxelRequest& request, kernel::VoxelRuns& runs, bool keeps, kernel::Level& level,
    ResultMemory* memory, const Executor& executor, ProgressObserver* observer);
  Status addLevels(const VoxelRequest& request, kernel::VoxelRuns runs, int levelOfRuns,
    const Executor& executor, ProgressObserver* observer);
  kernel::VoxelRuns takeCarried(const Executor& executor);
  Status assignPlanned(
    const VoxelRequest& request, const Visitor& visit, const Executor& executor, ProgressObserver* observer);
  void visitPartition(const VoxelRequest& request, kernel::PartitionWorker& worker, std::uint32_t partition,
    std::int64_t firstVoxel, const Visitor& visit);
  Status assignGeneral(
    const VoxelRequest& request, const Visitor& visit, const Executor& executor, ProgressObserver* observer);

  int halvings_ = 0;
  Lattice halved_; ///< The lattice asked for, or what halvings_ make of it.
  alignas(kernel::kApart) kernel::PartitionPlan plan_;
  alignas(kernel::kApart) kernel::Placement placement_{};
  alignas(kernel::kApart) kernel::RecordPool pool_;
  bool poolHoldsAll_ = false; ///< All points of the last run, with their rows.
  RowLayout rows_;            ///< As assign() hands them out.
  RowLayout dealtRows_;       ///< As they are dealt out with the records.
  std::vector<kernel::CarriedPartition> carried_;
  std::vector<std::unique_ptr<Worker>> idle_;
  kernel::KeyRanges ranges_;
  kernel::VoxelRuns runs_;
  alignas(kernel::kApart) std::mutex mutex_;
};

} // namespace pointhaptics
