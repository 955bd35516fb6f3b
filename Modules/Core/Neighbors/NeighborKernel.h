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
constexpr int kMostSwept = 72;
/// Most points that may be within reach of a leaf.
constexpr int kMostCandidates = 1024;
/// Most points within reach of a point that are ranked by comparing each with each.
constexpr int kMostRanked = 192;
/// Loads and stores may pass the end by a vector.
constexpr int kSlack = 8;

/// Scratch memory of one thread.
struct alignas(64) LeafSearch
{
  // Points within reach of the leaf.
  double places[3][kMostCandidates + kSlack];
  std::uint32_t slots[kMostCandidates + kSlack];
  int candidates = 0;
  // Those within reach of one point.
  double near[kMostCandidates + kSlack];
  std::uint32_t nearCandidates[kMostCandidates + kSlack];
  std::int64_t ranks[kMostRanked + kSlack];
  std::int32_t order[kMostRanked + kSlack];

  /// Squared distance that the search begins with: a guess that affects only the speed. Kept from leaf to
  /// leaf.
  double reach = 0.0;
  /// The answers, nearest first: of the points in the bits of found, k each.
  double squaredDistances[kLeafPoints][kMostSwept];
  std::uint32_t neighbors[kLeafPoints][kMostSwept]; ///< Slots.
  unsigned found = 0;
};

struct NeighborKernels
{
  /// The @p k nearest points (1 to kMostSwept) of each point of @p leaf. Points for which the
  /// guess is too short are left out of search.found.
  void (*searchLeaf)(const NeighborTree& tree, std::int64_t leaf, int k, LeafSearch& search);
  /// The @p k nearest points (1 to kMostSwept) of a position, nearest first: the first row of the answers.
  /// @return false, without an answer, where there are fewer nearby, or too many at the same distance.
  bool (*searchPlace)(const NeighborTree& tree, const double (&center)[3], int k, LeafSearch& search);
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
