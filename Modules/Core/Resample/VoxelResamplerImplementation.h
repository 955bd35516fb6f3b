/// @file
/// The state and the steps of VoxelResampler. Private to Core.
#pragma once

#include "Core/Resample/Reductions/VoxelReductions.h"
#include "Core/Resample/Stages/BinnedVoxels.h"
#include "Core/Resample/Stages/PointQuantizer.h"
#include "Core/Resample/Stages/VoxelRun.h"
#include "Core/Resample/VoxelResampler.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <thread>
#include <vector>

namespace pointhaptics
{

/// Finite points of the indexed cloud.
inline std::int64_t finitePoints(const PointIndex& index)
{
  return index.cloudSize() - index.invalidPoints();
}

/// Points that records can number.
constexpr std::int64_t kMostChosenAmong = std::int64_t(1) << 32;

/// All points of a voxel must be known at once.
inline bool choosesPoints(const VoxelRequest& request)
{
  return request.representative != Representative::Mean || request.voxelIndex;
}

/// Gives partitions the offsets of their voxels among all. Threads take partitions in ascending order and
/// find one's voxels before they do anything else with it: a thread that has found them waits, if at all, for
/// one that is finding.
class PartitionOrder
{
public:
  /// The offset of a partition of @p size voxels. @pre those before it are done or at work.
  std::size_t append(std::size_t partition, std::size_t size)
  {
    while (known_.load(std::memory_order_acquire) != partition && !givenUp_)
    {
      std::this_thread::yield();
    }
    if (givenUp_)
    {
      return 0;
    }
    const std::size_t offset = size_;
    size_ += size;
    known_.store(partition + 1, std::memory_order_release);
    return offset;
  }
  /// Voxels of all partitions.
  std::size_t size() const { return size_; }
  /// Lets all threads go on after one of them failed; offsets are then of no use.
  void giveUp() { givenUp_ = true; }

private:
  std::size_t size_ = 0;
  std::atomic<std::size_t> known_{ 0 }; ///< Partitions whose end is known.
  std::atomic<bool> givenUp_{ false };
};

class VoxelResampler::Implementation : public VoxelResampler::Results
{
public:
  Status run(const VoxelRequest& request, const Executor& executor, ProgressObserver* observer);
  /// Use of the voxels of points.
  struct Task
  {
    VoxelRequest request;
    bool writes; ///< They are written to the result at once; else their sums are kept.
    /// The attributes of the request, and what is reduced like them.
    std::vector<AttributeRequest> arrays = {};
  };
  /// The sums of the points in the lattice's voxels, where @p task does not write them.
  Status sumPoints(Task& task, simd::VoxelRun& sums, const Executor& executor, ProgressObserver* observer);
  /// For VoxelAccumulator: the result that such sums make.
  Status finish(const VoxelRequest& request, const simd::VoxelRun& sums, const Executor& executor,
    ProgressObserver* observer);

private:
  struct Worker
  {
    simd::BinnedVoxels voxels;
    std::optional<simd::VoxelReductions> reductions; ///< Where points are wanted.
  };

  void clear();
  void publish();
  static Status check(const VoxelRequest& request);
  Status runStages(
    Task& task, std::vector<simd::VoxelRuns>& parts, const Executor& executor, ProgressObserver* observer);
  void prepareWorkers(const Task& task, const simd::Chunks& chunks, const Executor& executor);
  void sumPartition(
    Worker& worker, const Task& task, std::uint32_t partition, PartitionOrder& order, simd::VoxelRuns* runs);
  bool sumPartitions(const Task& task, std::size_t rounds, std::vector<simd::VoxelRuns>& runs,
    const Executor& executor, ProgressObserver* observer);
  void makeOutput(const VoxelRequest& request, const Executor& executor);
  AttributeView placesOf(const VoxelRequest& request, const Executor& executor);
  Status writeRun(const VoxelRequest& request, const simd::VoxelRun& run, const Executor& executor,
    ProgressObserver* observer);

  simd::VoxelWriter writer_; ///< The result's arrays.
  simd::PointBinner binner_;
  std::vector<std::unique_ptr<Worker>> workers_; ///< One for each thread.
  Buffer<char> places_;                          ///< Memory of points, for medians.
};

} // namespace pointhaptics
