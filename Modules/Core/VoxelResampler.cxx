#include "Core/VoxelResampler.h"

#include "Core/Kernel/GeneralVoxels.h"
#include "Core/PointIndex.h"
#include "Core/VoxelResamplerImplementation.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{

using namespace kernel;

namespace
{

constexpr int kMostLevels = 22;

}

bool VoxelResampler::Implementation::isPlanned(const VoxelRequest& request, std::int64_t points) const
{
  const int indexBits = indexBitsOf(request.lattice);
  // The sums of places, over all points in one voxel at worst, must fit 63 bits.
  return indexBits >= kMinimumIndexBits && indexBits <= kMaximumIndexBits &&
    double(points) * std::ldexp(1.0, kPositionBits - indexBits) < 0x1p62 &&
    hasOrdinarySpacing(request.lattice);
}

Status VoxelResampler::Implementation::run(
  const VoxelRequest& request, const Executor& executor, Watcher* watcher)
{
  clear();
  if (request.levels < 1 || request.levels > kMostLevels ||
    (request.index && request.index->cloudSize() != request.points.size()))
  {
    return Status::InvalidParameter;
  }
  for (const Status status : { request.transform.check(), request.lattice.check() })
  {
    if (status != Status::Ok)
    {
      return status;
    }
  }
  levels[0].lattice = request.lattice;
  const std::int64_t points = request.points.size();
  const Status status = isPlanned(request, points) ? runPlanned(request, executor, watcher)
                                                   : runGeneral(request, executor, watcher);
  if (status != Status::Ok)
  {
    clear();
  }
  return status;
}

void VoxelResampler::Implementation::clear()
{
  levels.resize(1);
  levels[0].firsts.clear();
  levels[0].size = 0;
  clipped = invalid = 0;
  poolHoldsAll_ = false;
}

Status VoxelResampler::Implementation::runGeneral(
  const VoxelRequest& request, const Executor& executor, Watcher* watcher)
{
  const int indexBits = indexBitsOf(request.lattice);
  placement_ = makePlacement(request.transform, request.lattice, indexBits, positionBitsFor(indexBits));
  GeneralAdder adder(placement_, request.lattice, request.covariances);
  for (std::int64_t first = 0; first < request.points.size(); first += kGeneralChunk)
  {
    adder.add(request.points, first, std::min(kGeneralChunk, request.points.size() - first), executor);
    if (watcher &&
      !watcher->proceed(shareOfFinest(request) *
        std::min(1.0, double(first + kGeneralChunk) / double(request.points.size()))))
    {
      return Status::Aborted;
    }
  }
  invalid = adder.invalid();
  clipped = request.points.size() - adder.inside() - invalid;
  VoxelSumList list = adder.take();
  levels[0].arena.write(
    list, { request.singlePrecision, request.keys, request.covariances }, request.lattice, request.memory);
  levels[0].size = std::int64_t(list.voxels.size());
  return request.levels > 1 ? addLevels(request, std::move(list), watcher) : Status::Ok;
}

Status VoxelResampler::Implementation::addLevels(
  const VoxelRequest& request, VoxelSumList list, Watcher* watcher)
{
  for (int l = 1; l < request.levels; ++l)
  {
    Level level;
    level.lattice = coarserLattice(levels.back().lattice);
    list = coarserSums(list, levels.back().lattice, level.lattice, level.parents);
    level.arena.write(list, { request.singlePrecision, request.keys, request.covariances }, level.lattice);
    level.size = std::int64_t(list.voxels.size());
    levels.push_back(std::move(level));
    const double share = shareOfFinest(request);
    if (watcher && !watcher->proceed(share + (1.0 - share) * double(l) / double(request.levels - 1)))
    {
      return Status::Aborted;
    }
  }
  return Status::Ok;
}

Status VoxelResampler::Implementation::assign(
  const VoxelRequest& request, const Visitor& visit, const Executor& executor, Watcher* watcher)
{
  return isPlanned(request, request.points.size()) ? assignPlanned(request, visit, executor, watcher)
                                                   : assignGeneral(request, visit, executor, watcher);
}

