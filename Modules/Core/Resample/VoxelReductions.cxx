#include "Core/Resample/VoxelReductions.h"

#include "Core/Resample/Kernel/Fetch.h"

namespace pointhaptics
{
namespace simd
{
namespace
{

template <typename Real>
AttributeView viewOf(const PointView& points, const Real* xyz)
{
  return { xyz, sizeof(Real) == sizeof(float) ? ScalarType::Float : ScalarType::Double, 3, points.size(),
    points.stride() * std::int64_t(sizeof(Real)) };
}

}

VoxelReductions::VoxelReductions(const VoxelRequest& request)
{
  for (const AttributeRequest& attribute : request.attributes)
  {
    reducers_.push_back(
      AttributeReducer::create(attribute, request.transform, request.instructions, Executor()));
    views_.push_back(attribute.view);
  }
  if (request.representative != Representative::Mean)
  {
    representatives_.emplace(request);
    views_.push_back(request.points.floats() ? viewOf(request.points, request.points.floats())
                                             : viewOf(request.points, request.points.doubles()));
  }
}

void VoxelReductions::prepare(const std::int64_t* counts, std::int64_t voxels, std::int64_t mostPoints,
  const Executor& executor, const NearestRecords* nearest)
{
  for (const auto& reducer : reducers_)
  {
    reducer->prepare(counts, voxels, mostPoints, executor);
  }
  if (representatives_)
  {
    representatives_->prepare(counts, voxels, nearest);
  }
}

void VoxelReductions::regroup(const std::vector<std::int64_t>& parents, std::int64_t voxels)
{
  for (const auto& reducer : reducers_)
  {
    reducer->regroup(parents, voxels);
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
  if (representatives_)
  {
    representatives_->add(points, voxels, count);
  }
}

bool VoxelReductions::write(
  MeanArena& arena, std::size_t first, const Executor& executor, ProgressObserver* observer) const
{
  const double steps = double(reducers_.size()) + double(representatives_.has_value());
  for (std::size_t i = 0; i < reducers_.size(); ++i)
  {
    SubProgress writing(observer, double(i) / steps, double(i + 1) / steps);
    if (!reducers_[i]->write(arena.counts() + first, arena.attribute(i, first), executor, &writing))
    {
      return false;
    }
  }
  SubProgress choosing(observer, double(reducers_.size()) / steps, 1.0);
  return !representatives_ || representatives_->write(first, arena, executor, &choosing);
}

} // namespace simd
} // namespace pointhaptics
