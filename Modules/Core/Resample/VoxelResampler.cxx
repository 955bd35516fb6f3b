#include "Core/Resample/VoxelResampler.h"

#include "Core/Neighbors/PointIndex.h"
#include "Core/Resample/VoxelResamplerImplementation.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <iterator>
#include <memory>
#include <new>
#include <utility>

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

static_assert(kChunkPoints <= kPointsPerReport, "progress is reported after each chunk");

AttributeView viewOf(const PointView& points)
{
  const bool single = points.floats() != nullptr;
  return { single ? static_cast<const void*>(points.floats()) : points.doubles(),
    single ? ScalarType::Float : ScalarType::Double, 3, points.size(),
    points.stride() * (single ? std::int64_t(sizeof(float)) : std::int64_t(sizeof(double))) };
}

/// Whether points are binned into partitions of the lattice, or sorted.
bool usesPartitions(const Lattice& lattice)
{
  return fitsPartitions(lattice, indexBitsOf(lattice)) && hasOrdinarySpacing(lattice);
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
  writer.prepare(request, sums.size(), fractionBitsOf(lattice));
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

template <typename Voxels>
void VoxelResampler::Implementation::Stages<Voxels>::prepareWorkers(
  const Task& task, std::int64_t* indexOfPoints, int count)
{
  const VoxelRequest& request = task.request;
  const bool reduces = choosesPoints(request) || !request.attributes.empty();
  workers.resize(std::max(workers.size(), std::size_t(count)));
  for (std::unique_ptr<Worker>& worker : workers)
  {
    worker = worker ? std::move(worker) : std::make_unique<Worker>();
    worker->voxels.prepare(request, source);
    worker->reductions.reset();
    if (reduces)
    {
      worker->reductions.emplace(
        request, task.arrays, source.payloadLayout(), source.fractionBits(), indexOfPoints);
    }
  }
}

/// The places of points, in the type that is asked for.
AttributeView VoxelResampler::Implementation::placesOf(const VoxelRequest& request, const Executor& executor)
{
  const PointView& points = request.points;
  if (request.transform.isIdentity() && request.singlePrecision == (points.floats() != nullptr))
  {
    return viewOf(points);
  }
  const auto move = [&](auto example)
  {
    using Real = decltype(example);
    places_.resize(std::size_t(3 * points.size()) * sizeof(Real));
    Real* const to = reinterpret_cast<Real*>(places_.data());
    forRange(executor, points.size(),
      [&](std::int64_t begin, std::int64_t end)
      {
        for (std::int64_t i = begin; i < end; ++i)
        {
          const Vec3 place = request.transform.apply(points[i]);
          std::transform(&place.x, &place.x + 3, to + 3 * i, [](double x) { return Real(x); });
        }
      });
    return viewOf(PointView(to, points.size()));
  };
  return request.singlePrecision ? move(float()) : move(double());
}

Status VoxelResampler::Implementation::sumPoints(
  const Task& task, VoxelRun& sums, const Executor& executor, ProgressObserver* observer)
{
  clear();
  const VoxelRequest& request = task.request;
  const Status status = check(request);
  if (status != Status::Ok)
  {
    return status;
  }
  Task wanted = task;
  for (AttributeRequest array : request.attributes)
  {
    if (isSum(array.statistic) && !array.range)
    {
      array.range = rangeOf(array.view, executor);
    }
    wanted.arrays.push_back(array);
  }
  if (request.representative == Representative::Median)
  {
    wanted.arrays.push_back({ placesOf(request, executor), AttributeStatistic::Median });
  }
  voxelIndex.assign(request.voxelIndex ? std::size_t(request.points.size()) : 0, -1);
  lattice = request.lattice;
  return usesPartitions(request.lattice) ? runStages(binned_, wanted, sums, executor, observer)
                                         : runStages(sorted_, wanted, sums, executor, observer);
}

/// The stages: quantize and bin, or sort; sum; write.
template <typename Voxels>
Status VoxelResampler::Implementation::runStages(Stages<Voxels>& stages, const Task& wanted, VoxelRun& sums,
  const Executor& executor, ProgressObserver* observer)
{
  const VoxelRequest& request = wanted.request;
  auto& source = stages.source;
  const Chunks chunks(request, source.kChunkPoints, executor);
  // Where points are chosen, all of a voxel must be there at once.
  const std::size_t held = choosesPoints(request) ? chunks.count() : source.kHeldChunks;
  const bool isWhole = chunks.count() <= held;
  Task task = wanted;
  task.writes = wanted.writes && isWhole;
  std::vector<AttributeView> views;
  for (const AttributeRequest& array : task.arrays)
  {
    views.push_back(array.view);
  }
  source.prepare(request, chunks, views, request.voxelIndex || keepsPoints(request.representative));
  invalid = request.index ? request.points.size() - finitePoints(*request.index) : 0;
  clipped = request.points.size() - invalid;
  std::vector<VoxelRuns> runs(task.writes ? 0 : source.partitions());
  for (std::size_t first = 0; first < chunks.count(); first += held)
  {
    const std::size_t last = std::min(first + held, chunks.count());
    const auto progressAt = [&](std::size_t chunk) { return double(chunk) / double(chunks.count()); };
    SubProgress part(observer, progressAt(first), progressAt(last));
    SubProgress binning(&part, 0.0, 0.5);
    SubProgress summing(&part, 0.5, 1.0);
    source.start(chunks, first, last, executor);
    for (std::size_t chunk = first; chunk < last; ++chunk)
    {
      source.add(request, chunks, chunk, executor);
      if (!binning.report(double(chunk + 1 - first) / double(last - first)))
      {
        return Status::Aborted;
      }
    }
    invalid += source.invalid();
    clipped -= source.inside() + source.invalid();
    if (!sumPartitions(stages, task, last - first, runs, executor, &summing))
    {
      return Status::Aborted;
    }
  }
  std::vector<VoxelRun> parts(runs.size());
  forEachItem(executor, runs.size(), [&](std::size_t p) { parts[p] = std::move(runs[p].whole()); });
  if (wanted.writes && !task.writes)
  {
    writeParts(request, parts, executor);
  }
  else
  {
    std::vector<const VoxelRun*> all;
    std::transform(parts.begin(), parts.end(), std::back_inserter(all), [](const VoxelRun& p) { return &p; });
    sums = VoxelRun::concatenated(all);
  }
  return Status::Ok;
}

/// Writes runs whose keys ascend from one to the next to the result, and frees them.
void VoxelResampler::Implementation::writeParts(
  const VoxelRequest& request, std::vector<VoxelRun>& parts, const Executor& executor)
{
  std::vector<std::size_t> firsts = { 0 };
  for (const VoxelRun& part : parts)
  {
    firsts.push_back(firsts.back() + part.size());
  }
  size = std::int64_t(firsts.back());
  writer.prepare(request, firsts.back(), fractionBitsOf(lattice));
  forEachItem(executor, parts.size(),
    [&](std::size_t p)
    {
      writeRun(request, parts[p], 0, parts[p].size(), firsts[p]);
      parts[p] = VoxelRun();
    });
}

/// Makes room for the voxels: for as many as there may be, of which what is not written is never touched, or,
/// where a machine or a limit counts that, too, for as many as there are.
template <typename Voxels>
void VoxelResampler::Implementation::makeOutput(
  Stages<Voxels>& stages, const VoxelRequest& request, const Executor& executor)
{
  std::size_t most = 0;
  for (std::uint32_t p = 0; p < stages.source.partitions(); ++p)
  {
    most += stages.source.mostVoxels(p);
  }
  try
  {
    writer.prepare(request, most, stages.source.fractionBits());
  }
  catch (const std::bad_alloc&)
  {
    writer = VoxelWriter();
    std::atomic<std::size_t> voxels{ 0 };
    forEachItemWith(
      executor, stages.source.partitions(),
      [&](std::size_t thread) -> Voxels& { return stages.workers[thread]->voxels; },
      [&](std::size_t p, Voxels& found)
      {
        voxels += found.find(std::uint32_t(p));
        found.drop();
      });
    writer.prepare(request, voxels, stages.source.fractionBits());
  }
}

/// Sums the voxels of a partition, and makes of them what is asked for.
template <typename Voxels>
void VoxelResampler::Implementation::sumPartition(typename Stages<Voxels>::Worker& worker, const Task& task,
  std::uint32_t partition, PartitionOrder& order, VoxelRuns* runs)
{
  Voxels& voxels = worker.voxels;
  std::optional<VoxelReductions>& reductions = worker.reductions;
  const std::size_t voxelCount = voxels.find(partition);
  const std::size_t offset = order.append(partition, voxelCount);
  voxels.sum();
  if (reductions)
  {
    reductions->reduce(voxels, offset);
  }
  if (task.writes)
  {
    voxels.write(kernelsFor(task.request.instructions), writer, offset);
    reductions ? reductions->write(writer, offset) : void();
  }
  if (!task.writes && voxelCount > 0)
  {
    VoxelRun run = voxels.wide();
    run.tallies = reductions ? reductions->takeTallies() : std::vector<VoxelTally>();
    runs[partition].add(std::move(run));
  }
}

/// The voxels of the points that are held, partition by partition: each thread takes the next one, so that
/// those before any are done or at work. With as many reports as @p rounds. @return false where the observer
/// ended the work.
template <typename Voxels>
bool VoxelResampler::Implementation::sumPartitions(Stages<Voxels>& stages, const Task& task,
  std::size_t rounds, std::vector<VoxelRuns>& runs, const Executor& executor, ProgressObserver* observer)
{
  using Worker = typename Stages<Voxels>::Worker;
  const VoxelRequest& request = task.request;
  stages.prepareWorkers(
    task, request.voxelIndex ? voxelIndex.data() : nullptr, std::max(executor.concurrency(), 1));
  PartitionOrder order;
  const auto sumNext = [&](Worker& worker, std::uint32_t partition)
  {
    try
    {
      this->sumPartition<Voxels>(worker, task, partition, order, runs.data());
    }
    catch (...)
    {
      order.giveUp();
      throw;
    }
  };
  try
  {
    task.writes ? makeOutput(stages, request, executor) : void();
    for (std::size_t round = 0; round < rounds; ++round)
    {
      const std::size_t first = stages.source.partitions() * round / rounds;
      const std::size_t last = stages.source.partitions() * (round + 1) / rounds;
      forEachItemWith(
        executor, last - first, [&](std::size_t thread) -> Worker& { return *stages.workers[thread]; },
        [&](std::size_t p, Worker& worker) { sumNext(worker, std::uint32_t(first + p)); });
      if (observer && !observer->report(double(round + 1) / double(rounds)))
      {
        return false;
      }
    }
  }
  catch (...)
  {
    stages.workers.clear(); // The next run finds nothing half done.
    throw;
  }
  for (const std::unique_ptr<Worker>& worker : stages.workers)
  {
    worker->reductions.reset();
  }
  size = task.writes ? std::int64_t(order.size()) : 0;
  return true;
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
