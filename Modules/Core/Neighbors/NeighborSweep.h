/// @file
/// The nearest neighbours of all places of a cloud among themselves.
#pragma once

#include "Core/Base/Executor.h"
#include "Core/Neighbors/NeighborQuery.h"
#include "Core/Simd/InstructionSet.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

namespace pointhaptics
{

namespace simd
{
struct LeafSearch;
struct NeighborKernels;
}

/// The neighbours of one point, itself among them, nearest first and at equal distance the smaller index
/// first. Slots are those of NeighborQuery. Valid during the visit only.
struct NeighborList
{
  std::int64_t slot = 0; ///< Slot of the point itself.
  int count = 0;
  const double* squaredDistances = nullptr;
  const std::uint32_t* slots = nullptr;
};

/// Finds the neighbours of many points, leaf by leaf. The results are those of NeighborQuery::nearest, bit
/// for bit, at a fraction of the cost: the points of a leaf share their candidates, and each search begins
/// with the reach of the one before. Where more than 512 neighbours are wanted, or the guessed reach fails
/// (an isolated point), points are searched one by one. Memory: 290 KiB, allocated in the constructor only.
/// One thread at a time.
class NeighborSweep
{
public:
  /// @param query built, and kept alive and unchanged by the caller.
  /// @param k neighbours wanted, the point itself among them, at least 1; more than the cloud has: all of it.
  NeighborSweep(const NeighborQuery& query, int k, InstructionSet wanted = InstructionSet::Automatic);
  /// The neighbours are all in a ball of @p radius; every point is searched by itself.
  static NeighborSweep ofBalls(const NeighborQuery& query, double radius)
  {
    return NeighborSweep(query, Balls{ radius });
  }
  ~NeighborSweep();
  NeighborSweep(const NeighborSweep&) = delete;
  NeighborSweep& operator=(const NeighborSweep&) = delete;

  /// Leaves of points in spatial order: the range for run().
  static std::int64_t leaves(const NeighborQuery& query);
  /// Least leaves for a piece of a parallel loop.
  static constexpr std::int64_t kSmallestRange = 64;

  /// Calls visit(const NeighborList&) for each point of the leaves [begin, end), in the order of slots, that
  /// wants(slot) is true of.
  template <typename Visitor, typename Wants>
  void run(std::int64_t begin, std::int64_t end, Visitor&& visit, Wants&& wants)
  {
    for (std::int64_t leaf = begin; leaf < end; ++leaf)
    {
      const std::int64_t first = leaf * simd::kLeafPoints;
      const std::int64_t last = std::min(query_.size(), first + simd::kLeafPoints);
      unsigned wanted = 0;
      for (std::int64_t slot = first; slot < last; ++slot)
      {
        wanted |= unsigned(wants(slot)) << (slot - first);
      }
      searchLeaf(leaf, wanted);
      for (std::int64_t slot = first; slot < last; ++slot)
      {
        if ((wanted >> (slot - first) & 1u) != 0)
        {
          visit(listOf(leaf, int(slot - first)));
        }
      }
    }
  }
  /// As above, for every point.
  template <typename Visitor>
  void run(std::int64_t begin, std::int64_t end, Visitor&& visit)
  {
    run(begin, end, visit, [](std::int64_t) { return true; });
  }

  /// Calls visit for the k nearest of every place, in pieces of @p executor.
  template <typename Visitor>
  static void runAll(const NeighborQuery& query, int k, const Executor& executor, const Visitor& visit)
  {
    forRange(executor, leaves(query), kSmallestRange,
      [&](std::int64_t begin, std::int64_t end) { NeighborSweep(query, k).run(begin, end, visit); });
  }

  /// The neighbours of one point: faster than run() where few are wanted. Valid until the next call.
  NeighborList alone(std::int64_t slot);

private:
  struct Balls
  {
    double radius;
  };
  NeighborSweep(const NeighborQuery& query, Balls balls);
  void searchLeaf(std::int64_t leaf, unsigned wanted);
  NeighborList listOf(std::int64_t leaf, int i);

  const NeighborQuery& query_;
  int k_ = 0; ///< 0: those in balls.
  double radius_ = 0.0;
  const simd::NeighborKernels* kernels_ = nullptr;
  std::unique_ptr<simd::LeafSearch> search_; ///< Null: every point is searched alone.
  // The neighbours of the last point that was searched alone.
  std::vector<Neighbor> alone_;
  std::vector<double> squaredDistances_;
  std::vector<std::uint32_t> slots_;
};

} // namespace pointhaptics
