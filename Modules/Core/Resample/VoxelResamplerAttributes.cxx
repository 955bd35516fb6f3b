/// VoxelResampler: what is made of the attributes of the points.
#include "Core/Resample/VoxelResamplerImplementation.h"

namespace pointhaptics
{

using namespace simd;

/// Makes the reducers, and has the tuples of points binned with these.
void VoxelResampler::Implementation::addAttributes(VoxelRequest& request, const Executor& executor)
{
  reducers_.clear();
  firstAttribute_ = request.tuples.size();
  for (const AttributeRequest& attribute : request.attributes)
  {
    reducers_.emplace_back(attribute, request.transform, request.instructions, executor);
    request.tuples.push_back(AttributeReducer::sourceOf(attribute.view));
  }
  request.keys = request.keys || !reducers_.empty();
}

std::vector<std::size_t> VoxelResampler::Implementation::attributeBytes() const
{
  std::vector<std::size_t> bytes;
  for (const AttributeReducer& reducer : reducers_)
  {
    bytes.push_back(reducer.tupleBytes());
  }
  return bytes;
}

/// Reduces attributes by another pass over the points, where the first one did not.
Status VoxelResampler::Implementation::reduceAttributes(
  const VoxelRequest& request, const Executor& executor, ProgressObserver* observer)
{
  if (reducers_.empty() || reducesInPass_)
  {
    return Status::Ok;
  }
  const std::int64_t* counts = levels[0].arena.counts();
  const std::int64_t mostPoints = levels.back().mostPoints();
  for (AttributeReducer& reducer : reducers_)
  {
    reducer.prepare(counts, levels[0].size, mostPoints, executor);
  }
  SubProgress visiting(observer, 0.0, 0.6);
  const Status status = visitPointsByVoxel(
    request,
    [this](const PointRows& rows, const std::int64_t* voxels, int count)
    {
      for (std::size_t i = 0; i < reducers_.size(); ++i)
      {
        reducers_[i].add(rows.tuples(firstAttribute_ + i), rows.bytes, voxels, count);
      }
    },
    executor, &visiting);
  if (status != Status::Ok)
  {
    return status;
  }
  const auto steps = double(levels.size() * reducers_.size());
  double done = 0.0;
  for (std::size_t l = 0; l < levels.size(); ++l)
  {
    Level& level = levels[l];
    level.arena.prepareAttributes(
      std::size_t(level.size), attributeBytes(), l == 0 ? request.allocator : nullptr);
    for (std::size_t i = 0; i < reducers_.size(); ++i, ++done)
    {
      SubProgress writing(observer, 0.6 + 0.4 * done / steps, 0.6 + 0.4 * (done + 1.0) / steps);
      if (l > 0)
      {
        reducers_[i].coarsen(level.parents, level.size);
      }
      if (!reducers_[i].write(level.arena.counts(), level.arena.attribute(i, 0), executor, &writing))
      {
        return Status::Aborted;
      }
    }
  }
  return !observer || observer->report(1.0) ? Status::Ok : Status::Aborted;
}

} // namespace pointhaptics
