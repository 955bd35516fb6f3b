/// VoxelResampler on all other lattices: points are sorted by key.
#include "Core/Neighbors/PointIndex.h"
#include "Core/Resample/VoxelResamplerImplementation.h"

#include <algorithm>

namespace pointhaptics
{

using namespace simd;

namespace
{

/// The index's bounds are not reliable for the smallest and the largest numbers.
VoxelRequest withUsableIndex(const VoxelRequest& request)
{
  VoxelRequest usable = request;
  if (!hasOrdinarySpacing(request.lattice))
  {
    usable.index = nullptr;
  }
  return usable;
}

PointQuantizer sortedQuantizer(const VoxelRequest& request)
{
  const int indexBits = indexBitsOf(request.lattice);
  return makeQuantizer(request.transform, request.lattice, indexBits, positionBitsFor(indexBits));
}

/// The first of ascending keys that is not below @p key, by galloping: it is mostly near the first.
const std::uint64_t* firstNotBelow(const std::uint64_t* keys, const std::uint64_t* end, std::uint64_t key)
{
  std::ptrdiff_t step = 1;
  while (step < end - keys && keys[step] < key)
  {
    keys += step;
    step *= 2;
  }
  return std::lower_bound(keys, keys + std::min(step + 1, end - keys), key);
}

}

Status VoxelResampler::Implementation::runSorted(
  const VoxelRequest& request, const Executor& executor, ProgressObserver* observer)
{
  const VoxelRequest usable = withUsableIndex(request);
  const Chunks chunks(usable, kSortedChunk, executor);
  sorted_.prepare(sortedQuantizer(request), request.lattice);
  std::vector<VoxelRuns> ranges = sorted_.chooseRanges(chunks.points());
  startCounts(usable);
  SubProgress summing(observer, 0.0, fractionOfSums(request));
  for (std::size_t chunk = 0; chunk < chunks.count(); ++chunk)
  {
    sorted_.sort(chunks, chunk, executor);
    sorted_.sum(request.covariances, ranges, executor);
    countPoints(sorted_.inside(), sorted_.invalid());
    if (!summing.report(double(chunk + 1) / double(chunks.count())))
    {
      return Status::Aborted;
    }
  }
  std::vector<VoxelRun> runs(ranges.size());
  forEachItem(
    executor, ranges.size(), [&](std::size_t range) { runs[range] = std::move(ranges[range].whole()); });
  if (writesMeans(request))
  {
    Level& level = levels[0];
    level.firsts.assign(1, 0);
    for (const VoxelRun& run : runs)
    {
      level.firsts.push_back(level.firsts.back() + run.size());
    }
    level.size = std::int64_t(level.firsts.back());
    level.arena.prepare(level.firsts.back(), layoutOf(request), level.lattice,
      fractionBitsOf(request.lattice), request.allocator);
    forEachItem(executor, runs.size(),
      [&](std::size_t range)
      {
        level.arena.write(level.firsts[range], runs[range], 0, runs[range].size());
        if (request.levels == 1 && !keepsSums_)
        {
          runs[range] = VoxelRun();
        }
      });
  }
  sums_ = concatenated(runs, executor);
  return Status::Ok;
}

Status VoxelResampler::Implementation::sum(
  const VoxelRequest& request, VoxelRun& sums, const Executor& executor, ProgressObserver* observer)
{
  keepsSums_ = true;
  const Status status = this->run(request, executor, observer);
  keepsSums_ = false;
  sums = std::move(sums_);
  return status;
}

/// @param sums the voxels in ascending order.
Status VoxelResampler::Implementation::finishSums(
  const VoxelRequest& request, const VoxelRun& sums, const Executor& executor, ProgressObserver* observer)
{
  clear();
  Status status = check(request);
  if (status == Status::Ok)
  {
    levels[0].lattice = request.lattice;
    writeSums(
      request, sums, fractionBitsOf(request.lattice), levels[0], request.allocator, executor, nullptr);
    status = addLevels(request, sums, executor, observer);
  }
  if (status != Status::Ok)
  {
    clear();
  }
  return status;
}

Status VoxelResampler::Implementation::visitSorted(
  const VoxelRequest& request, const Visitor& visit, const Executor& executor, ProgressObserver* observer)
{
  constexpr std::int64_t kRanges = 64; // of voxels, for the threads
  const VoxelRequest usable = withUsableIndex(request);
  const Chunks chunks(usable, kSortedChunk, executor);
  const std::uint64_t* keys = levels[0].arena.keys();
  sorted_.prepare(sortedQuantizer(request), request.lattice);
  for (std::size_t chunk = 0; chunk < chunks.count(); ++chunk)
  {
    sorted_.sort(chunks, chunk, executor);
    forEachItem(executor, kRanges,
      [&](std::size_t range)
      {
        const std::uint64_t* const first = keys + levels[0].size * std::int64_t(range) / kRanges;
        const std::uint64_t* const last = keys + levels[0].size * std::int64_t(range + 1) / kRanges;
        std::int64_t points[kBlockRecords];
        std::int64_t voxels[kBlockRecords];
        for (std::size_t slice = 0; first != last && slice < sorted_.slices(); ++slice)
        {
          const auto entries = sorted_.entries(slice, first[0], last[-1]);
          const std::uint64_t* at = first;
          for (const SortedPoints::Entry* entry = entries.first; entry != entries.second;)
          {
            int size = 0;
            for (; entry != entries.second && size < int(kBlockRecords); ++entry, ++size)
            {
              at = firstNotBelow(at, last, entry->key);
              points[size] = chunks.originals() ? chunks.originals()[entry->point] : entry->point;
              voxels[size] = at - keys;
            }
            visit(points, voxels, size);
          }
        }
      });
    if (observer && !observer->report(double(chunk + 1) / double(chunks.count())))
    {
      return Status::Aborted;
    }
  }
  return Status::Ok;
}

} // namespace pointhaptics
