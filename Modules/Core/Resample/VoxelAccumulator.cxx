#include "Core/Resample/VoxelAccumulator.h"

#include "Core/Resample/VoxelResamplerImplementation.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <type_traits>
#include <utility>

namespace pointhaptics
{

using namespace simd;

namespace
{

/// Points: all, and of these the ones that are in no voxel.
struct PointCounts
{
  std::int64_t points = 0;
  std::int64_t clipped = 0;
  std::int64_t invalid = 0;

  void add(const PointCounts& more, int sign = 1)
  {
    points += sign * more.points;
    clipped += sign * more.clipped;
    invalid += sign * more.invalid;
  }
};

bool sameTransform(const AffineTransform& a, const AffineTransform& b)
{
  return std::equal(&a.m[0][0], &a.m[0][0] + 12, &b.m[0][0]);
}

bool sameTransforms(const std::optional<AffineTransform>& a, const std::optional<AffineTransform>& b)
{
  return a && b ? sameTransform(*a, *b) : a.has_value() == b.has_value();
}

/// Vectors turned as normals are, each as long as before.
std::vector<double> turnedVectors(
  const AttributeView& vectors, std::int64_t count, const AffineTransform& transform)
{
  std::vector<double> turned;
  turned.reserve(std::size_t(3 * count));
  withType(vectors.type,
    [&](auto example)
    {
      for (std::int64_t i = 0; i < count; ++i)
      {
        decltype(example) tuple[3];
        std::memcpy(tuple, vectors.tuple(i), sizeof tuple);
        const Vec3 vector = { double(tuple[0]), double(tuple[1]), double(tuple[2]) };
        const Vec3 same = transform.applyToNormal(vector);
        const Vec3 v = norm(vector) * normalized(same, same);
        turned.insert(turned.end(), { v.x, v.y, v.z });
      }
    });
  return turned;
}

bool sameLattice(const Lattice& a, const Lattice& b)
{
  return a.origin == b.origin && a.spacing == b.spacing && a.dimensions == b.dimensions && a.end == b.end;
}

}

/// Sums of the points of some calls.
class VoxelAccumulator::Sums
{
public:
  simd::VoxelRuns runs;
  PointCounts counts;
};

VoxelAccumulator::VoxelAccumulator(const Lattice& lattice, bool covariances, std::vector<Array> arrays,
  std::optional<AffineTransform> commonTransform)
  : added_(std::make_unique<Sums>())
  , subtracted_(std::make_unique<Sums>())
  , lattice_(lattice)
  , covariances_(covariances)
  , arrays_(std::move(arrays))
  , common_(commonTransform)
{
}

VoxelAccumulator::~VoxelAccumulator() = default;
VoxelAccumulator::VoxelAccumulator(VoxelAccumulator&&) noexcept = default;
VoxelAccumulator& VoxelAccumulator::operator=(VoxelAccumulator&&) noexcept = default;

std::int64_t VoxelAccumulator::points() const
{
  return added_->counts.points - subtracted_->counts.points;
}

std::int64_t VoxelAccumulator::clippedPoints() const
{
  return added_->counts.clipped - subtracted_->counts.clipped;
}

std::int64_t VoxelAccumulator::invalidPoints() const
{
  return added_->counts.invalid - subtracted_->counts.invalid;
}

Status VoxelAccumulator::change(Sums& sums, const PointView& points, const std::vector<AttributeView>& arrays,
  const AffineTransform& transform, const Executor& executor, ProgressObserver* observer)
{
  const auto fits = [&](const Array& array, const AttributeView& view)
  {
    return view.type == array.type && view.components == array.components && view.tuples >= points.size() &&
      (array.statistic != AttributeStatistic::Normal || array.components == 3);
  };
  if (points.size() > kMostPoints - sums.counts.points || (common_ && !sameTransform(*common_, transform)) ||
    !std::equal(arrays_.begin(), arrays_.end(), arrays.begin(), arrays.end(), fits))
  {
    return Status::InvalidParameter;
  }
  VoxelRequest request;
  request.points = points;
  request.transform = transform;
  request.lattice = lattice_;
  request.covariances = covariances_;
  request.chunkPoints = chunkPoints_;
  std::vector<std::vector<double>> turned;
  for (std::size_t i = 0; i < arrays.size(); ++i)
  {
    AttributeView view = arrays[i];
    if (arrays_[i].statistic == AttributeStatistic::Normal && !common_ && !transform.isIdentity())
    {
      turned.push_back(turnedVectors(view, points.size(), transform));
      view = { turned.back().data(), ScalarType::Double, 3, points.size() };
    }
    request.attributes.push_back({ view, arrays_[i].statistic });
  }
  VoxelRun run;
  VoxelResampler::Implementation& engine = *engine_.implementation_;
  const Status status = engine.sum(request, run, executor, observer);
  if (status != Status::Ok)
  {
    return status;
  }
  sums.runs.add(std::move(run)); // First: it may throw.
  sums.counts.add({ points.size(), engine.clipped, engine.invalid });
  return Status::Ok;
}

Status VoxelAccumulator::merge(VoxelAccumulator&& other)
{
  const auto fits = [](const Sums& a, const Sums& b)
  { return b.counts.points <= kMostPoints - a.counts.points; };
  if (!sameLattice(lattice_, other.lattice_) || covariances_ != other.covariances_ ||
    !(arrays_ == other.arrays_) || !sameTransforms(common_, other.common_) || !fits(*added_, *other.added_) ||
    !fits(*subtracted_, *other.subtracted_))
  {
    return Status::InvalidParameter;
  }
  const auto mergeSums = [](Sums& to, Sums& from)
  {
    to.runs.add(std::move(from.runs.whole()));
    to.counts.add(from.counts);
    from = {};
  };
  mergeSums(*added_, *other.added_);
  mergeSums(*subtracted_, *other.subtracted_);
  other.releaseScratch();
  return Status::Ok;
}

Status VoxelAccumulator::merge(const VoxelAccumulator& other)
{
  VoxelAccumulator copy = other.withoutPoints();
  *copy.added_ = *other.added_;
  *copy.subtracted_ = *other.subtracted_;
  return this->merge(std::move(copy));
}

/// Takes what was subtracted out of what was added. @return false where that is not possible.
bool VoxelAccumulator::settle()
{
  if (subtracted_->counts.points == 0)
  {
    return true;
  }
  bool isRight = this->clippedPoints() >= 0 && this->invalidPoints() >= 0;
  VoxelRun difference = merged(added_->runs.whole(), subtracted_->runs.whole(), -1, isRight);
  if (!isRight)
  {
    return false;
  }
  VoxelRuns left;
  left.add(std::move(difference));
  added_->runs = std::move(left);
  added_->counts.add(subtracted_->counts, -1);
  *subtracted_ = {};
  return true;
}

Status VoxelAccumulator::finish(
  const Request& wanted, VoxelResampler& result, const Executor& executor, ProgressObserver* observer)
{
  if (!this->settle())
  {
    return Status::InvalidParameter;
  }
  VoxelRequest request;
  request.lattice = lattice_;
  request.covariances = covariances_;
  request.singlePrecision = wanted.singlePrecision;
  request.keys = wanted.keys;
  request.instructions = wanted.instructions;
  request.allocator = wanted.allocator;
  request.transform = common_.value_or(AffineTransform());
  for (const Array& array : arrays_)
  {
    request.attributes.push_back({ { nullptr, array.type, array.components }, array.statistic });
  }
  VoxelResampler::Implementation& engine = *result.implementation_;
  const Status status = engine.finish(request, added_->runs.whole(), executor, observer);
  if (status == Status::Ok)
  {
    engine.clipped = added_->counts.clipped;
    engine.invalid = added_->counts.invalid;
  }
  return status;
}

VoxelAccumulator VoxelAccumulator::part(std::uint64_t first, std::uint64_t end)
{
  VoxelAccumulator part = this->withoutPoints();
  if (!this->settle())
  {
    return part;
  }
  const VoxelRun& all = added_->runs.whole();
  PointCounts& counts = part.added_->counts;
  if (first == 0 && end > 0)
  {
    counts = added_->counts;
    counts.points = counts.clipped + counts.invalid;
  }
  VoxelRun run;
  run.append(all, all.find(first), std::max(all.find(first), all.find(end)));
  counts.points = std::accumulate(run.voxels.begin(), run.voxels.end(), counts.points,
    [](std::int64_t sum, const WideSums& voxel) { return sum + voxel.count; });
  part.added_->runs.add(std::move(run));
  return part;
}

std::vector<std::uint64_t> VoxelAccumulator::keys(std::int64_t step)
{
  std::vector<std::uint64_t> keys;
  if (this->settle())
  {
    const VoxelRun& run = added_->runs.whole();
    keys.reserve(run.size() / std::size_t(step) + 1);
    for (std::size_t v = 0; v < run.size(); v += std::size_t(step))
    {
      keys.push_back(run.voxels[v].key);
    }
  }
  return keys;
}

namespace
{

/// "PHVoxel4" in the bytes.
constexpr std::uint64_t kMagic = 0x346c65786f564850;

struct Header
{
  std::uint64_t magic;
  Lattice lattice;
  std::uint64_t covariances;
  std::int64_t fractionBits;
  PointCounts counts;
};

/// Content besides the voxels.
struct Content
{
  Header header;
  std::vector<AccumulatedArray> arrays;
  std::vector<AffineTransform> common; ///< One or none.
};

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
  static constexpr bool isWhole() { return true; }
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
  bool isWhole() const { return isWhole_; }
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
  archive.one(content.header);
  archive.all(run.voxels);
  archive.all(run.secondMoments);
  archive.all(content.arrays);
  archive.all(content.common);
  for (std::size_t i = 0; run.size() > 0 && archive.isWhole() && i < content.arrays.size(); ++i)
  {
    run.tallies.resize(std::max(run.tallies.size(), i + 1));
    TallySums& sums = run.tallies[i].sums;
    archive.one(sums.components);
    archive.one(sums.unit);
    archive.one(sums.words);
    archive.all(sums.values);
    archive.all(sums.nonFinite);
    TallyValues& values = run.tallies[i].values;
    archive.one(values.components);
    archive.all(values.ends);
    archive.all(values.values);
  }
}

bool isCount(std::int64_t n)
{
  return n >= 0 && n <= VoxelAccumulator::kMostPoints;
}

bool isRight(const Header& header)
{
  const Lattice& lattice = header.lattice;
  return header.magic == kMagic && header.covariances <= 1 && isCount(header.counts.points) &&
    isCount(header.counts.clipped) && isCount(header.counts.invalid) && lattice.check() == Status::Ok &&
    !std::isnan(lattice.end.x) && !std::isnan(lattice.end.y) && !std::isnan(lattice.end.z);
}

/// @return false where a mean would not lie in its voxel.
bool liesInVoxel(const WideSums& voxel, std::int64_t fractionBits)
{
  const auto lies = [&](int axis) { return voxel.sum(axis) < Int128(voxel.count) << fractionBits; };
  return isCount(voxel.count) && voxel.count > 0 && lies(0) && lies(1) && lies(2);
}

/// @return false for voxels that the points of the header do not make. @pre the header is right.
bool areOf(const Header& header, const VoxelRun& run)
{
  const std::uint64_t keys = header.lattice.key(0, 0, header.lattice.dimensions[2]);
  std::int64_t points = header.counts.clipped + header.counts.invalid;
  for (std::size_t v = 0; v < run.size(); ++v)
  {
    const WideSums& voxel = run.voxels[v];
    if (!liesInVoxel(voxel, header.fractionBits) || voxel.high >> 3 * WideSums::kHighBits != 0 ||
      voxel.key >= keys || (v > 0 && voxel.key <= run.voxels[v - 1].key) ||
      voxel.count > header.counts.points - points)
    {
      return false;
    }
    points += voxel.count;
  }
  return points == header.counts.points &&
    run.secondMoments.size() == (header.covariances == 1 ? run.size() : 0);
}

/// @return false for an array that there is not.
bool isRight(const AccumulatedArray& array)
{
  constexpr int kMostComponents = 1 << 20;
  return array.type >= ScalarType::Int8 && array.type <= ScalarType::Double && array.components > 0 &&
    array.components <= kMostComponents && array.statistic >= AttributeStatistic::Mean &&
    array.statistic <= AttributeStatistic::Median &&
    (array.statistic != AttributeStatistic::Normal || array.components == 3);
}

/// Has what was read of a tally say where it lies. @return false for what an array does not have in the
/// voxels.
bool completeTally(const AccumulatedArray& kind, const VoxelRun& run, VoxelTally& tally)
{
  TallySums& sums = tally.sums;
  TallyValues& values = tally.values;
  sums.size = run.size() * std::size_t(sums.components);
  const std::size_t lists = run.size() * std::size_t(values.components);
  const bool isSummed = isSum(kind.statistic);
  if (sums.components != (isSummed ? kind.components : 0) || sums.words < 1 ||
    sums.words > TallySums::kMostWords || sums.unit < TallySums::kLeastUnit ||
    sums.unit > -TallySums::kLeastUnit || sums.values.size() != sums.size * std::size_t(sums.words) ||
    (!sums.nonFinite.empty() && sums.nonFinite.size() != sums.size) ||
    values.components != (isSummed ? 0 : kind.components) || values.ends.size() != lists ||
    values.values.size() != (lists > 0 ? values.ends.back() : 0))
  {
    return false;
  }
  bool isRight = std::is_sorted(values.ends.begin(), values.ends.end());
  for (std::size_t v = 0; isRight && v < run.size(); ++v)
  {
    isRight = tally.isOf(kind, v, run.voxels[v].count);
  }
  return isRight;
}

}

