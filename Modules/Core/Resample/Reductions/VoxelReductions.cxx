#include "Core/Resample/Reductions/VoxelReductions.h"

#include "Core/Resample/Kernel/Fetch.h"
#include "Core/Resample/Reductions/AttributeTuples.h"

namespace pointhaptics
{
namespace simd
{
namespace
{

AttributeView viewOf(const PointView& points)
{
  const bool single = points.floats() != nullptr;
  return { single ? static_cast<const void*>(points.floats()) : points.doubles(),
    single ? ScalarType::Float : ScalarType::Double, 3, points.size(),
    points.stride() * (single ? std::int64_t(sizeof(float)) : std::int64_t(sizeof(double))) };
}

/// Medians of the points' places, in the type that is asked for.
class PlaceMedians final : public AttributeTuples
{
public:
  explicit PlaceMedians(const VoxelRequest& request)
    : AttributeTuples({ nullptr, request.singlePrecision ? ScalarType::Float : ScalarType::Double, 3 },
        AttributeStatistic::Median, request.instructions)
    , request_(request)
    , isIdentity_(request.transform.isIdentity())
  {
  }
  void add(const std::int64_t* points, const std::int64_t* voxels, int count) override
  {
    request_.singlePrecision ? this->addPlaces<float>(points, voxels, count)
                             : this->addPlaces<double>(points, voxels, count);
  }

private:
  template <typename Real>
  void addPlaces(const std::int64_t* points, const std::int64_t* voxels, int count)
  {
    const PointView view = request_.points;
    const AffineTransform transform = request_.transform;
    const auto add = [&](const auto& placeOf)
    {
      this->addTuples<Real>(voxels, count, std::integral_constant<int, 3>(),
        [=](int i)
        {
          const Vec3 place = placeOf(view[points[i]]);
          const Real xyz[3] = { Real(place.x), Real(place.y), Real(place.z) };
          std::array<char, sizeof xyz> bytes;
          std::memcpy(bytes.data(), xyz, sizeof xyz);
          return bytes;
        });
    };
    isIdentity_ ? add([](const Vec3& point) { return point; })
                : add([=](const Vec3& point) { return transform.apply(point); });
  }

  const VoxelRequest& request_;
  bool isIdentity_;
};

}

VoxelReductions::VoxelReductions(const VoxelRequest& request)
  : request_(&request)
{
  for (const AttributeRequest& attribute : request.attributes)
  {
    reducers_.push_back(
      AttributeReducer::create(attribute, request.transform, request.instructions, Executor()));
    views_.push_back(attribute.view);
  }
  if (request.representative != Representative::Mean)
  {
    views_.push_back(viewOf(request.points));
  }
  if (request.representative == Representative::Median)
  {
    reducers_.push_back(std::make_unique<PlaceMedians>(request));
  }
  else if (request.representative != Representative::Mean)
  {
    nearest_.emplace(request);
  }
}

void VoxelReductions::prepare(const std::int64_t* counts, std::int64_t voxels, std::int64_t mostPoints,
  const Executor& executor, const NearestRecords* known)
{
  for (const auto& reducer : reducers_)
  {
    reducer->prepare(counts, voxels, mostPoints, executor);
  }
  if (nearest_)
  {
    nearest_->prepare(counts, voxels, known);
  }
}

void VoxelReductions::fetch(const std::int64_t* points, int count) const
{
  // Points in the order of their memory need no fetching.
  const bool areScattered = count > 0 && points[count - 1] - points[0] != count - 1;
  for (const AttributeView& view : views_)
  {
    const auto* const first = static_cast<const char*>(view.values);
    const std::int64_t step = view.step();
    const std::int64_t last = view.tupleBytes() - 1;
    for (int i = 0; areScattered && i < count; ++i)
    {
      const char* const tuple = first + step * points[i];
      simd::fetch(tuple);
      simd::fetch(tuple + last);
    }
  }
}

void VoxelReductions::add(const std::int64_t* points, const std::int64_t* voxels, int count)
{
  for (const auto& reducer : reducers_)
  {
    reducer->add(points, voxels, count);
  }
  if (nearest_)
  {
    nearest_->add(points, voxels, count);
  }
}

bool VoxelReductions::write(
  MeanArena& arena, std::size_t first, const Executor& executor, ProgressObserver* observer) const
{
  const double steps = double(reducers_.size()) + double(nearest_.has_value());
  for (std::size_t i = 0; i < reducers_.size(); ++i)
  {
    SubProgress writing(observer, double(i) / steps, double(i + 1) / steps);
    void* const to = i < arena.attributes() ? arena.attribute(i, first) : arena.pointsFrom(first);
    if (!reducers_[i]->write(arena.counts() + first, to, executor, &writing))
    {
      return false;
    }
  }
  SubProgress choosing(observer, double(reducers_.size()) / steps, 1.0);
  return !nearest_ || nearest_->write(first, arena, executor, &choosing);
}

std::vector<VoxelTally> VoxelReductions::takeTallies()
{
  std::vector<VoxelTally> tallies;
  for (std::size_t i = 0; i < request_->attributes.size(); ++i)
  {
    tallies.push_back(reducers_[i]->takeTally());
  }
  return tallies;
}

} // namespace simd
} // namespace pointhaptics
