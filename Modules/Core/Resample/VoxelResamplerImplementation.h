/// @file
/// The state and the steps of VoxelResampler. Private to Core.
#pragma once

#include "Core/Resample/Reductions/VoxelReductions.h"
#include "Core/Resample/Stages/CoarseVoxels.h"
#include "Core/Resample/Stages/PartitionSums.h"
#include "Core/Resample/Stages/PointBinner.h"
#include "Core/Resample/Stages/PointQuantizer.h"
#include "Core/Resample/Stages/SortedPoints.h"
#include "Core/Resample/Stages/VoxelLevel.h"
#include "Core/Resample/VoxelResampler.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace pointhaptics
{

/// Finite points of the indexed cloud.
inline std::int64_t finitePoints(const PointIndex& index)
{
  return index.cloudSize() - index.invalidPoints();
}

class VoxelResampler::Implementation
{
public:
  Status run(const VoxelRequest& request, const Executor& executor, ProgressObserver* observer);
  /// For VoxelAccumulator: the sums of the points in the lattice's voxels, and the levels of such sums.
  Status sum(
    const VoxelRequest& request, simd::VoxelRun& sums, const Executor& executor, ProgressObserver* observer);
  Status finishSums(const VoxelRequest& request, const simd::VoxelRun& sums, const Executor& executor,
    ProgressObserver* observer);
  /// Bits of an offset in a voxel.
  static int fractionBitsOf(const Lattice& lattice);

  std::vector<simd::Level> levels = std::vector<simd::Level>(1);
  std::int64_t clipped = 0;
  std::int64_t invalid = 0;
  std::vector<std::int64_t> chosenPoints;
  std::vector<std::int64_t> voxelIndex;

  std::size_t scratchBytes() const;

private:
  void clear();
  /// Whether points are binned into partitions of the lattice, or sorted.
  static bool usesPartitions(const Lattice& lattice);
  static Status check(const VoxelRequest& request);
  Status runBinned(const VoxelRequest& request, const Executor& executor, ProgressObserver* observer);
  Status runSorted(const VoxelRequest& request, const Executor& executor, ProgressObserver* observer);
  /// Points are clipped that are neither invalid nor, later, counted inside.
  void startCounts(const VoxelRequest& request);
  void countPoints(std::int64_t inside, std::int64_t invalidOnes);
  void prepareStages(const VoxelRequest& request, const simd::Chunks& chunks);
  void accumulate(const VoxelRequest& request, const Executor& executor);
  void makeOutput(const VoxelRequest& request, const Executor& executor);
  bool accumulateAndWrite(
    const VoxelRequest& request, std::size_t rounds, const Executor& executor, ProgressObserver* observer);
  template <typename Work>
  void forPartitions(const VoxelRequest& request, std::uint32_t first, std::uint32_t last,
    const Executor& executor, Work&& work);
  /// Attributes, or the points that stand for voxels, are asked for.
  static bool reduces(const VoxelRequest& request)
  {
    return !request.attributes.empty() || request.representative != Representative::Mean;
  }
  static bool wantsPoints(const VoxelRequest& request) { return request.voxelIndex || reduces(request); }
  /// Another pass over the points.
  bool visits(const VoxelRequest& request) const { return wantsPoints(request) && !holdsAll_; }
  /// What arrays have is kept with the sums: more is to be made of it.
  bool keepsTallies(const VoxelRequest& request) const { return keepsSums_ || request.levels > 1; }
  /// Sums alone are asked for, and no visit needs the voxels.
  bool writesMeans(const VoxelRequest& request) const { return !keepsSums_ || visits(request); }
  static simd::MeanArena::Layout layoutOf(const VoxelRequest& request);
  /// The parts of the work of run() that the finest level is, and that of it that is not done by a visit.
  static double fractionOfFinest(const VoxelRequest& request) { return request.levels > 1 ? 0.5 : 1.0; }
  double fractionOfSums(const VoxelRequest& request) const
  {
    return (visits(request) ? 0.5 : 1.0) * fractionOfFinest(request);
  }
  bool writeSums(const VoxelRequest& request, const simd::VoxelRun& sums, int fractionBits,
    simd::Level& level, OutputAllocator* allocator, const Executor& executor, ProgressObserver* observer);
  Status addLevels(const VoxelRequest& request, const simd::VoxelRun& sums, const Executor& executor,
    ProgressObserver* observer);
  /// Visits the points inside, grouped by voxels: calls visit(points, voxels, count) for pieces, with the
  /// number of each point and that of its voxel. Several threads may call it at once, but no two of them have
  /// a voxel in common.
  using Visitor = std::function<void(const std::int64_t* points, const std::int64_t* voxels, int count)>;
  Status visitPoints(
    const VoxelRequest& request, const Visitor& visit, const Executor& executor, ProgressObserver* observer);
  Status visitAgain(const VoxelRequest& request, const Executor& executor, ProgressObserver* observer);
  Status reduceAgain(
    const VoxelRequest& request, const Visitor& visit, const Executor& executor, ProgressObserver* observer);
  Status visitBinned(
    const VoxelRequest& request, const Visitor& visit, const Executor& executor, ProgressObserver* observer);
  Status visitSorted(
    const VoxelRequest& request, const Visitor& visit, const Executor& executor, ProgressObserver* observer);

  bool keepsSums_ = false;      ///< For sum().
  bool usesPartitions_ = false; ///< In the last run.
  simd::PointBinner binner_;
  /// The binner has all points of the last run, with their numbers: what the request wants of them is made
  /// where they are summed.
  bool holdsAll_ = false;
  std::vector<simd::AccumulatedPartition> accumulated_;
  std::vector<std::unique_ptr<simd::PartitionWorker>> workers_; ///< One for each thread.
  simd::SortedPoints sorted_;
  simd::VoxelRun sums_; ///< Of the finest level, where means are not all that is made of them.
};

} // namespace pointhaptics
