#include "Haptics/NodeRadii.h"

#include "Core/NeighborQuery.h"

namespace pointhaptics
{

Status nodeRadii(const CellPyramid::Level& nodes, const HapticSceneInput& input, std::vector<double>& radii,
  const Executor& executor)
{
  const PointView points(input.points.data(), std::int64_t(input.points.size()));
  NeighborQuery query;
  query.build(points, executor);
  std::vector<std::int64_t> slots(nodes.cells.size(), 0);
  forRange(executor, std::int64_t(slots.size()),
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t i = begin; i < end; ++i)
      {
        Neighbor nearest;
        if (query.nearestSlots(nodes.cells[std::size_t(i)].mean, 1, &nearest) == 1)
        {
          slots[std::size_t(i)] = NeighborQuery::slotOf(nearest);
        }
      }
    });
  if (input.proxyRadii.empty())
  {
    return localRadiiAt(points, query, *input.bandwidth, slots, radii, executor);
  }
  radii.clear();
  for (const std::int64_t slot : slots)
  {
    radii.push_back(input.proxyRadii[std::size_t(query.index(slot))]);
  }
  return Status::Ok;
}

} // namespace pointhaptics
