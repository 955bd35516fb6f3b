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

static_assert(kChunkPoints <= kPointsPerReport, "progress is reported after each chunk");

AttributeView viewOf(const PointView& points)
{
  const bool single = points.floats() != nullptr;
  return { single ? static_cast<const void*>(points.floats()) : points.doubles(),
    single ? ScalarType::Float : ScalarType::Double, 3, points.size(),
    points.stride() * (single ? std::int64_t(sizeof(float)) : std::int64_t(sizeof(double))) };
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
  Task task = { request, true };
  task.request.keys = request.keys || choosesPoints(request);
  VoxelRun sums;
  Status status = sumPoints(task, sums, executor, observer);
  if (status == Status::Ok && !task.writes)
  {
    status = writeRun(task.request, sums, executor, nullptr);
  }
  if (status != Status::Ok)
  {
    clear();
  }
  else if (keepsPoints(request.representative))
  {
    chosenPoints.assign(writer_.chosen(), writer_.chosen() + size);
  }
  publish();
  return status;
}

Status VoxelResampler::Implementation::finish(
  const VoxelRequest& request, const VoxelRun& sums, const Executor& executor, ProgressObserver* observer)
{
  clear();
  const Status status = check(request);
  lattice = request.lattice;
  const Status ended = status == Status::Ok ? writeRun(request, sums, executor, observer) : status;
  publish();
  return ended;
}

/// Tells where the arrays are.
void VoxelResampler::Implementation::publish()
{
  floats = writer_.floats();
  doubles = writer_.doubles();
  counts = writer_.counts();
  keys = writer_.keys();
  covariances = writer_.covariances();
  attributes.clear();
  for (std::size_t i = 0; i < writer_.attributes(); ++i)
  {
    attributes.push_back(writer_.attribute(i, 0));
  }
}

void VoxelResampler::Implementation::clear()
{
  size = 0;
  clipped = invalid = 0;
  chosenPoints.clear();
  voxelIndex.clear();
}

/// Makes the result that sums give.
Status VoxelResampler::Implementation::writeRun(
  const VoxelRequest& request, const VoxelRun& run, const Executor& executor, ProgressObserver* observer)
{
  writer_.prepare(request, run.size(), fractionBitsOf(lattice));
  const std::array<Vec3, 3> columns = normalColumns(request.transform);
  PointProgress progress(observer, std::int64_t(run.size()), 1);
  const bool isDone = forReportedSlices(std::int64_t(run.size()), progress,
    [&](std::int64_t first, std::int64_t last)
    {
      forRange(executor, last - first,
        [&](std::int64_t begin, std::int64_t end)
        {
          const auto from = std::size_t(first + begin);
          const auto to = std::size_t(first + end);
          writer_.write(from, run, from, to);
          for (std::size_t i = 0; i < run.tallies.size(); ++i)
          {
            const AttributeRequest& array = request.attributes[i];
            run.tallies[i].write({ array.view.type, array.view.components, array.statistic }, from, to,
              writer_.counts() + from, columns, writer_.attribute(i, from));
          }
        });
    });
  size = isDone ? std::int64_t(run.size()) : 0;
  return isDone ? Status::Ok : (clear(), Status::Aborted);
}

