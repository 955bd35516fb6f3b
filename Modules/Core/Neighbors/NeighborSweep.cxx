#include "Core/Neighbors/NeighborSweep.h"

#include "Core/Neighbors/NeighborKernel.h"

#include <algorithm>

namespace pointhaptics
{
namespace
{

/// How much farther than the k-th neighbour of its first point a leaf is searched, squared.
constexpr double kFirstMargin = 2.0;

}

NeighborSweep::NeighborSweep(const NeighborQuery& query, int k, InstructionSet wanted)
  : query_(query)
  , k_(int(std::min<std::int64_t>(std::max(k, 1), std::max<std::int64_t>(query.size(), 1))))
  , kernels_(k_ <= simd::kMostSwept ? &simd::neighborKernels(wanted) : nullptr)
  , memory_(kernels_ ? simd::LeafSearch::wordsFor(k_, simd::kLeafPoints) : 0)
  , search_(kernels_ ? std::make_unique<simd::LeafSearch>(memory_.data(), k_, simd::kLeafPoints) : nullptr)
  , alone_(std::size_t(k_))
  , squaredDistances_(std::size_t(k_))
  , slots_(std::size_t(k_))
{
}

NeighborSweep::~NeighborSweep() = default;

std::int64_t NeighborSweep::leaves(const NeighborQuery& query)
{
  return (query.size() + simd::kLeafPoints - 1) / simd::kLeafPoints;
}

int NeighborSweep::searchLeaf(std::int64_t leaf)
{
  const std::int64_t first = leaf * simd::kLeafPoints;
  if (kernels_)
  {
    if (!(search_->reach > 0.0))
    {
      const NeighborList list = alone(first);
      search_->reach = kFirstMargin * list.squaredDistances[list.count - 1];
    }
    kernels_->searchLeaf(query_.tree(), leaf, *search_);
  }
  return int(std::min<std::int64_t>(query_.size() - first, simd::kLeafPoints));
}

NeighborList NeighborSweep::listOf(std::int64_t leaf, int i)
{
  const std::int64_t slot = leaf * simd::kLeafPoints + i;
  if (kernels_ && (search_->found >> i & 1u) != 0)
  {
    return { slot, k_, simd::distancesOf(*search_, i), simd::neighborsOf(*search_, i) };
  }
  return alone(slot);
}

NeighborList NeighborSweep::alone(std::int64_t slot)
{
  const int count = query_.nearestSlots(query_.point(slot), k_, alone_.data());
  for (int i = 0; i < count; ++i)
  {
    squaredDistances_[std::size_t(i)] = alone_[std::size_t(i)].squaredDistance;
    slots_[std::size_t(i)] = std::uint32_t(NeighborQuery::slotOf(alone_[std::size_t(i)]));
  }
  return { slot, count, squaredDistances_.data(), slots_.data() };
}

void nearestOfAll(
  const NeighborQuery& query, int k, Neighbor* neighbors, int* counts, const Executor& executor)
{
  forRange(executor, NeighborSweep::leaves(query), NeighborSweep::kSmallestRange,
    [&](std::int64_t begin, std::int64_t end)
    {
      NeighborSweep sweep(query, k);
      sweep.run(begin, end,
        [&](const NeighborList& list)
        {
          const std::int64_t index = query.index(list.slot);
          counts[index] = list.count;
          Neighbor* to = neighbors + index * k;
          for (int i = 0; i < list.count; ++i)
          {
            to[i] = { list.squaredDistances[i], query.index(list.slots[i]) };
          }
        });
    });
  query.visitRepeats(
    [&](std::int64_t repeated, std::int64_t slot)
    {
      const std::int64_t first = query.index(slot);
      counts[repeated] = counts[first];
      std::copy_n(neighbors + first * k, counts[first], neighbors + repeated * k);
    });
}

} // namespace pointhaptics
