#include "Core/Resample/VoxelAccumulator.h"

#include "Core/Resample/VoxelAccumulatorSums.h"
#include "Core/Resample/VoxelResamplerImplementation.h"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <utility>

namespace pointhaptics
{

using namespace simd;

namespace
{

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
  sums.counts.add({ points.size(), engine.clipped, engine.invalid });
  sums.runs.add(std::move(run));
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
    to.counts.add(from.counts);
    to.runs.add(std::move(from.runs.whole()));
  };
  mergeSums(*added_, *other.added_);
  mergeSums(*subtracted_, *other.subtracted_);
  other = this->withoutPoints();
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
  added_->counts.add(subtracted_->counts, -1);
  added_->runs = {};
  added_->runs.add(std::move(difference));
  subtracted_ = std::make_unique<Sums>();
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

VoxelAccumulator::Sums::Range VoxelAccumulator::Sums::range(std::uint64_t firstKey, std::uint64_t endKey)
{
  const VoxelRun& run = runs.whole();
  const std::size_t first = run.find(firstKey);
  Range range = { first, std::max(first, run.find(endKey)), {} };
  if (firstKey == 0 && endKey > 0)
  {
    range.counts = { counts.clipped + counts.invalid, counts.clipped, counts.invalid };
  }
  range.counts.points = std::accumulate(run.voxels.begin() + std::ptrdiff_t(first),
    run.voxels.begin() + std::ptrdiff_t(range.last), range.counts.points,
    [](std::int64_t sum, const WideSums& voxel) { return sum + voxel.count; });
  return range;
}

VoxelAccumulator VoxelAccumulator::part(std::uint64_t first, std::uint64_t end)
{
  VoxelAccumulator part = this->withoutPoints();
  if (this->settle())
  {
    const Sums::Range range = added_->range(first, end);
    part.added_->counts = range.counts;
    part.added_->runs.add(added_->runs.whole().part(range.first, range.last));
  }
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

} // namespace pointhaptics