void VoxelResampler::Implementation::prepareWorkers(
  const Task& task, const Chunks& chunks, const Executor& executor)
{
  const VoxelRequest& request = task.request;
  workers_.resize(std::max<std::size_t>({ workers_.size(), std::size_t(executor.concurrency()), 1 }));
  for (std::unique_ptr<Worker>& worker : workers_)
  {
    worker = worker ? std::move(worker) : std::make_unique<Worker>();
    worker->voxels.prepare(request, chunks, binner_);
    worker->reductions.reset();
    if (choosesPoints(request) || !request.attributes.empty())
    {
      worker->reductions.emplace(request, task.arrays, binner_.payloadLayout(), binner_.plan().fractionBits,
        request.voxelIndex ? voxelIndex.data() : nullptr);
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
    places_.reserve(std::size_t(3 * points.size()) * sizeof(Real));
    Real* const to = reinterpret_cast<Real*>(places_.data());
    forEachIndex(executor, points.size(),
      [&](std::int64_t i)
      {
        const Vec3 place = request.transform.apply(points[i]);
        std::transform(&place.x, &place.x + 3, to + 3 * i, [](double x) { return Real(x); });
      });
    return viewOf(PointView(to, points.size()));
  };
  return request.singlePrecision ? move(float()) : move(double());
}

Status VoxelResampler::Implementation::sumPoints(
  Task& task, VoxelRun& sums, const Executor& executor, ProgressObserver* observer)
{
  clear();
  VoxelRequest& request = task.request;
  const Status status = check(request);
  if (status != Status::Ok)
  {
    return status;
  }
  for (AttributeRequest array : request.attributes)
  {
    if (isSum(array.statistic) && !array.range)
    {
      array.range = rangeOf(array.view, executor);
    }
    task.arrays.push_back(array);
  }
  if (request.representative == Representative::Median)
  {
    task.arrays.push_back({ placesOf(request, executor), AttributeStatistic::Median });
  }
  voxelIndex.assign(request.voxelIndex ? std::size_t(request.points.size()) : 0, -1);
  lattice = request.lattice;
  // Other sets divide by way of the reciprocal.
  request.instructions = hasOrdinarySpacing(lattice) ? request.instructions : InstructionSet::Baseline;
  std::vector<VoxelRuns> parts;
  const Status ended = runStages(task, parts, executor, observer);
  if (ended != Status::Ok)
  {
    return ended;
  }
  std::size_t room = 0;
  for (VoxelRuns& part : parts)
  {
    room += part.whole().size();
  }
  sums.voxels.reserve(room);
  sums.secondMoments.reserve(request.covariances ? room : 0);
  for (VoxelRuns& part : parts)
  {
    sums.append(part.whole(), 0, part.whole().size());
    part = VoxelRuns();
  }
  return Status::Ok;
}

/// The stages: quantize and bin; sum; write, or keep the sums of each partition, merged.
Status VoxelResampler::Implementation::runStages(
  Task& task, std::vector<VoxelRuns>& parts, const Executor& executor, ProgressObserver* observer)
{
  const VoxelRequest& request = task.request;
  const Chunks chunks(request, executor);
  // Where points are chosen, all of a voxel must be there at once.
  const std::size_t held = choosesPoints(request) ? chunks.count() : kHeldChunks;
  task.writes = task.writes && chunks.count() <= held; // The sums of more are merged.
  std::vector<AttributeView> views;
  for (const AttributeRequest& array : task.arrays)
  {
    views.push_back(array.view);
  }
  binner_.prepare(request, chunks, views, request.voxelIndex || keepsPoints(request.representative));
  prepareWorkers(task, chunks, executor);
  invalid = request.index ? request.points.size() - finitePoints(*request.index) : 0;
  clipped = request.points.size() - invalid;
  parts.resize(task.writes ? 0 : binner_.plan().partitions);
  for (std::size_t first = 0; first < chunks.count(); first += held)
  {
    const std::size_t last = std::min(first + held, chunks.count());
    const auto progressAt = [&](std::size_t chunk) { return double(chunk) / double(chunks.count()); };
    SubProgress part(observer, progressAt(first), progressAt(last));
    SubProgress binning(&part, 0.0, 0.5);
    SubProgress summing(&part, 0.5, 1.0);
    binner_.start(chunks, first, last, executor);
    for (std::size_t chunk = first; chunk < last; ++chunk)
    {
      binner_.add(request, chunks, chunk, executor);
      if (!binning.report(double(chunk + 1 - first) / double(last - first)))
      {
        return Status::Aborted;
      }
    }
    const std::int64_t notFinite = binner_.total(&PointRecordWriter::invalid);
    invalid += notFinite;
    clipped -= binner_.total(&PointRecordWriter::inside) + notFinite;
    if (!sumPartitions(task, last - first, parts, executor, &summing))
    {
      return Status::Aborted;
    }
  }
  std::for_each(workers_.begin(), workers_.end(), [](const auto& worker) { worker->reductions.reset(); });
  forEachItem(executor, parts.size(), [&](std::size_t p) { static_cast<void>(parts[p].whole()); });
  return Status::Ok;
}

/// Makes room for the voxels: for as many as there may be, of which what is not written is never touched, or,
/// where a machine or a limit counts that, too, for as many as there are.
void VoxelResampler::Implementation::makeOutput(const VoxelRequest& request, const Executor& executor)
{
  std::size_t most = 0;
  for (std::uint32_t p = 0; p < binner_.plan().partitions; ++p)
  {
    most += std::min(binner_.count(p), binner_.plan().cells());
  }
  try
  {
    writer_.prepare(request, most, binner_.plan().fractionBits);
  }
  catch (const std::bad_alloc&)
  {
    writer_ = VoxelWriter();
    std::atomic<std::size_t> voxels{ 0 };
    forEachItemWith(
      executor, binner_.plan().partitions, [&](std::size_t thread) -> Worker& { return *workers_[thread]; },
      [&](std::size_t p, Worker& worker) { voxels += worker.voxels.find(std::uint32_t(p)); });
    writer_.prepare(request, voxels, binner_.plan().fractionBits);
  }
}

/// Sums the voxels of a partition, and makes of them what is asked for.
void VoxelResampler::Implementation::sumPartition(
  Worker& worker, const Task& task, std::uint32_t partition, PartitionOrder& order, VoxelRuns* runs)
{
  BinnedVoxels& voxels = worker.voxels;
  std::optional<VoxelReductions>& reductions = worker.reductions;
  const std::size_t offset = order.append(partition, voxels.find(partition));
  voxels.sum();
  if (reductions)
  {
    reductions->reduce(voxels, offset);
  }
  if (task.writes)
  {
    voxels.write(kernelsFor(task.request.instructions), writer_, offset);
    reductions ? reductions->write(writer_, offset) : void();
  }
  else if (voxels.size() > 0)
  {
    VoxelRun run = voxels.wide();
    run.tallies = reductions ? reductions->takeTallies() : std::vector<VoxelTally>();
    runs[partition].add(std::move(run));
  }
}

/// The voxels of the points that are held, partition by partition: each thread takes the next one, so that
/// those before any are done or at work. With as many reports as @p rounds. @return false where the observer
/// ended the work.
bool VoxelResampler::Implementation::sumPartitions(const Task& task, std::size_t rounds,
  std::vector<VoxelRuns>& runs, const Executor& executor, ProgressObserver* observer)
{
  PartitionOrder order;
  const auto sumNext = [&](Worker& worker, std::uint32_t partition)
  {
    try
    {
      this->sumPartition(worker, task, partition, order, runs.data());
    }
    catch (...)
    {
      order.giveUp();
      throw;
    }
  };
  try
  {
    task.writes ? makeOutput(task.request, executor) : void();
    for (std::size_t round = 0; round < rounds; ++round)
    {
      const std::size_t first = binner_.plan().partitions * round / rounds;
      const std::size_t last = binner_.plan().partitions * (round + 1) / rounds;
      forEachItemWith(
        executor, last - first, [&](std::size_t thread) -> Worker& { return *workers_[thread]; },
        [&](std::size_t p, Worker& worker) { sumNext(worker, std::uint32_t(first + p)); });
      if (observer && !observer->report(double(round + 1) / double(rounds)))
      {
        return false;
      }
    }
  }
  catch (...)
  {
    workers_.clear(); // The next run finds nothing half done.
    throw;
  }
  size = task.writes ? std::int64_t(order.size()) : 0;
  return true;
}

VoxelResampler::VoxelResampler()
  : implementation_(std::make_unique<Implementation>())
  , results_(implementation_.get())
{
}

VoxelResampler::~VoxelResampler() = default;
VoxelResampler::VoxelResampler(VoxelResampler&&) noexcept = default;
VoxelResampler& VoxelResampler::operator=(VoxelResampler&&) noexcept = default;

Status VoxelResampler::run(const VoxelRequest& request, const Executor& executor, ProgressObserver* observer)
{
  return implementation_->run(request, executor, observer);
}

void VoxelResampler::releaseScratch()
{
  implementation_ = std::make_unique<Implementation>();
  results_ = implementation_.get();
}

} // namespace pointhaptics
