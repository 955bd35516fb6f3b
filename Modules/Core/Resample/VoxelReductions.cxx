#include "Core/Resample/VoxelReductions.h"

#include "Core/Resample/AttributeMean.h"

namespace pointhaptics
{
namespace simd
{
namespace
{

TupleSource coordinatesOf(const PointView& points)
{
  const auto source = [&](const auto* xyz) {
    return TupleSource{ xyz, 3 * sizeof *xyz, std::size_t(points.stride()) * sizeof *xyz };
  };
  return points.floats() ? source(points.floats()) : source(points.doubles());
}

}

void VoxelReductions::chooseRows(VoxelRequest& request, const Executor& executor)
{
  for (AttributeRequest& attribute : request.attributes)
  {
    request.tuples.push_back(AttributeReducer::sourceOf(attribute.view));
    if (isSum(attribute.statistic) && !attribute.range)
    {
      attribute.range = rangeOf(attribute.view, executor, request.instructions);
    }
  }
  if (request.representative != Representative::Mean)
  {
    request.tuples.push_back(coordinatesOf(request.points));
  }
  if (request.representative != Representative::Mean || request.voxelIndex)
  {
    request.tuples.emplace_back();
  }
}

VoxelReductions::VoxelReductions(const VoxelRequest& request)
{
  const std::size_t others = (request.representative != Representative::Mean) ? 2 : request.voxelIndex;
  firstSource_ = request.tuples.size() - request.attributes.size() - others;
  for (const AttributeRequest& attribute : request.attributes)
  {
    reducers_.push_back(
      AttributeReducer::create(attribute, request.transform, request.instructions, Executor()));
  }
  if (request.representative != Representative::Mean)
  {
    representatives_.emplace(request);
  }
}

void VoxelReductions::prepare(
  const std::int64_t* counts, std::int64_t voxels, std::int64_t mostPoints, const Executor& executor)
{
  for (const auto& reducer : reducers_)
  {
    reducer->prepare(counts, voxels, mostPoints, executor);
  }
  if (representatives_)
  {
    representatives_->prepare(counts, voxels);
  }
}

void VoxelReductions::regroup(
  const std::vector<std::int64_t>& places, std::int64_t voxels, std::int64_t mostPoints)
{
  for (const auto& reducer : reducers_)
  {
    reducer->regroup(places, voxels, mostPoints);
  }
}

void VoxelReductions::add(const PointRows& rows, const std::int64_t* voxels, int count)
{
  std::size_t source = firstSource_;
  for (const auto& reducer : reducers_)
  {
    reducer->add(rows.tuples(source++), rows.bytes, voxels, count);
  }
  if (representatives_)
  {
    representatives_->add(rows.tuples(source), rows.tuples(source + 1), rows.bytes, voxels, count);
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
