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

PointQuantizer generalQuantizer(const VoxelRequest& request)
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

Status VoxelResampler::Implementation::runGeneral(
  const VoxelRequest& request, const Executor& executor, ProgressObserver* observer)
{
  const VoxelRequest usable = withUsableIndex(request);
  const Chunks chunks(usable, kGeneralChunk, executor);
  quantizer_ = generalQuantizer(request);
  ranges_.choose(quantizer_, request.lattice, chunks);
  runs_.reset(ranges_.count(), quantizer_.fractionBits);
  std::int64_t inside = 0;
  invalid = usable.index ? request.points.size() - finitePoints(*usable.index) : 0;
  for (std::size_t chunk = 0; chunk < chunks.count(); ++chunk)
  {
    ranges_.bin(quantizer_, request.lattice, chunks, chunk, false, executor);
    inside += ranges_.inside();
    invalid += ranges_.invalid();
    forEachItem<KeyRanges::Sorted>(executor, ranges_.count(),
      [&](std::size_t range, KeyRanges::Sorted& scratch)
      { runs_.add(range, ranges_.sumsOf(range, scratch, request.covariances)); });
    if (observer && !observer->report(fractionOfFinest(request) * double(chunk + 1) / double(chunks.count())))
    {
      return Status::Aborted;
    }
  }
  clipped = request.points.size() - inside - invalid;
  return finishRuns(request, executor, observer);
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
  for (int halvings = halvings_; halvings > 0; --halvings)
  {
    // Of 64 voxels at most.
    VoxelRuns coarse;
    const Lattice fine = finerLattice(request.lattice, halvings);
    const CoarseVoxels coarsening(fine, runs_.fractionBits(), request.covariances);
    coarsening.ofRuns(runs_, coarse, executor, nullptr);
    runs_ = std::move(coarse);
  }
  writeRuns(request, runs_, request.levels > 1, levels[0], request.allocator, executor, nullptr);
  return request.levels > 1 ? addLevels(request, std::move(runs_), 0, executor, observer) : Status::Ok;
}

Status VoxelResampler::Implementation::sum(const VoxelRequest& request, VoxelRun& sums, int& fractionBits,
  const Executor& executor, ProgressObserver* observer)
{
  keepsRuns_ = true;
  const Status status = this->run(request, executor, observer);
  keepsRuns_ = false;
  fractionBits = status == Status::Ok ? runs_.fractionBits() : fractionBits;
  for (std::size_t range = 0; status == Status::Ok && range < runs_.ranges(); ++range)
  {
    if (runs_.size(range) > 0)
    {
      const VoxelRun& run = runs_.run(range);
      sums.voxels.insert(sums.voxels.end(), run.voxels.begin(), run.voxels.end());
      sums.secondMoments.insert(sums.secondMoments.end(), run.secondMoments.begin(), run.secondMoments.end());
      runs_.release(range);
    }
  }
  runs_.reset(0, 0);
  return status;
}

void VoxelResampler::Implementation::describeSums(
  const Lattice& lattice, int& fractionBits, std::uint64_t& keys)
{
  const int halvings = halvingsOf(lattice);
  const Lattice fine = halvings > 0 ? finerLattice(lattice, halvings) : lattice;
  const int indexBits = indexBitsOf(fine);
  fractionBits = (halvings >= 0 ? kPositionBits : positionBitsFor(indexBits)) - indexBits;
  keys = fine.key(0, 0, fine.dimensions[2]);
}

std::uint64_t VoxelResampler::Implementation::keyOfSums(const Lattice& lattice, std::uint64_t key)
{
  const int halvings = halvingsOf(lattice);
  if (halvings <= 0)
  {
    return key;
  }
  const auto index = finerLattice(lattice, halvings).indexOf(key);
  return lattice.key(index[0] >> halvings, index[1] >> halvings, index[2] >> halvings);
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
    halvings_ = std::max(halvingsOf(request.lattice), 0);
    runs_.reset(kRanges, fractionBits);
    for (std::size_t range = 0; range < kRanges; ++range)
    {
      const auto first = std::ptrdiff_t(sums.voxels.size() * range / kRanges);
      const auto last = std::ptrdiff_t(sums.voxels.size() * (range + 1) / kRanges);
      VoxelRun run;
      run.voxels.assign(sums.voxels.begin() + first, sums.voxels.begin() + last);
      if (!sums.secondMoments.empty())
      {
        run.secondMoments.assign(sums.secondMoments.begin() + first, sums.secondMoments.begin() + last);
      }
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

Status VoxelResampler::Implementation::visitGeneral(
  const VoxelRequest& request, const Visitor& visit, const Executor& executor, ProgressObserver* observer)
{
  const VoxelRequest usable = withUsableIndex(request);
  const Chunks chunks(usable, kGeneralChunk, executor);
  const PointQuantizer quantizer = generalQuantizer(request);
  const std::uint64_t* keys = levels[0].arena.keys();
  const std::uint64_t* end = keys + levels[0].size;
  chooseRows(request);
  ranges_.choose(quantizer, request.lattice, chunks);
  for (std::size_t chunk = 0; chunk < chunks.count(); ++chunk)
  {
    ranges_.bin(quantizer, request.lattice, chunks, chunk, true, executor);
    forEachItem<KeyRanges::Sorted>(executor, ranges_.count(),
      [&](std::size_t range, KeyRanges::Sorted& sorted)
      {
        ranges_.sort(range, sorted);
        RowCollector collector(rows_);
        std::int64_t points[kBlockRecords];
        std::int64_t voxels[kBlockRecords];
        const std::uint64_t* at = keys;
        for (std::size_t first = 0; first < sorted.size; first += kBlockRecords)
        {
          const std::size_t size = std::min(sorted.size - first, kBlockRecords);
          for (std::size_t i = 0; i < size; ++i)
          {
            const KeyRanges::Entry& entry = sorted.entries[first + i];
            const std::int64_t point = ranges_.pointOf(entry.point);
            at = firstNotBelow(at, end, entry.key);
            points[i] = usable.index ? usable.index->original(point) : point;
            voxels[i] = at - keys;
          }
          visit(collector.collect(points, int(size)), voxels, int(size));
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
