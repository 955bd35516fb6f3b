/// @file
/// The nearest neighbours of all points of a cloud among themselves.
#pragma once

#include "Core/Base/Executor.h"
#include "Core/Neighbors/NeighborQuery.h"
#include "Core/Simd/InstructionSet.h"

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
  std::int64_t slot = 0; ///< Of the point itself.
  int count = 0;
  const double* squaredDistances = nullptr;
  const std::uint32_t* slots = nullptr;
};

/// One worker's memory for the neighbours of many points: 60 KiB and 28 bytes per neighbour asked for. The
/// results are those of NeighborQuery::nearest, bit for bit; leaf by leaf they cost a fraction, as the points
/// of a leaf share their candidates and each search begins with what the one before has found. Where the
/// neighbours are more than 72, or the guesses fail (a point apart, a crowd of duplicates), the points are
/// asked for one by one. Allocates in the constructor only. One thread at a time.
class NeighborSweep
{
public:
  /// @param query built, and kept alive and unchanged by the caller.
  /// @param k neighbours wanted, the point itself among them, at least 1; more than the cloud has: all of it.
  NeighborSweep(const NeighborQuery& query, int k, InstructionSet wanted = InstructionSet::Automatic);
  ~NeighborSweep();
  NeighborSweep(const NeighborSweep&) = delete;
  NeighborSweep& operator=(const NeighborSweep&) = delete;

  /// Groups of points in spatial order: what run() takes.
  static std::int64_t leaves(const NeighborQuery& query);
  /// Leaves worth a piece of a parallel loop.
  static constexpr std::int64_t kSmallestRange = 64;

  /// Calls visit(const NeighborList&) for each point of the leaves [begin, end), in the order of slots.
  template <typename Visitor>
  void run(std::int64_t begin, std::int64_t end, Visitor&& visit)
  {
    for (std::int64_t leaf = begin; leaf < end; ++leaf)
    {
      const int points = searchLeaf(leaf);
      for (int i = 0; i < points; ++i)
      {
        visit(listOf(leaf, i));
      }
    }
  }

  /// The neighbours of one point. Valid until the next call.
  NeighborList alone(std::int64_t slot);

private:
  int searchLeaf(std::int64_t leaf);
  NeighborList listOf(std::int64_t leaf, int i);

  const NeighborQuery& query_;
  const int k_;
  const simd::NeighborKernels* kernels_; ///< Null: every point alone.
  std::unique_ptr<simd::LeafSearch> search_;
  // The last point that was asked for alone, and its neighbours.
  Vec3 lastPlace_;
  int lastCount_ = 0;
  std::vector<Neighbor> alone_;
  std::vector<double> squaredDistances_;
  std::vector<std::uint32_t> slots_;
};

/// All neighbours of all points: for point i of the cloud @p k of @p neighbors from i k, as of
/// NeighborQuery::nearest for its place, and as many of them as @p counts says (those of points
/// that are not finite are left alone). Room for n k and n (the points given to build()) is the caller's.
/// Independent of @p executor.
void nearestOfAll(
  const NeighborQuery& query, int k, Neighbor* neighbors, int* counts, const Executor& executor = {});

} // namespace pointhaptics
