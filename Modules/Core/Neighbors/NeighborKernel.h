/// @file
/// The nearest neighbours of all points of a leaf at once, one version per instruction set. Private to Core:
/// NeighborSweep calls them. All versions give the same bits.
#pragma once

#include "Core/Neighbors/NeighborTree.h"
#include "Core/Simd/InstructionSet.h"

#include <cstddef>
#include <cstdint>

namespace pointhaptics
{
namespace simd
{

/// Most neighbours that these loops search for, including the point itself.
constexpr int kMostSwept = 4096;
/// Most neighbours of a place that a search alone looks for in these loops: its memory is on the stack.
constexpr int kMostAlone = 72;
/// Most points within reach of a point that are ranked by comparing each with each; more are sorted.
constexpr int kMostRanked = 192;
/// Loads and stores may pass the end by a vector.
constexpr int kSlack = 8;

/// Scratch memory of one thread, for one number of neighbours.
struct LeafSearch
{
  /// Most points that may be within reach of a leaf, and most of those within reach of a point.
  int mostCandidates;
  int mostNear;
  int k; ///< Length of each row of the answers.
  // Points within reach of the leaf.
  double* places[3];
  std::uint32_t* slots;
  int candidates = 0;
  // Those within reach of one point.
  double* near;
  std::uint32_t* nearCandidates;
  std::int64_t* ranks;
  std::int32_t* order;

  /// Squared distance that the search begins with: a guess that affects only the speed. Kept from leaf to
  /// leaf.
  double reach = 0.0;
  /// The answers, nearest first: of the points in the bits of found.
  double* squaredDistances;
  std::uint32_t* neighbors; ///< Slots.
  unsigned found = 0;

  static constexpr int candidatesFor(int k) { return k <= kMostAlone ? 1024 : 8 * k + 512; }
  static constexpr int nearFor(int k) { return k <= kMostAlone ? kMostRanked : 2 * k + 64; }
  /// Size of the memory for answers to @p points points, in doubles.
  static constexpr std::size_t wordsFor(int k, int points)
  {
    const std::size_t candidates = std::size_t(candidatesFor(k) + kSlack);
    const std::size_t answers = std::size_t(k) * std::size_t(points);
    return 5 * candidates + candidates / 2 + 2 * std::size_t(nearFor(k) + kSlack) + answers +
      (answers + 1) / 2;
  }
  /// @p memory: wordsFor(@p k, @p points), aligned to a line of the caches for speed.
  LeafSearch(double* memory, int k, int points);
};

/// Rows of the answers. These are static: sources of several instruction sets include them.
static inline double* distancesOf(const LeafSearch& search, int point)
{
  return search.squaredDistances + std::size_t(point) * std::size_t(search.k);
}
static inline std::uint32_t* neighborsOf(const LeafSearch& search, int point)
{
  return search.neighbors + std::size_t(point) * std::size_t(search.k);
}

inline LeafSearch::LeafSearch(double* memory, int neighborsWanted, int points)
  : mostCandidates(candidatesFor(neighborsWanted))
  , mostNear(nearFor(neighborsWanted))
  , k(neighborsWanted)
{
  const auto take = [&memory](std::size_t words)
  {
    double* const taken = memory;
    memory += words;
    return taken;
  };
  const std::size_t room = std::size_t(mostCandidates + kSlack);
  const std::size_t nearRoom = std::size_t(mostNear + kSlack);
  for (double*& axis : places)
  {
    axis = take(room);
  }
  near = take(room);
  slots = reinterpret_cast<std::uint32_t*>(take(room / 2));
  nearCandidates = reinterpret_cast<std::uint32_t*>(take(room / 2));
  ranks = reinterpret_cast<std::int64_t*>(take(nearRoom));
  order = reinterpret_cast<std::int32_t*>(take(nearRoom / 2));
  squaredDistances = take(std::size_t(k) * std::size_t(points));
  neighbors = reinterpret_cast<std::uint32_t*>(memory);
}

struct NeighborKernels
{
  /// The search.k nearest points (1 to kMostSwept) of each point of @p leaf. Points for which the
  /// guess is too short are left out of search.found.
  void (*searchLeaf)(const NeighborTree& tree, std::int64_t leaf, LeafSearch& search);
  /// The search.k nearest points (1 to kMostAlone) of a position, nearest first: the first row of the
  /// answers.
  /// @return false, without an answer, where there are fewer nearby, or too many at the same distance.
  bool (*searchPlace)(const NeighborTree& tree, const double (&center)[3], LeafSearch& search);
  /// Squared distances of a point from all boxes of a group (those not in use too), each never above that of
  /// a point in the box.
  void (*groupGaps)(const BoxGroup& group, const double (&center)[3], double (&gaps)[kBranches]);
  /// Squared distances of the points of a leaf. @return the bits of those not above @p reach.
  unsigned (*leafDistances)(const NeighborTree& tree, std::int64_t leaf, const double (&center)[3],
    double reach, double (&distances)[kLeafPoints]);
  /// Positions along Hilbert's curve through 2^30 cells, from their coordinates, 10 bits each.
  void (*hilbertKeys)(
    const std::uint32_t* x, const std::uint32_t* y, const std::uint32_t* z, int count, std::uint32_t* keys);
};

/// Those of usableInstructionSet(@p wanted).
const NeighborKernels& neighborKernels(InstructionSet wanted = InstructionSet::Automatic) noexcept;

const NeighborKernels& baselineNeighborKernels();
/// Null where the compiler or the processor family lacks them.
const NeighborKernels* avx2NeighborKernels();
const NeighborKernels* avx512NeighborKernels();

} // namespace simd
} // namespace pointhaptics
