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
  VoxelRequest request;
  request.points = points;
  request.transform = transform_;
  request.lattice = lattice_;
  request.covariances = covariances_;
  for (std::size_t i = 0; i < arrays.size(); ++i)
  {
    request.attributes.push_back({ arrays[i], arrays_[i].statistic });
  }
  VoxelRun run;
  VoxelResampler::Implementation& engine = *engine_.implementation_;
  const Status status = engine.sum(request, run, executor, observer);
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

Status VoxelAccumulator::merge(const VoxelAccumulator& other)
{
  VoxelAccumulator copy = other.withoutPoints();
  *copy.runs_ = *other.runs_;
  copy.counts_ = other.counts_;
  return this->merge(std::move(copy));
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
  VoxelAccumulator part = this->withoutPoints();
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

/// "PHVoxel5" in the bytes.
constexpr std::uint64_t kMagic = 0x356c65786f564850;

/// Content besides the voxels.
struct Content
{
  std::uint64_t magic = kMagic;
  Lattice lattice;
  std::uint64_t covariances = 0;
  AffineTransform transform;
  PointCounts counts;
  std::vector<AccumulatedArray> arrays = {};
};

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

/// Reads what a Writer wrote; zeros beyond the end.
class Reader
{
public:
  explicit Reader(std::string_view bytes)
    : left_(bytes)
  {
  }
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
    isWhole_ = isWhole_ && count <= left_.size() / sizeof(elements[0]);
    elements.resize(isWhole_ ? count : 0);
    this->copy(elements.data(), elements.size() * sizeof(elements[0]));
  }
  bool isAtEnd() const { return isWhole_ && left_.empty(); }

private:
  void copy(void* to, std::size_t size)
  {
    isWhole_ = isWhole_ && left_.size() >= size;
    std::fill_n(static_cast<char*>(to), isWhole_ ? 0 : size, 0);
    left_.copy(static_cast<char*>(to), isWhole_ ? size : 0);
    left_.remove_prefix(isWhole_ ? size : 0);
  }

  std::string_view left_;
  bool isWhole_ = true;
};

/// Writes a run, or reads one.
template <typename Archive>
void exchange(Archive& archive, Content& content, VoxelRun& run)
{
  archive.one(content.magic);
  archive.one(content.lattice);
  archive.one(content.covariances);
  archive.one(content.transform);
  archive.one(content.counts);
  archive.all(run.voxels);
  archive.all(run.secondMoments);
  archive.all(content.arrays);
  run.tallies.resize(run.size() > 0 ? content.arrays.size() : 0);
  for (std::size_t i = 0; i < run.tallies.size(); ++i)
  {
    VoxelTally& tally = run.tallies[i];
    archive.one(tally.sums.unit);
    archive.one(tally.sums.words);
    archive.all(tally.sums.values);
    archive.all(tally.sums.nonFinite);
    archive.all(tally.values.ends);
    archive.all(tally.values.values);
    const bool isSummed = isSum(content.arrays[i].statistic);
    tally.sums.components = isSummed ? content.arrays[i].components : 0;
    tally.sums.size = run.size() * std::size_t(tally.sums.components);
    tally.values.components = isSummed ? 0 : content.arrays[i].components;
  }
}

/// True if the values of each list have as many points as its voxel.
bool listsAddUp(const VoxelRun& run, const TallyValues& values)
{
  const auto components = std::size_t(values.components);
  for (std::size_t list = 0; list < values.ends.size(); ++list)
  {
    std::int64_t left = run.voxels[list / components].count;
    const TallyValues::List points = values[list];
    for (const TallyValue* value = points.first; value != points.last; ++value)
    {
      if (value->points <= 0 || value->points > left)
      {
        return false;
      }
      left -= value->points;
    }
    if (left != 0)
    {
      return false;
    }
  }
  return true;
}

/// True if a run that was read has the sizes, the order and the counts that its content asks for.
bool isConsistent(const Content& content, const VoxelRun& run)
{
  constexpr int kMostUnit = 1100; // Double numbers are multiples of 2^-1074.
  const auto isNotAbove = [](const WideSums& a, const WideSums& b) { return a.key >= b.key; };
  const auto isCount = [](std::int64_t n) { return n >= 0 && n <= VoxelAccumulator::kMostPoints; };
  const auto areCounts = [&](const NonFiniteCount& n)
  { return isCount(n.nans) && isCount(n.plus) && isCount(n.minus); };
  const PointCounts& counts = content.counts;
  bool result = isCount(counts.points) && isCount(counts.clipped) && isCount(counts.invalid) &&
    run.secondMoments.size() == (content.covariances == 1 ? run.size() : 0) &&
    std::adjacent_find(run.voxels.begin(), run.voxels.end(), isNotAbove) == run.voxels.end();
  std::int64_t left = result ? counts.points - counts.clipped - counts.invalid : 0;
  for (const WideSums& voxel : run.voxels)
  {
    result = result && voxel.count > 0 && voxel.count <= left;
    left -= result ? voxel.count : 0;
  }
  result = result && left == 0;
  for (const VoxelTally& tally : run.tallies)
  {
    const TallySums& sums = tally.sums;
    const auto& ends = tally.values.ends;
    const auto words = std::size_t(std::max(sums.words, 1));
    result = result && sums.components + tally.values.components > 0 && sums.unit >= -kMostUnit &&
      sums.unit <= kMostUnit && (sums.words > 0 || sums.size == 0) && sums.values.size() % words == 0 &&
      sums.values.size() / words == sums.size &&
      (sums.nonFinite.empty() || sums.nonFinite.size() == sums.size) &&
      std::all_of(sums.nonFinite.begin(), sums.nonFinite.end(), areCounts) &&
      ends.size() == run.size() * std::size_t(tally.values.components) &&
      std::is_sorted(ends.begin(), ends.end()) &&
      (ends.empty() ? 0 : ends.back()) == tally.values.values.size() && listsAddUp(run, tally.values);
  }
  return result;
}

}

std::string VoxelAccumulator::serialize(std::uint64_t first, std::uint64_t end)
{
  const VoxelAccumulator part = this->part(first, end);
  VoxelRun& run = part.runs_->whole();
  Content content{ kMagic, lattice_, covariances_, transform_, part.counts_, arrays_ };
  Writer writer;
  exchange(writer, content, run);
  writer.one(checksum(writer.bytes));
  return std::move(writer.bytes);
}

Status VoxelAccumulator::deserialize(std::string_view bytes, VoxelAccumulator& result)
{
  std::uint64_t sum = 0;
  const std::size_t size = bytes.size() - std::min(bytes.size(), sizeof sum);
  bytes.copy(reinterpret_cast<char*>(&sum), sizeof sum, size);
  Content content;
  VoxelRun run;
  Reader reader(bytes.substr(0, size));
  if (sum != checksum(bytes.substr(0, size)))
  {
    return Status::InvalidParameter;
  }
  exchange(reader, content, run);
  if (content.magic != kMagic || !reader.isAtEnd() || !isConsistent(content, run))
  {
    return Status::InvalidParameter;
  }
  VoxelAccumulator read(
    content.lattice, content.covariances == 1, std::move(content.arrays), content.transform);
  read.counts_ = content.counts;
  read.runs_->add(std::move(run));
  result = std::move(read);
  return Status::Ok;
}

} // namespace pointhaptics
