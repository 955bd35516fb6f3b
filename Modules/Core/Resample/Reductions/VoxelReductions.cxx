#include "Core/Resample/Reductions/VoxelReductions.h"

#include "Core/Resample/Kernel/Fetch.h"
#include "Core/Resample/Reductions/AttributeTuples.h"

#include <algorithm>
#include <numeric>

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
  /// Tuples are points.
  void addTuples(
    const Tuples& tuples, const std::int64_t* points, const std::int64_t* voxels, int count) override
  {
    const auto addFrom = [&](auto example)
    {
      using Coordinate = decltype(example);
      request_.singlePrecision ? this->addPlaces<Coordinate, float>(tuples, points, voxels, count)
                               : this->addPlaces<Coordinate, double>(tuples, points, voxels, count);
    };
    request_.points.floats() ? addFrom(float()) : addFrom(double());
  }

private:
  template <typename Coordinate, typename Real>
  void addPlaces(const Tuples& tuples, const std::int64_t* points, const std::int64_t* voxels, int count)
  {
    const AffineTransform transform = request_.transform;
    const auto add = [&](const auto& placeOf)
    {
      this->keepTuples<Real>(voxels, count, std::integral_constant<int, 3>(),
        [=](int i)
        {
          Coordinate point[3];
          std::memcpy(point, tuples.first + tuples.step * points[i], sizeof point);
          const Vec3 place = placeOf(Vec3(double(point[0]), double(point[1]), double(point[2])));
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

PayloadLayout payloadLayoutOf(const VoxelRequest& request)
{
  std::vector<AttributeView> views;
  for (const AttributeRequest& attribute : request.attributes)
  {
    views.push_back(attribute.view);
  }
  if (request.representative == Representative::Median)
  {
    views.push_back(viewOf(request.points));
  }
  PayloadLayout layout;
  constexpr int kWord = sizeof(std::uint32_t);
  int bytes = kWord; // With a number.
  for (const AttributeView& view : views)
  {
    if (layout.count == PayloadLayout::kMostArrays ||
      bytes + view.tupleBytes() > PayloadLayout::kMostWords * kWord)
    {
      break;
    }
    layout.arrays[layout.count++] = { static_cast<const char*>(view.values), view.step(),
      int(view.tupleBytes()), bytes };
    bytes += int(view.tupleBytes());
  }
  layout.numbered =
    request.voxelIndex || keepsPoints(request.representative) || std::size_t(layout.count) < views.size();
  const int unused = layout.numbered ? 0 : kWord;
  std::for_each(
    layout.arrays, layout.arrays + layout.count, [=](PayloadArray& array) { array.offset -= unused; });
  layout.words = (bytes - unused + kWord - 1) / kWord;
  return layout;
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

void VoxelReductions::fetch(const std::int64_t* points, int count, int without) const
{
  // Points in the order of their memory need no fetching.
  const bool areScattered =
    std::size_t(without) < views_.size() && count > 0 && points[count - 1] - points[0] != count - 1;
  for (auto i = std::size_t(without); i < views_.size(); ++i)
  {
    const AttributeView& view = views_[i];
    const auto* const first = static_cast<const char*>(view.values);
    const std::int64_t step = view.step();
    const std::int64_t last = view.tupleBytes() - 1;
    for (int j = 0; areScattered && j < count; ++j)
    {
      const char* const tuple = first + step * points[j];
      simd::fetch(tuple);
      simd::fetch(tuple + last);
    }
  }
}

void VoxelReductions::addPayloads(const PayloadLayout& layout, const std::uint32_t* payloads,
  const std::int64_t* points, const std::int64_t* voxels, int count)
{
  std::int64_t places[kBlockRecords];
  std::iota(places, places + (layout.count > 0 ? count : 0), 0);
  for (std::size_t i = 0; i < reducers_.size(); ++i)
  {
    const bool isPayload = i < std::size_t(layout.count);
    AttributeReducer::Tuples tuples = { static_cast<const char*>(views_[i].values), views_[i].step() };
    if (isPayload)
    {
      tuples = { reinterpret_cast<const char*>(payloads) + layout.arrays[i].offset,
        std::int64_t(sizeof(std::uint32_t)) * layout.words };
    }
    reducers_[i]->addTuples(tuples, isPayload ? places : points, voxels, count);
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