std::string VoxelAccumulator::serialize(std::uint64_t first, std::uint64_t end)
{
  if (!this->settle())
  {
    return {};
  }
  const VoxelAccumulator part = this->part(first, end);
  VoxelRun& run = part.added_->runs.whole();
  std::for_each(run.tallies.begin(), run.tallies.end(), [](VoxelTally& tally) { tally.trim(); });
  Content content{ { kMagic, lattice_, covariances_, fractionBitsOf(lattice_), part.added_->counts }, arrays_,
    {} };
  content.common.assign(common_.has_value(), common_.value_or(AffineTransform()));
  Writer writer;
  exchange(writer, content, run);
  return std::move(writer.bytes);
}

Status VoxelAccumulator::deserialize(std::string_view bytes, VoxelAccumulator& result)
{
  Reader reader(bytes);
  Content content;
  VoxelRun run;
  exchange(reader, content, run);
  const Header& header = content.header;
  if (!reader.isAtEnd() || !isRight(header) || content.common.size() > 1 ||
    (!content.common.empty() && content.common[0].check() != Status::Ok))
  {
    return Status::InvalidParameter;
  }
  const int fractionBits = fractionBitsOf(header.lattice);
  bool areRight = (header.fractionBits == fractionBits || (run.size() == 0 && header.fractionBits == 0)) &&
    areOf(header, run);
  for (std::size_t i = 0; areRight && i < content.arrays.size(); ++i)
  {
    areRight = isRight(content.arrays[i]) &&
      (run.size() == 0 || completeTally(content.arrays[i], run, run.tallies[i]));
  }
  if (!areRight)
  {
    return Status::InvalidParameter;
  }
  VoxelAccumulator read(header.lattice, header.covariances == 1, std::move(content.arrays),
    content.common.empty() ? std::nullopt : std::make_optional(content.common[0]));
  read.added_->counts = header.counts;
  read.added_->runs.add(std::move(run));
  result = std::move(read);
  return Status::Ok;
}

} // namespace pointhaptics
