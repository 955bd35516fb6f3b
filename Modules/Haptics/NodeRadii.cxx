#include "Haptics/NodeRadii.h"

#include "Core/Neighbors/NeighborQuery.h"

namespace pointhaptics
{

Status nodeRadii(const CellPyramid::Level& nodes, const HapticSceneInput& input, std::vector<double>& radii,
  const Executor& executor, const std::vector<NodeUse>* uses)
{
  const PointView points(input.points.data(), std::int64_t(input.points.size()));
  NeighborQuery query;
  query.build(points, executor);
  std::vector<std::size_t> asked;
  for (std::size_t i = 0; i < nodes.cells.size(); ++i)
  {
    if (!uses || (*uses)[i] == NodeUse::All)
    {
      asked.push_back(i);
    }
  }
  std::vector<std::int64_t> slots(asked.size(), 0);
  forEachIndex(executor, std::int64_t(slots.size()),
    [&](std::int64_t i)
    {
      Neighbor nearest;
      if (query.nearestSlots(nodes.cells[asked[std::size_t(i)]].mean, 1, &nearest) == 1)
      {
        slots[std::size_t(i)] = NeighborQuery::slotOf(nearest);
      }
    });
  std::vector<double> found;
  if (input.proxyRadii.empty())
  {
    const Status status = localRadiiAt(points, input.counts, query, *input.bandwidth, slots, found, executor);
    if (status != Status::Ok)
    {
      return status;
    }
  }
  else
  {
    for (const std::int64_t slot : slots)
    {
      found.push_back(input.proxyRadii[std::size_t(query.index(slot))]);
    }
  }
  radii.assign(nodes.cells.size(), 0.0);
  for (std::size_t i = 0; i < asked.size(); ++i)
  {
    radii[asked[i]] = found[i];
  }
  return Status::Ok;
}

} // namespace pointhaptics
