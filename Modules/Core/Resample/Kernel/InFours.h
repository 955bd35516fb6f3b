/// @file
/// Loops that are unrolled, in several orders. Internal linkage: sources of several instruction sets include
/// them.
#pragma once

namespace pointhaptics
{
namespace kernel
{
namespace
{

/// Calls visit(i) for all i below @p count.
template <typename Visit>
__attribute__((always_inline)) inline void inFours(int count, Visit&& visit)
{
  int i = 0;
  for (; i + 4 <= count; i += 4)
  {
    visit(i);
    visit(i + 1);
    visit(i + 2);
    visit(i + 3);
  }
  for (; i < count; ++i)
  {
    visit(i);
  }
}

/// The same from four places in turn. Neighbours in a scan are in one voxel and one partition, and what is
/// done to that waits for what was done before: others hide the wait.
template <typename Visit>
__attribute__((always_inline)) inline void fromFourPlaces(int count, Visit&& visit)
{
  const int part = count / 4;
  for (int i = 0; i < part; ++i)
  {
    visit(i);
    visit(i + part);
    visit(i + 2 * part);
    visit(i + 3 * part);
  }
  for (int i = 4 * part; i < count; ++i)
  {
    visit(i);
  }
}

/// Calls visit(i + place * Part) for all places from @p Place on, below @p Places. The compiler knows how far
/// apart they are: none takes a register.
template <int Part, int Place, int Places, typename Visit>
__attribute__((always_inline)) inline void visitPlaces(int i, const Visit& visit)
{
  visit(i + Place * Part);
  if constexpr (Place + 1 < Places)
  {
    visitPlaces<Part, Place + 1, Places>(i, visit);
  }
}

}
} // namespace kernel
} // namespace pointhaptics