/// Point by point, in this thread.
Status VoxelResampler::Implementation::assignGeneral(
  const VoxelRequest& request, const Visitor& visit, const Executor&, Watcher* watcher)
{
  const std::uint64_t* keys = levels[0].arena.keys();
  const std::uint64_t* end = keys + levels[0].size;
  for (std::int64_t i = 0; i < request.points.size(); ++i)
  {
    std::uint64_t position[3];
    if (placePoint(placement_, request.points[i], position) == Place::Inside)
    {
      const std::uint64_t key = request.lattice.key(std::int64_t(position[0] >> placement_.fractionBits),
        std::int64_t(position[1] >> placement_.fractionBits),
        std::int64_t(position[2] >> placement_.fractionBits));
      const std::int64_t voxel = std::lower_bound(keys, end, key) - keys;
      visit(&i, &voxel, 1);
    }
    if (watcher && (i + 1) % kGeneralChunk == 0 &&
      !watcher->proceed(double(i + 1) / double(request.points.size())))
    {
      return Status::Aborted;
    }
  }
  return Status::Ok;
}

std::size_t VoxelResampler::Implementation::scratchBytes() const
{
  std::size_t sum = pool_.bytes();
  for (const std::unique_ptr<PartitionWorker>& worker : idle_)
  {
    sum += worker->bytes();
  }
  for (const CarriedPartition& partition : carried_)
  {
    sum += partition.bytes();
  }
  for (const Level& level : levels)
  {
    sum += level.arena.bytes() + level.firsts.capacity() * sizeof(std::size_t);
  }
  return sum;
}

VoxelResampler::VoxelResampler()
  : implementation_(std::make_unique<Implementation>())
{
}

VoxelResampler::~VoxelResampler() = default;
VoxelResampler::VoxelResampler(VoxelResampler&&) noexcept = default;
VoxelResampler& VoxelResampler::operator=(VoxelResampler&&) noexcept = default;

Status VoxelResampler::run(const VoxelRequest& request, const Executor& executor, Watcher* watcher)
{
  return implementation_->run(request, executor, watcher);
}

Status VoxelResampler::assign(
  const VoxelRequest& request, const Visitor& visit, const Executor& executor, Watcher* watcher)
{
  return implementation_->assign(request, visit, executor, watcher);
}

void VoxelResampler::assignInSets(const VoxelRequest& request, const SetWork& work, const Executor& executor)
{
  implementation_->assignInSets(request, work, executor);
}

bool VoxelResampler::canAssignInSets() const
{
  return implementation_->poolHoldsAll();
}

std::int64_t VoxelResampler::clippedPoints() const
{
  return implementation_->clipped;
}

std::int64_t VoxelResampler::invalidPoints() const
{
  return implementation_->invalid;
}

std::int64_t VoxelResampler::size(int level) const
{
  return implementation_->levels[std::size_t(level)].size;
}

std::int64_t VoxelResampler::mostPoints(int l) const
{
  const Level& level = implementation_->levels[std::size_t(l)];
  return level.size == 0 ? 0 : *std::max_element(counts(l), counts(l) + level.size);
}

const Lattice& VoxelResampler::lattice(int level) const
{
  return implementation_->levels[std::size_t(level)].lattice;
}

const std::vector<std::int64_t>& VoxelResampler::parents(int level) const
{
  return implementation_->levels[std::size_t(level)].parents;
}

void VoxelResampler::copyMeans(int l, float* xyz, const Executor& executor) const
{
  const Level& level = implementation_->levels[std::size_t(l)];
  copyArray(level.arena.floats(), 3 * level.size, xyz, executor);
}

void VoxelResampler::copyMeans(int l, double* xyz, const Executor& executor) const
{
  const Level& level = implementation_->levels[std::size_t(l)];
  copyArray(level.arena.doubles(), 3 * level.size, xyz, executor);
}

void VoxelResampler::copyCounts(int l, std::int64_t* counts, const Executor& executor) const
{
  const Level& level = implementation_->levels[std::size_t(l)];
  copyArray(level.arena.counts(), level.size, counts, executor);
}

const std::int64_t* VoxelResampler::counts(int l) const
{
  return implementation_->levels[std::size_t(l)].arena.counts();
}

void VoxelResampler::copyKeys(int l, std::uint64_t* keys, const Executor& executor) const
{
  const Level& level = implementation_->levels[std::size_t(l)];
  copyArray(level.arena.keys(), level.size, keys, executor);
}

void VoxelResampler::copyCovariances(int l, SymMat3* covariances, const Executor& executor) const
{
  const Level& level = implementation_->levels[std::size_t(l)];
  copyArray(level.arena.covariances(), level.size, covariances, executor);
}

void VoxelResampler::releaseScratch()
{
  implementation_ = std::make_unique<Implementation>();
}

std::size_t VoxelResampler::scratchBytes() const
{
  return implementation_->scratchBytes();
}

} // namespace pointhaptics
