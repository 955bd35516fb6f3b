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

/// Copies an array unless it is there already.
template <typename T>
void copyArray(const T* from, std::int64_t count, T* to, const Executor& executor)
{
  constexpr std::int64_t kGrain = 1 << 14; // Elements worth a thread of their own.
  if (from != to)
  {
    forRange(executor, count, kGrain,
      [&](std::int64_t begin, std::int64_t end) { std::copy(from + begin, from + end, to + begin); });
  }
}

}

Status VoxelResampler::Implementation::check(const VoxelRequest& request)
{
  const PointIndex* index = request.index;
  const std::int64_t points = request.points.size();
  const bool isOwnPoints = index && points > 0 && request.points.floats() == index->points().floats() &&
    request.points.doubles() == index->points().doubles();
  if ((choosesPoints(request) && (isOwnPoints || points > kMostChosenAmong)) ||
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

Status VoxelResampler::Implementation::run(
  const VoxelRequest& request, const Executor& executor, ProgressObserver* observer)
{
  VoxelRequest wanted = request;
  wanted.keys = request.keys || choosesPoints(request);
  VoxelRun sums;
  const Status status = sumPoints({ wanted, true }, sums, executor, observer);
  if (status != Status::Ok)
  {
    clear();
  }
  else if (keepsPoints(request.representative))
  {
    chosenPoints.assign(writer.chosen(), writer.chosen() + size);
  }
  return status;
}

Status VoxelResampler::Implementation::sum(
  const VoxelRequest& request, VoxelRun& sums, const Executor& executor, ProgressObserver* observer)
{
  return sumPoints({ request, false }, sums, executor, observer);
}

Status VoxelResampler::Implementation::finish(
  const VoxelRequest& request, const VoxelRun& sums, const Executor& executor, ProgressObserver* observer)
{
  clear();
  const Status status = check(request);
  if (status != Status::Ok)
  {
    return status;
  }
  lattice = request.lattice;
  size = std::int64_t(sums.size());
  writer.prepare(sums.size(), layoutOf(request), lattice, fractionBitsOf(lattice), request.allocator);
  PointProgress progress(observer, size, 1);
  const bool isDone = forReportedSlices(size, progress,
    [&](std::int64_t first, std::int64_t last)
    {
      forRange(executor, last - first,
        [&](std::int64_t begin, std::int64_t end)
        { writeRun(request, sums, std::size_t(first + begin), std::size_t(first + end), 0); });
    });
  return isDone ? Status::Ok : (clear(), Status::Aborted);
}

void VoxelResampler::Implementation::clear()
{
  size = 0;
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

/// Writes voxels @p first to before @p last of a run, whose voxels begin at @p offset of the result.
void VoxelResampler::Implementation::writeRun(
  const VoxelRequest& request, const VoxelRun& run, std::size_t first, std::size_t last, std::size_t offset)
{
  const std::size_t to = offset + first;
  writer.write(to, run, first, last);
  const std::array<Vec3, 3> columns = normalColumns(request.transform);
  for (std::size_t i = 0; i < run.tallies.size(); ++i)
  {
    const AttributeRequest& array = request.attributes[i];
    run.tallies[i].write({ array.view.type, array.view.components, array.statistic }, first, last,
      writer.counts() + to, columns, writer.attribute(i, to));
  }
}

std::size_t VoxelResampler::Implementation::scratchBytes() const
{
  return binned_.bytes() + sorted_.bytes() + places_.capacity() + writer.bytes() +
    (chosenPoints.capacity() + voxelIndex.capacity()) * sizeof(std::int64_t);
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

std::int64_t VoxelResampler::clippedPoints() const
{
  return implementation_->clipped;
}

std::int64_t VoxelResampler::invalidPoints() const
{
  return implementation_->invalid;
}

std::int64_t VoxelResampler::size() const
{
  return implementation_->size;
}

std::int64_t VoxelResampler::mostPoints() const
{
  return size() == 0 ? 0 : *std::max_element(counts(), counts() + size());
}

const Lattice& VoxelResampler::lattice() const
{
  return implementation_->lattice;
}

const std::vector<std::int64_t>& VoxelResampler::chosenPoints() const
{
  return implementation_->chosenPoints;
}

const std::vector<std::int64_t>& VoxelResampler::voxelIndex() const
{
  return implementation_->voxelIndex;
}

void VoxelResampler::copyMeans(float* xyz, const Executor& executor) const
{
  copyArray(implementation_->writer.floats(), 3 * size(), xyz, executor);
}

void VoxelResampler::copyMeans(double* xyz, const Executor& executor) const
{
  copyArray(implementation_->writer.doubles(), 3 * size(), xyz, executor);
}

void VoxelResampler::copyCounts(std::int64_t* to, const Executor& executor) const
{
  copyArray(counts(), size(), to, executor);
}

const std::int64_t* VoxelResampler::counts() const
{
  return implementation_->writer.counts();
}

void VoxelResampler::copyKeys(std::uint64_t* keys, const Executor& executor) const
{
  copyArray(implementation_->writer.keys(), size(), keys, executor);
}

void VoxelResampler::copyCovariances(SymMat3* covariances, const Executor& executor) const
{
  copyArray(implementation_->writer.covariances(), size(), covariances, executor);
}

const void* VoxelResampler::attribute(std::size_t attribute) const
{
  return implementation_->writer.attribute(attribute, 0);
}

void VoxelResampler::copyAttribute(std::size_t attribute, void* tuples, const Executor& executor) const
{
  const VoxelWriter& writer = implementation_->writer;
  copyArray(writer.attribute(attribute, 0), size() * std::int64_t(writer.attributeBytes(attribute)),
    static_cast<char*>(tuples), executor);
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
