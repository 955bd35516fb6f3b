#include "Core/Resample/AttributeReducer.h"

#include <algorithm>
#include <utility>

namespace pointhaptics
{
namespace
{

std::variant<AttributeMean, AttributeTuples> tuplesFor(
  const AttributeRequest& request, InstructionSet instructions, const Executor& executor)
{
  const AttributeView& view = request.view;
  switch (request.statistic)
  {
    case AttributeStatistic::Mode:
      return AttributeTuples(view.type, view.components, TupleStatistic::Mode);
    case AttributeStatistic::Median:
      return AttributeTuples(view.type, view.components, TupleStatistic::Median);
    default:
      return AttributeMean(
        view, request.range ? *request.range : rangeOf(view, executor, instructions), instructions);
  }
}

}

AttributeReducer::AttributeReducer(const AttributeRequest& request, const AffineTransform& transform,
  InstructionSet instructions, const Executor& executor)
  : statistic_(request.statistic)
  , columns_{ transform.applyToNormal({ 1, 0, 0 }), transform.applyToNormal({ 0, 1, 0 }),
    transform.applyToNormal({ 0, 0, 1 }) }
  , tuples_(tuplesFor(request, instructions, executor))
{
}

TupleSource AttributeReducer::sourceOf(const AttributeView& view)
{
  return { view.values, std::size_t(bytesOf(view.type)) * std::size_t(view.components),
    std::size_t(view.stride) };
}

void AttributeReducer::prepare(
  const std::int64_t* counts, std::int64_t voxels, std::int64_t mostPoints, const Executor& executor)
{
  if (auto* mean = std::get_if<AttributeMean>(&tuples_))
  {
    mean->prepare(voxels, mostPoints, executor);
    return;
  }
  std::get<AttributeTuples>(tuples_).prepare(counts, voxels);
}

void AttributeReducer::add(const void* tuples, std::size_t stride, const std::int64_t* voxels, int count)
{
  std::visit([&](auto& ofVoxels) { ofVoxels.add(tuples, stride, voxels, count); }, tuples_);
}

void AttributeReducer::spread(
  const std::vector<std::uint32_t>& places, std::int64_t voxels, std::int64_t mostPoints)
{
  std::get<AttributeMean>(tuples_).spread(places, voxels, mostPoints);
}

void AttributeReducer::coarsen(const std::vector<std::int64_t>& parents, std::int64_t voxels)
{
  std::visit([&](auto& ofVoxels) { ofVoxels.coarsen(parents, voxels); }, tuples_);
}

bool AttributeReducer::write(
  const std::int64_t* counts, void* values, const Executor& executor, ProgressObserver* observer) const
{
  const auto* mean = std::get_if<AttributeMean>(&tuples_);
  if (!mean)
  {
    return std::get<AttributeTuples>(tuples_).write(values, executor, observer);
  }
  statistic_ == AttributeStatistic::Normal ? mean->writeNormals(counts, columns_, values, executor)
                                           : mean->write(counts, values, executor);
  return true;
}

} // namespace pointhaptics
