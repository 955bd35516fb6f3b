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

Status VoxelResampler::Implementation::choosePoints(
  const VoxelRequest& request, const Executor& executor, ProgressObserver* observer)
{
  const bool chooses = request.representative != Representative::Mean;
  const bool isMedian = request.representative == Representative::Median;
  const std::size_t numbers = request.tuples.size() - 1;
  Level& level = levels[0];
  chosenPoints.resize(chooses && !isMedian ? std::size_t(level.size) : 0);
  voxelIndex.assign(request.voxelIndex ? std::size_t(request.points.size()) : 0, -1);
  if (poolHoldsAll_)
  {
    choosePointsBySet(request, executor);
    return !observer || observer->report(1.0) ? Status::Ok : Status::Aborted;
  }
  VoxelRepresentatives all(request);
  if (chooses)
  {
    all.prepare(level.arena.counts(), level.size);
  }
  SubProgress visiting(observer, 0.0, chooses ? 0.7 : 1.0);
  SubProgress writing(observer, 0.7, 1.0);
  const Status status = visitPointsByVoxel(
    request,
    [&](const PointRows& rows, const std::int64_t* voxels, int count)
    {
      if (chooses)
      {
        all.add(rows.tuples(numbers - 1), rows.tuples(numbers), rows.bytes, voxels, count);
      }
      if (request.voxelIndex)
      {
        notePoints(rows, numbers, 0, voxels, count);
      }
    },
    executor, &visiting);
  if (status == Status::Ok && chooses && !all.write(0, level.arena, chosenPoints.data(), executor, &writing))
  {
    return Status::Aborted;
  }
  return status;
}

/// The points of a set of voxels stay in the caches.
void VoxelResampler::Implementation::choosePointsBySet(const VoxelRequest& request, const Executor& executor)
{
  const bool chooses = request.representative != Representative::Mean;
  const std::size_t numbers = request.tuples.size() - 1;
  Level& level = levels[0];
  std::mutex mutex;
  std::vector<VoxelRepresentatives> idle;
  const auto take = [&]
  {
    const std::lock_guard<std::mutex> lock(mutex);
    if (idle.empty())
    {
      return VoxelRepresentatives(request);
    }
    VoxelRepresentatives set = std::move(idle.back());
    idle.pop_back();
    return set;
  };
  visitPointsByVoxelSet(
    request,
    [&](std::int64_t first, std::int64_t voxels, const auto& forPoints)
    {
      VoxelRepresentatives set = take();
      if (chooses)
      {
        set.prepare(level.arena.counts() + first, voxels);
      }
      forPoints(
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
      if (chooses)
      {
        set.write(first, level.arena, chosenPoints.data(), Executor(), nullptr);
      }
      const std::lock_guard<std::mutex> lock(mutex);
      idle.push_back(std::move(set));
    },
    executor);
}

} // namespace pointhaptics
