/// VoxelResampler: what takes another pass over the points, and passes in general.
#include "Core/Resample/VoxelResamplerImplementation.h"

#include <algorithm>

namespace pointhaptics
{

using namespace simd;

Status VoxelResampler::Implementation::visitPoints(
  const VoxelRequest& request, const Visitor& visit, const Executor& executor, ProgressObserver* observer)
{
  return usesPartitions_ ? visitBinned(request, visit, executor, observer)
                         : visitSorted(request, visit, executor, observer);
}

/// What the pass that sums did not make: the voxels of the points, and attributes and representatives.
Status VoxelResampler::Implementation::visitAgain(
  const VoxelRequest& request, const Executor& executor, ProgressObserver* observer)
{
  const auto note = [&](const std::int64_t* points, const std::int64_t* voxels, int count)
  {
    for (int i = 0; request.voxelIndex && i < count; ++i)
    {
      voxelIndex[std::size_t(points[i])] = voxels[i];
    }
  };
  Status status = Status::Ok;
  if (visits(request))
  {
    status = reduces(request) ? reduceAgain(request, note, executor, observer)
                              : visitPoints(request, note, executor, observer);
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
  reductions.prepare(levels[0].arena.counts(), levels[0].size, levels[0].mostPoints(), executor);
  SubProgress visiting(observer, 0.0, 0.6);
  const auto add = [&](const std::int64_t* points, const std::int64_t* voxels, int count)
  {
    reductions.fetch(points, count);
    reductions.add(points, voxels, count);
    visit(points, voxels, count);
  };
  Status status = visitPoints(request, add, executor, &visiting);
  SubProgress writing(observer, 0.6, 1.0);
  const bool goesOn =
    status != Status::Ok || keepsSums_ || reductions.write(levels[0].arena, 0, executor, &writing);
  if (keepsTallies(request))
  {
    sums_.tallies = reductions.takeTallies();
  }
  return goesOn ? status : Status::Aborted;
}

} // namespace pointhaptics
