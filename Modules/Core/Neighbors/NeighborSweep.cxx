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
  , kernels_(&simd::neighborKernels(wanted))
  , search_(k_ <= simd::kMostSwept ? new simd::LeafSearch : nullptr)
  , alone_(std::size_t(k_))
  , squaredDistances_(std::size_t(k_))
  , slots_(std::size_t(k_))
{
  if (search_)
  {
    search_->k = k_;
  }
}

NeighborSweep::NeighborSweep(const NeighborQuery& query, Balls balls)
  : query_(query)
  , radius_(balls.radius)
{
}

NeighborSweep::~NeighborSweep() = default;

std::int64_t NeighborSweep::leaves(const NeighborQuery& query)
{
  return (query.size() + simd::kLeafPoints - 1) / simd::kLeafPoints;
}

void NeighborSweep::searchLeaf(std::int64_t leaf, unsigned wanted)
{
  if (search_ && wanted != 0)
  {
    search_->wanted = wanted;
    if (!(search_->reach > 0.0))
    {
      const NeighborList list = alone(leaf * simd::kLeafPoints);
      search_->reach = kFirstMargin * list.squaredDistances[list.count - 1];
    }
    kernels_->searchLeaf(query_.tree(), leaf, *search_);
  }
}

NeighborList NeighborSweep::listOf(std::int64_t leaf, int i)
{
  const std::int64_t slot = leaf * simd::kLeafPoints + i;
  if (search_ && (search_->found >> i & 1u) != 0)
  {
    return { slot, k_, search_->squaredDistances[i], search_->neighbors[i] };
  }
  return alone(slot);
}

NeighborList NeighborSweep::alone(std::int64_t slot)
{
  const Vec3 place = query_.point(slot);
  if (k_ > 0)
  {
    alone_.resize(std::size_t(query_.nearestSlots(place, k_, alone_.data())));
  }
  else
  {
    alone_.clear();
    query_.visitBallSlots(place, radius_,
      [this](double d2, std::int64_t other) {
        alone_.push_back({ d2, query_.packed(other) });
      });
    std::sort(alone_.begin(), alone_.end());
  }
  squaredDistances_.clear();
  slots_.clear();
  for (const Neighbor& neighbor : alone_)
  {
    squaredDistances_.push_back(neighbor.squaredDistance);
    slots_.push_back(std::uint32_t(NeighborQuery::slotOf(neighbor)));
  }
  return { slot, int(alone_.size()), squaredDistances_.data(), slots_.data() };
}

} // namespace pointhaptics
