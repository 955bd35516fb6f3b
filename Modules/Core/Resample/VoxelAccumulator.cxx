#include "Core/Resample/VoxelAccumulator.h"

#include "Core/Resample/VoxelResamplerImplementation.h"

#include <algorithm>
#include <numeric>
#include <type_traits>
#include <utility>

namespace pointhaptics
{

using namespace simd;

namespace
{

void addTo(PointCounts& counts, const PointCounts& more)
{
  counts = { counts.points + more.points, counts.clipped + more.clipped, counts.invalid + more.invalid };
}

bool sameLattice(const Lattice& a, const Lattice& b)
{
  return a.origin == b.origin && a.spacing == b.spacing && a.dimensions == b.dimensions && a.end == b.end;
}

}

VoxelAccumulator::VoxelAccumulator(
  const Lattice& lattice, bool covariances, std::vector<Array> arrays, const AffineTransform& transform)
  : runs_(std::make_unique<VoxelRuns>())
  , lattice_(lattice)
  , covariances_(covariances)
  , arrays_(std::move(arrays))
  , transform_(transform)
{
}

VoxelAccumulator::~VoxelAccumulator() = default;
VoxelAccumulator::VoxelAccumulator(VoxelAccumulator&&) noexcept = default;
VoxelAccumulator& VoxelAccumulator::operator=(VoxelAccumulator&&) noexcept = default;

Status VoxelAccumulator::add(const PointView& points, const std::vector<AttributeView>& arrays,
  const Executor& executor, ProgressObserver* observer)
{
  const auto fits = [&](const Array& array, const AttributeView& view)
  { return view.type == array.type && view.components == array.components; };
  if (points.size() > kMostPoints - counts_.points ||
    !std::equal(arrays_.begin(), arrays_.end(), arrays.begin(), arrays.end(), fits))
  {
    return Status::InvalidParameter;
  }
  VoxelResampler::Implementation::Task task = { {}, false };
  task.request.points = points;
  task.request.transform = transform_;
  task.request.lattice = lattice_;
  task.request.covariances = covariances_;
  for (std::size_t i = 0; i < arrays.size(); ++i)
  {
    task.request.attributes.push_back({ arrays[i], arrays_[i].statistic });
  }
  VoxelRun run;
  VoxelResampler::Implementation& engine = *engine_.implementation_;
  const Status status = engine.sumPoints(task, run, executor, observer);
  if (status != Status::Ok)
  {
    return status;
  }
  runs_->add(std::move(run)); // First: it may throw.
  addTo(counts_, { points.size(), engine.clipped, engine.invalid });
  return Status::Ok;
}

Status VoxelAccumulator::merge(VoxelAccumulator&& other)
{
  if (!sameLattice(lattice_, other.lattice_) || covariances_ != other.covariances_ ||
    !(arrays_ == other.arrays_) || !(transform_ == other.transform_) ||
    other.points() > kMostPoints - this->points())
  {
    return Status::InvalidParameter;
  }
  runs_->add(std::move(other.runs_->whole()));
  addTo(counts_, other.counts_);
  *other.runs_ = {};
  other.counts_ = {};
  other.releaseScratch();
  return Status::Ok;
}

Status VoxelAccumulator::finish(
  VoxelRequest request, VoxelResampler& result, const Executor& executor, ProgressObserver* observer)
{
  request.lattice = lattice_;
  request.covariances = covariances_;
  request.transform = transform_;
  request.attributes.clear();
  for (const Array& array : arrays_)
  {
    request.attributes.push_back({ { nullptr, array.type, array.components }, array.statistic });
  }
  VoxelResampler::Implementation& engine = *result.implementation_;
  const Status status = engine.finish(request, runs_->whole(), executor, observer);
  if (status == Status::Ok)
  {
    engine.clipped = counts_.clipped;
    engine.invalid = counts_.invalid;
  }
  return status;
}

VoxelAccumulator VoxelAccumulator::part(std::uint64_t first, std::uint64_t end)
{
  VoxelAccumulator part(lattice_, covariances_, arrays_, transform_);
  const VoxelRun& all = runs_->whole();
  PointCounts& counts = part.counts_;
  if (first == 0 && end > 0)
  {
    counts = counts_;
    counts.points = counts.clipped + counts.invalid;
  }
  VoxelRun run;
  run.append(all, all.find(first), std::max(all.find(first), all.find(end)));
  counts.points = std::accumulate(run.voxels.begin(), run.voxels.end(), counts.points,
    [](std::int64_t sum, const WideSums& voxel) { return sum + voxel.count; });
  part.runs_->add(std::move(run));
  return part;
}

std::vector<std::uint64_t> VoxelAccumulator::keys()
{
  const VoxelRun& run = runs_->whole();
  std::vector<std::uint64_t> keys(run.size());
  std::transform(run.voxels.begin(), run.voxels.end(), keys.begin(), [](const WideSums& v) { return v.key; });
  return keys;
}

namespace
{

/// "PHVoxel6", the first of the bytes.
constexpr std::uint64_t kMagic = 0x366c65786f564850;

/// Bytes that changed on their way have another sum.
std::uint64_t checksum(std::string_view bytes)
{
  std::uint64_t sum = bytes.size();
  for (std::size_t i = 0; i < bytes.size(); i += sizeof sum)
  {
    std::uint64_t word = 0;
    bytes.copy(reinterpret_cast<char*>(&word), sizeof word, i);
    sum = (sum ^ word) * 0x9e3779b97f4a7c15;
    sum ^= sum >> 32;
  }
  return sum;
}

/// Writes things as they lie in memory. What is written where numbers lie the other way round has another
/// magic.
class Writer
{
public:
  std::string bytes;

