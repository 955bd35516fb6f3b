/// VoxelResampler: what takes another pass over the points, and passes in general.
#include "Core/Resample/VoxelResamplerImplementation.h"

#include <algorithm>
#include <cstring>

namespace pointhaptics
{

using namespace simd;

Status VoxelResampler::Implementation::visitPointsByVoxel(
  const VoxelRequest& request, const Visitor& visit, const Executor& executor, ProgressObserver* observer)
{
  return usesPartitions_ ? visitBinned(request, visit, executor, observer)
                         : visitSorted(request, visit, executor, observer);
}

/// @param numbers the source with the numbers of the points.
void VoxelResampler::Implementation::notePoints(
  const PointRows& rows, std::size_t numbers, const std::int64_t* voxels, int count)
{
  const char* number = static_cast<const char*>(rows.tuples(numbers));
  for (int i = 0; i < count; ++i, number += rows.bytes)
  {
    std::int64_t point;
    std::memcpy(&point, number, sizeof point);
    voxelIndex[std::size_t(point)] = voxels[i];
  }
}

/// What the pass that sums did not make: the voxels of the points, and attributes and representatives.
Status VoxelResampler::Implementation::visitAgain(
  const VoxelRequest& request, const Executor& executor, ProgressObserver* observer)
{
  voxelIndex.assign(request.voxelIndex ? std::size_t(request.points.size()) : 0, -1);
  const auto note = [&](const PointRows& rows, const std::int64_t* voxels, int count)
  {
    if (request.voxelIndex)
    {
      notePoints(rows, request.tuples.size() - 1, voxels, count);
    }
  };
  Status status = Status::Ok;
  if (reduces(request) && !reducesInPass_)
  {
    status = reduceAgain(request, note, executor, observer);
  }
  else if (request.voxelIndex)
  {
    status = visitPointsByVoxel(request, note, executor, observer);
  }
  if (status == Status::Ok && keepsPoints(request.representative))
  {
    const std::int64_t* const chosen = levels[0].arena.chosen();
    chosenPoints.assign(chosen, chosen + levels[0].size);
  }
  return status;
}

/// @param visit is called with the points, too.
Status VoxelResampler::Implementation::reduceAgain(
  const VoxelRequest& request, const Visitor& visit, const Executor& executor, ProgressObserver* observer)
{
  VoxelReductions reductions(request);
  reductions.prepare(levels[0].arena.counts(), levels[0].size, levels.back().mostPoints(), executor);
  SubProgress visiting(observer, 0.0, 0.6);
  const auto add = [&](const PointRows& rows, const std::int64_t* voxels, int count)
  {
    reductions.add(rows, voxels, count);
    visit(rows, voxels, count);
  };
  Status status = visitPointsByVoxel(request, add, executor, &visiting);
  const double ofLevel = 0.4 / double(levels.size());
  double done = 0.6;
  for (std::size_t l = 0; status == Status::Ok && l < levels.size(); ++l, done += ofLevel)
  {
    SubProgress writing(observer, done, std::min(done + ofLevel, 1.0));
    if (l > 0)
    {
      reductions.regroup(levels[l].parents, levels[l].size, 0);
    }
    status = reductions.write(levels[l].arena, 0, executor, &writing) ? Status::Ok : Status::Aborted;
  }
  return status;
}

} // namespace pointhaptics
