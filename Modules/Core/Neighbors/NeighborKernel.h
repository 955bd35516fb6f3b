/// @file
/// The nearest neighbours of all points of a leaf at once, one version per instruction set. Private to Core:
/// NeighborSweep calls them. All versions give the same bits.
#pragma once

#include "Core/Neighbors/NeighborTree.h"
#include "Core/Simd/InstructionSet.h"

#include <cstdint>

namespace pointhaptics
{
namespace simd
{

/// Most neighbours that these loops search for, including the point itself.
constexpr int kMostSwept = 512;
/// Most points that may be within reach of a leaf, and most of those within reach of a point, where @p k
/// neighbours are wanted.
constexpr int mostCandidates(int k)
{
  return k <= 72 ? 1024 : 8 * k + 512;
}
constexpr int mostNear(int k)
{
  return k <= 72 ? 192 : 2 * k + 64;
}
constexpr int kMostCandidates = mostCandidates(kMostSwept);
constexpr int kMostNear = mostNear(kMostSwept);
/// Loads and stores may pass the end by a vector.
constexpr int kSlack = 4;

/// Scratch memory of one thread.
struct LeafSearch
{
  int k = 1;             ///< Neighbours wanted, up to kMostSwept.
  unsigned wanted = ~0u; ///< Points of the leaf that are searched for, as bits.
  // Points within reach of the leaf.
  double places[3][kMostCandidates + kSlack];
  std::uint32_t slots[kMostCandidates + kSlack];
  int candidates = 0;
  // Those within reach of one point.
  double near[kMostCandidates + kSlack];
  std::uint32_t nearCandidates[kMostCandidates + kSlack];
  std::uint64_t ranks[kMostNear + kSlack];
  std::int32_t order[kMostNear + kSlack];

  /// Squared distance that the search begins with: a guess that affects only the speed. Kept from leaf to
  /// leaf.
  double reach = 0.0;
  /// The answers, nearest first: of the points in the bits of found.
  double squaredDistances[kLeafPoints][kMostSwept];
  std::uint32_t neighbors[kLeafPoints][kMostSwept]; ///< Slots.
  unsigned found = 0;
};

struct NeighborKernels
{
  /// The search.k nearest points of each wanted point of @p leaf. Points for which the guess is too short are
  /// left out of search.found.
  void (*searchLeaf)(const NeighborTree& tree, std::int64_t leaf, LeafSearch& search);
};

/// Those of usableInstructionSet(@p wanted).
const NeighborKernels& neighborKernels(InstructionSet wanted = InstructionSet::Automatic) noexcept;

const NeighborKernels& baselineNeighborKernels();
/// Null where the compiler or the processor family lacks them.
const NeighborKernels* avx2NeighborKernels();

} // namespace simd
} // namespace pointhaptics
