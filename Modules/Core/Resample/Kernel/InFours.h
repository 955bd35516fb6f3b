/// @file
/// Loops that are unrolled, in several orders. Internal linkage: sources of several instruction sets include
/// them.
#pragma once

namespace pointhaptics
{
namespace simd
{
namespace
{

/// Calls visit(i) for all i below @p count, taking turns in four parts of the range. Neighbours in a scan are
/// in one voxel and one partition, so that an update would wait for the one before: updates elsewhere hide
/// this latency.
template <typename Index, typename Visit>
__attribute__((always_inline)) inline void fromFourParts(Index count, Visit&& visit)
{
  const Index part = count / 4;
  for (Index i = 0; i < part; ++i)
  {
    visit(i);
    visit(i + part);
    visit(i + 2 * part);
    visit(i + 3 * part);
  }
  for (Index i = 4 * part; i < count; ++i)
  {
    visit(i);
  }
}

/// Calls visit(i + index * Part) for all indices from @p Index on, below @p Count. The stride is known to the
/// compiler: the indices take no registers.
template <int Part, int Index, int Count, typename Visit>
__attribute__((always_inline)) inline void visitStrided(int i, const Visit& visit)
{
  visit(i + Index * Part);
  if constexpr (Index + 1 < Count)
  {
    visitStrided<Part, Index + 1, Count>(i, visit);
  }
}

}
} // namespace simd
} // namespace pointhaptics
