/// VoxelResampler after the means are known: the points that stand for voxels, and the voxels of points.
#include "Core/Resample/Stages/VoxelRepresentatives.h"
#include "Core/Resample/VoxelResamplerImplementation.h"

#include <cstring>

namespace pointhaptics
{

using namespace simd;

/// @param numbers the source with the numbers of the points, the last; the one before has their coordinates.
void VoxelResampler::Implementation::notePoints(
  const PointRows& rows, std::size_t numbers, std::int64_t firstVoxel, const std::int64_t* voxels, int count)
{
  const char* number = static_cast<const char*>(rows.tuples(numbers));
  for (int i = 0; i < count; ++i, number += rows.bytes)
  {
    std::int64_t point;
    std::memcpy(&point, number, sizeof point);
    voxelIndex[std::size_t(point)] = firstVoxel + voxels[i];
  }
}

/// Chooses for the voxels from @p first on, whose points forPoints(visit) visits.
Status VoxelResampler::Implementation::chooseInSet(const VoxelRequest& request, VoxelRepresentatives& set,
  std::int64_t first, std::int64_t voxels, const std::function<Status(const Visitor&)>& forPoints,
  const Executor& executor, ProgressObserver* observer)
{
  const bool chooses = request.representative != Representative::Mean;
  const std::size_t numbers = request.tuples.size() - 1;
  MeanArena& arena = levels[0].arena;
  if (chooses)
  {
    set.prepare(arena.counts() + first, voxels);
  }
  const Status status = forPoints(
    [&](const PointRows& rows, const std::int64_t* ranks, int count)
    {
      if (chooses)
      {
        set.add(rows.tuples(numbers - 1), rows.tuples(numbers), rows.bytes, ranks, count);
      }
      if (request.voxelIndex)
      {
        notePoints(rows, numbers, first, ranks, count);
      }
    });
  const bool isWritten =
    status != Status::Ok || !chooses || set.write(first, arena, chosenPoints.data(), executor, observer);
  return isWritten ? status : Status::Aborted;
}

Status VoxelResampler::Implementation::choosePoints(
  const VoxelRequest& request, const Executor& executor, ProgressObserver* observer)
{
  const bool chooses = request.representative != Representative::Mean;
  const bool isMedian = request.representative == Representative::Median;
  chosenPoints.resize(chooses && !isMedian ? std::size_t(levels[0].size) : 0);
  voxelIndex.assign(request.voxelIndex ? std::size_t(request.points.size()) : 0, -1);
  if (!poolHoldsAll_)
  {
    SubProgress visiting(observer, 0.0, chooses ? 0.7 : 1.0);
    SubProgress writing(observer, 0.7, 1.0);
    VoxelRepresentatives all(request);
    return chooseInSet(
      request, all, 0, levels[0].size,
      [&](const Visitor& visit) { return visitPointsByVoxel(request, visit, executor, &visiting); }, executor,
      &writing);
  }
  // The points of a set of voxels stay in the caches.
  std::mutex mutex;
  std::vector<VoxelRepresentatives> idle;
  visitPointsByVoxelSet(
    request,
    [&](std::int64_t first, std::int64_t voxels, const auto& forPoints)
    {
      std::unique_lock<std::mutex> lock(mutex);
      if (idle.empty())
      {
        idle.emplace_back(request);
      }
      VoxelRepresentatives set = std::move(idle.back());
      idle.pop_back();
      lock.unlock();
      const auto visitAll = [&](const Visitor& visit)
      {
        forPoints(visit);
        return Status::Ok;
      };
      static_cast<void>(
        chooseInSet(request, set, first, voxels, visitAll, Executor(), nullptr)); // It cannot fail.
      lock.lock();
      idle.push_back(std::move(set));
    },
    executor);
  return !observer || observer->report(1.0) ? Status::Ok : Status::Aborted;
}

} // namespace pointhaptics