  template <typename T>
  void one(const T& thing)
  {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes.append(reinterpret_cast<const char*>(&thing), sizeof thing);
  }
  /// All elements, after their number.
  template <typename Vector>
  void all(const Vector& elements)
  {
    this->one(std::uint64_t(elements.size()));
    bytes.append(reinterpret_cast<const char*>(elements.data()), elements.size() * sizeof(elements[0]));
  }
};

/// Reads what a Writer wrote; zeros and no elements beyond the end.
class Reader
{
public:
  std::string_view left;
  bool isWhole = true;

  template <typename T>
  void one(T& thing)
  {
    this->copy(&thing, sizeof thing);
  }
  template <typename Vector>
  void all(Vector& elements)
  {
    std::uint64_t count = 0;
    this->one(count);
    isWhole = isWhole && count <= left.size() / sizeof(elements[0]);
    elements.resize(isWhole ? count : 0);
    this->copy(elements.data(), elements.size() * sizeof(elements[0]));
  }

private:
  void copy(void* to, std::size_t size)
  {
    isWhole = isWhole && size <= left.size();
    std::fill_n(static_cast<char*>(to), isWhole ? 0 : size, '\0');
    left.copy(static_cast<char*>(to), isWhole ? size : 0);
    left.remove_prefix(isWhole ? size : 0);
  }
};

}

/// Writes all, or reads it into an object without points.
template <typename Archive>
void VoxelAccumulator::exchange(Archive& archive)
{
  VoxelRun& run = runs_->whole();
  archive.one(lattice_);
  archive.one(covariances_);
  archive.one(transform_);
  archive.one(counts_);
  archive.all(run.voxels);
  archive.all(run.secondMoments);
  archive.all(arrays_);
  run.tallies.resize(run.size() > 0 ? arrays_.size() : 0);
  for (std::size_t i = 0; i < run.tallies.size(); ++i)
  {
    VoxelTally& tally = run.tallies[i];
    archive.one(tally.sums.unit);
    archive.one(tally.sums.words);
    archive.all(tally.sums.values);
    archive.all(tally.sums.nonFinite);
    archive.all(tally.values.ends);
    archive.all(tally.values.values);
    const bool isSummed = isSum(arrays_[i].statistic);
    tally.sums.components = isSummed ? arrays_[i].components : 0;
    tally.sums.size = run.size() * std::size_t(tally.sums.components);
    tally.values.components = isSummed ? 0 : arrays_[i].components;
  }
}

std::string VoxelAccumulator::serialize(std::uint64_t first, std::uint64_t end)
{
  VoxelAccumulator part = this->part(first, end);
  Writer writer;
  writer.one(kMagic);
  part.exchange(writer);
  writer.one(checksum(writer.bytes));
  return std::move(writer.bytes);
}

Status VoxelAccumulator::deserialize(std::string_view bytes, VoxelAccumulator& result)
{
  std::uint64_t ends[2] = { 0, 0 };
  const std::size_t size = bytes.size() - std::min(bytes.size(), sizeof ends[1]);
  bytes.copy(reinterpret_cast<char*>(&ends[0]), sizeof ends[0]);
  bytes.copy(reinterpret_cast<char*>(&ends[1]), sizeof ends[1], size);
  if (ends[0] != kMagic || ends[1] != checksum(bytes.substr(0, size)))
  {
    return Status::InvalidParameter;
  }
  VoxelAccumulator read{ Lattice() };
  Reader reader{ bytes.substr(sizeof kMagic, size - sizeof kMagic) };
  read.exchange(reader);
  if (!reader.isWhole || !reader.left.empty())
  {
    return Status::InvalidParameter;
  }
  result = std::move(read);
  return Status::Ok;
}

} // namespace pointhaptics
