/// VoxelResampler on all other lattices: points are sorted by key, range by range.
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
  const PointQuantizer quantizer = sortedQuantizer(request);
  sorted_.choose(quantizer, request.lattice, chunks);
  runs_.reset(sorted_.ranges(), quantizer.fractionBits);
  startCounts(usable);
  SubProgress summing(observer, 0.0, fractionOfSums(request));
  for (std::size_t chunk = 0; chunk < chunks.count(); ++chunk)
  {
    sorted_.sum(chunks, chunk, request.covariances, runs_, executor);
    countPoints(sorted_.inside(), sorted_.invalid());
    if (!summing.report(fractionOfFinest(request) * double(chunk + 1) / double(chunks.count())))
    {
      return Status::Aborted;
    }
  }
  return finishRuns(request, executor, &summing);
}

/// Means of the runs.
Status VoxelResampler::Implementation::finishRuns(
  const VoxelRequest& request, const Executor& executor, ProgressObserver* observer)
{
  forEachItem(executor, runs_.ranges(), [&](std::size_t range) { runs_.join(range); });
  if (keepsRuns_)
  {
    return Status::Ok;
  }
  writeRuns(request, request.levels > 1, levels[0], request.allocator, executor, nullptr);
  return request.levels > 1 ? addLevels(request, executor, observer) : Status::Ok;
}

Status VoxelResampler::Implementation::sum(const VoxelRequest& request, VoxelRun& sums, int& fractionBits,
  const Executor& executor, ProgressObserver* observer)
{
  keepsRuns_ = true;
  const Status status = this->run(request, executor, observer);
  keepsRuns_ = false;
  fractionBits = status == Status::Ok ? runs_.fractionBits() : fractionBits;
  std::size_t voxels = 0;
  for (std::size_t range = 0; range < runs_.ranges(); ++range)
  {
    voxels += runs_.size(range);
  }
  sums.voxels.reserve(voxels);
  sums.secondMoments.reserve(request.covariances ? voxels : 0);
  for (std::size_t range = 0; status == Status::Ok && range < runs_.ranges(); ++range)
  {
    if (runs_.size(range) > 0)
    {
      sums.append(runs_.run(range), 0, runs_.size(range));
      runs_.release(range);
    }
  }
  runs_.reset(0, 0);
  return status;
}

/// @param sums the voxels in ascending order.
Status VoxelResampler::Implementation::finishSums(const VoxelRequest& request, const VoxelRun& sums,
  int fractionBits, const Executor& executor, ProgressObserver* observer)
{
  clear();
  Status status = check(request);
  if (status == Status::Ok)
  {
    constexpr std::size_t kRanges = 64;
    levels[0].lattice = request.lattice;
    runs_.reset(kRanges, fractionBits);
    for (std::size_t range = 0; range < kRanges; ++range)
    {
      const std::size_t size = sums.voxels.size();
      VoxelRun run;
      run.append(sums, size * range / kRanges, size * (range + 1) / kRanges);
      runs_.add(range, std::move(run));
    }
    status = finishRuns(request, executor, observer);
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
  const VoxelRequest usable = withUsableIndex(request);
  const Chunks chunks(usable, kSortedChunk, executor);
  const std::uint64_t* keys = levels[0].arena.keys();
  const std::uint64_t* end = keys + levels[0].size;
  sorted_.choose(sortedQuantizer(request), request.lattice, chunks);
  for (std::size_t chunk = 0; chunk < chunks.count(); ++chunk)
  {
    sorted_.sort(chunks, chunk, executor);
    forEachItem(executor, sorted_.ranges(),
      [&](std::size_t range)
      {
        std::int64_t points[kBlockRecords];
        std::int64_t voxels[kBlockRecords];
        sorted_.forEntries(range,
          [&](const SortedPoints::Entry* entry, const SortedPoints::Entry* last)
          {
            for (const std::uint64_t* at = keys; entry != last;)
            {
              int size = 0;
              for (; entry != last && size < int(kBlockRecords); ++entry, ++size)
              {
                at = firstNotBelow(at, end, entry->key);
                points[size] = chunks.originals() ? chunks.originals()[entry->point] : entry->point;
                voxels[size] = at - keys;
              }
              visit(points, voxels, size);
            }
          });
      });
    if (observer && !observer->report(double(chunk + 1) / double(chunks.count())))
    {
      return Status::Aborted;
    }
  }
  return Status::Ok;
}

} // namespace pointhaptics
