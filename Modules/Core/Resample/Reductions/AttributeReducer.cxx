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

std::unique_ptr<AttributeReducer> AttributeReducer::create(
  const AttributeRequest& request, const AffineTransform& transform, InstructionSet instructions)
{
  const AttributeView& view = request.view;
  const AccumulatedArray kind = { view.type, view.components, request.statistic };
  if (!isSum(request.statistic))
  {
    return std::make_unique<AttributeTuples>(kind, instructions);
  }
  return std::make_unique<AttributeMean>(
    kind, request.range.value_or(AttributeRange()), normalColumns(transform));
}

} // namespace pointhaptics
