#include "Core/Resample/VoxelResampler.h"

#include "Core/Neighbors/PointIndex.h"
#include "Core/Resample/VoxelResamplerImplementation.h"

#include <algorithm>
#include <array>

namespace pointhaptics
{

using namespace simd;

namespace
{

constexpr int kMostLevels = 22;
/// The part of the work that the finest of several levels is.
constexpr double kFinest = 0.5;

}

Status VoxelResampler::Implementation::check(const VoxelRequest& request)
{
  const PointIndex* index = request.index;
  const std::int64_t points = request.points.size();
  const bool isOwnPoints = index && points > 0 && request.points.floats() == index->points().floats() &&
    request.points.doubles() == index->points().doubles();
  if (request.levels < 1 || request.levels > kMostLevels ||
    (choosesPoints(request) && (request.levels > 1 || isOwnPoints || points > kMostChosenAmong)) ||
    (index && index->cloudSize() != points && finitePoints(*index) != points) ||
    std::any_of(request.attributes.begin(), request.attributes.end(),
      [&](const AttributeRequest& attribute)
      {
        return attribute.view.tuples < points || attribute.view.components < 1 ||
          (attribute.statistic == AttributeStatistic::Normal && attribute.view.components != 3);
      }))
  {
    return Status::InvalidParameter;
  }
  const Status status = request.transform.check();
  return status == Status::Ok ? request.lattice.check() : status;
}

/// The points' sums, the finest level, and the coarser ones.
Status VoxelResampler::Implementation::run(
  const VoxelRequest& request, const Executor& executor, ProgressObserver* observer)
{
  VoxelRequest wanted = request;
  wanted.keys = request.keys || choosesPoints(request);
  VoxelRun sums;
  SubProgress summing(observer, 0.0, request.levels > 1 ? kFinest : 1.0);
  Status status = sumPoints({ wanted, true, request.levels > 1 }, sums, executor, &summing);
  status = status == Status::Ok ? addLevels(wanted, sums, executor, observer) : status;
  if (status != Status::Ok)
  {
    clear();
  }
  else if (keepsPoints(request.representative))
  {
    const std::int64_t* const chosen = levels[0].writer.chosen();
    chosenPoints.assign(chosen, chosen + levels[0].size);
  }
  return status;
}

Status VoxelResampler::Implementation::sum(
  const VoxelRequest& request, VoxelRun& sums, const Executor& executor, ProgressObserver* observer)
{
  return sumPoints({ request, false, true }, sums, executor, observer);
}

Status VoxelResampler::Implementation::finish(
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

void VoxelResampler::Implementation::clear()
{
  levels.resize(1);
  levels[0].size = 0;
  clipped = invalid = 0;
  chosenPoints.clear();
  voxelIndex.clear();
}

VoxelWriter::Layout VoxelResampler::Implementation::layoutOf(const VoxelRequest& request)
{
  VoxelWriter::Layout layout = { request.singlePrecision, request.keys, request.covariances,
    keepsPoints(request.representative) };
  for (const AttributeRequest& attribute : request.attributes)
  {
    layout.attributeBytes.push_back(std::size_t(attribute.view.tupleBytes()));
  }
  return layout;
}

int VoxelResampler::Implementation::fractionBitsOf(const Lattice& lattice)
{
  const int indexBits = indexBitsOf(lattice);
  return positionBitsFor(indexBits) - indexBits;
}

/// Writes voxels @p first to before @p last of a run, from @p offset of a level on.
void VoxelResampler::Implementation::writeRun(const VoxelRequest& request, const VoxelRun& run,
  std::size_t first, std::size_t last, VoxelWriter& writer, std::size_t offset)
{
  writer.write(offset, run, first, last);
  const std::array<Vec3, 3> columns = normalColumns(request.transform);
  for (std::size_t i = 0; i < run.tallies.size(); ++i)
  {
    const AttributeRequest& array = request.attributes[i];
    run.tallies[i].write({ array.view.type, array.view.components, array.statistic }, first, last,
      writer.counts() + offset, columns, kernelsFor(request.instructions).attributes,
      writer.attribute(i, offset));
  }
}

/// Writes the means of voxels to a level. @return false where the observer ended the work.
bool VoxelResampler::Implementation::writeSums(const VoxelRequest& request, const VoxelRun& sums,
  int fractionBits, Level& level, OutputAllocator* allocator, const Executor& executor,
  ProgressObserver* observer)
{
  level.size = std::int64_t(sums.size());
  level.writer.prepare(sums.size(), layoutOf(request), level.lattice, fractionBits, allocator);
  PointProgress progress(observer, level.size, 1);
  return forReportedSlices(level.size, progress,
    [&](std::int64_t first, std::int64_t last)
    {
      forRange(executor, last - first,
        [&](std::int64_t begin, std::int64_t end)
        {
          const auto from = std::size_t(first + begin);
          writeRun(request, sums, from, std::size_t(first + end), level.writer, from);
        });
    });
}

/// @param sums those of the finest level.
Status VoxelResampler::Implementation::addLevels(
  const VoxelRequest& request, const VoxelRun& sums, const Executor& executor, ProgressObserver* observer)
{
  const auto progressAt = [&](int level)
  { return kFinest + (1.0 - kFinest) * double(level - 1) / double(request.levels - 1); };
  int fractionBits = fractionBitsOf(levels[0].lattice);
  VoxelRun coarse;
  for (int l = 1; l < request.levels; ++l)
  {
    const Level& finer = levels.back();
    const VoxelRun& fine = l == 1 ? sums : coarse;
    Level level;
    level.lattice = coarserLattice(finer.lattice);
    SubProgress part(observer, progressAt(l), progressAt(l + 1));
    SubProgress summing(&part, 0.0, 0.7);
    SubProgress writing(&part, 0.7, 1.0);
    VoxelRun next;
    const bool isSame = level.lattice.dimensions == finer.lattice.dimensions;
    if (!isSame && !sumCoarseVoxels(fine, finer.lattice, fractionBits, next, executor, &summing))
    {
      return Status::Aborted;
    }
    fractionBits += !isSame;
    coarse = isSame ? fine : std::move(next);
    if (!writeSums(request, coarse, fractionBits, level, nullptr, executor, &writing))
    {
      return Status::Aborted;
    }
    levels.push_back(std::move(level));
  }
  return Status::Ok;
}

std::size_t VoxelResampler::Implementation::scratchBytes() const
{
  std::size_t sum = binned_.bytes() + sorted_.bytes() + places_.capacity() +
    (chosenPoints.capacity() + voxelIndex.capacity()) * sizeof(std::int64_t);
  for (const Level& level : levels)
  {
    sum += level.writer.bytes();
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

Status VoxelResampler::run(const VoxelRequest& request, const Executor& executor, ProgressObserver* observer)
{
  return implementation_->run(request, executor, observer);
}

int VoxelResampler::exactLevels(const Lattice& lattice, int levels)
{
  const int indexBits = indexBitsOf(lattice);
  if (indexBits <= kMaximumIndexBits)
  {
    return levels;
  }
  const int others = indexBits > kUncorrectedIndexBits ? kUncorrectedIndexBits : kMaximumIndexBits;
  return std::min(levels, indexBits - others);
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

std::int64_t VoxelResampler::mostPoints(int level) const
{
  return implementation_->levels[std::size_t(level)].mostPoints();
}

const Lattice& VoxelResampler::lattice(int level) const
{
  return implementation_->levels[std::size_t(level)].lattice;
}

const std::vector<std::int64_t>& VoxelResampler::chosenPoints() const
{
  return implementation_->chosenPoints;
}

const std::vector<std::int64_t>& VoxelResampler::voxelIndex() const
{
  return implementation_->voxelIndex;
}

void VoxelResampler::copyMeans(int l, float* xyz, const Executor& executor) const
{
  const Level& level = implementation_->levels[std::size_t(l)];
  copyArray(level.writer.floats(), 3 * level.size, xyz, executor);
}

void VoxelResampler::copyMeans(int l, double* xyz, const Executor& executor) const
{
  const Level& level = implementation_->levels[std::size_t(l)];
  copyArray(level.writer.doubles(), 3 * level.size, xyz, executor);
}

void VoxelResampler::copyCounts(int l, std::int64_t* counts, const Executor& executor) const
{
  const Level& level = implementation_->levels[std::size_t(l)];
  copyArray(level.writer.counts(), level.size, counts, executor);
}

const std::int64_t* VoxelResampler::counts(int l) const
{
  return implementation_->levels[std::size_t(l)].writer.counts();
}

void VoxelResampler::copyKeys(int l, std::uint64_t* keys, const Executor& executor) const
{
  const Level& level = implementation_->levels[std::size_t(l)];
  copyArray(level.writer.keys(), level.size, keys, executor);
}

void VoxelResampler::copyCovariances(int l, SymMat3* covariances, const Executor& executor) const
{
  const Level& level = implementation_->levels[std::size_t(l)];
  copyArray(level.writer.covariances(), level.size, covariances, executor);
}

const void* VoxelResampler::attribute(int l, std::size_t attribute) const
{
  return implementation_->levels[std::size_t(l)].writer.attribute(attribute, 0);
}

void VoxelResampler::copyAttribute(int l, std::size_t attribute, void* tuples, const Executor& executor) const
{
  const Level& level = implementation_->levels[std::size_t(l)];
  copyArray(level.writer.attribute(attribute, 0),
    level.size * std::int64_t(level.writer.attributeBytes(attribute)), static_cast<char*>(tuples), executor);
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
