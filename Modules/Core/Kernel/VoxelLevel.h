/// @file
/// The voxels of one lattice, as the partitions left them.
#pragma once

#include "Core/Executor.h"
#include "Core/Kernel/VoxelSink.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace pointhaptics
{
namespace kernel
{

/// So many partitions at once that threads find work to the end.
inline std::int64_t grainFor(std::int64_t count, const Executor& executor)
{
  return std::max<std::int64_t>(1, count / (16 * executor.concurrency()));
}

/// A partition's voxels: where they are in the arena and in the result.
struct Segment
{
  std::size_t place = 0;
  std::size_t size = 0;
  std::int64_t first = 0;
};

/// The voxels of one lattice.
struct Level
{
  Lattice lattice;
  MeanArena arena;
  std::vector<Segment> segments;
  std::int64_t size = 0;
  std::vector<std::int64_t> parents;

  void number()
  {
    size = 0;
    for (Segment& segment : segments)
    {
      segment.first = size;
      size += std::int64_t(segment.size);
    }
  }
};

/// Joins the partitions' pieces of an array in the arena.
template <typename T>
void copySegments(const Level& level, const T* from, std::size_t components, T* to, const Executor& executor)
{
  const auto segments = std::int64_t(level.segments.size());
  forRange(executor, segments, grainFor(segments, executor),
    [&](std::int64_t begin, std::int64_t end)
    {
      for (auto s = std::size_t(begin); s < std::size_t(end); ++s)
      {
        const Segment& segment = level.segments[s];
        const T* first = from + components * segment.place;
        std::copy(first, first + components * segment.size, to + components * std::size_t(segment.first));
      }
    });
}

} // namespace kernel
} // namespace pointhaptics
