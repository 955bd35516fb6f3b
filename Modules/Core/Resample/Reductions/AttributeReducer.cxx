#include "Core/Resample/Reductions/AttributeReducer.h"

#include "Core/Resample/Reductions/AttributeMean.h"
#include "Core/Resample/Reductions/AttributeTuples.h"

namespace pointhaptics
{

std::array<Vec3, 3> normalColumns(const AffineTransform& transform)
{
  return { transform.applyToNormal({ 1, 0, 0 }), transform.applyToNormal({ 0, 1, 0 }),
    transform.applyToNormal({ 0, 0, 1 }) };
}

std::unique_ptr<AttributeReducer> AttributeReducer::create(const AttributeRequest& request,
  const AffineTransform& transform, InstructionSet instructions, const Executor& executor)
{
  const AttributeView& view = request.view;
  if (!isSum(request.statistic))
  {
    return std::make_unique<AttributeTuples>(view, request.statistic, instructions);
  }
  auto mean = std::make_unique<AttributeMean>(
    view, request.range ? *request.range : rangeOf(view, executor, instructions), instructions);
  if (request.statistic == AttributeStatistic::Normal)
  {
    mean->turnVectors(normalColumns(transform));
  }
  return mean;
}

} // namespace pointhaptics
