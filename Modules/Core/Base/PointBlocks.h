/// @file
/// Ranges of points, and strided coordinates as blocks without gaps, for loops that read x y z interleaved.
#pragma once

#include "Core/Base/PointView.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace pointhaptics
{

/// Points [begin, end) of an array.
struct PointRange
{
  std::int64_t begin;
  std::int64_t end;
};

/// Points of a block, so few that a copy stays in the first cache.
constexpr std::int64_t kPointBlock = 1024;

/// Copies @p count points to @p block, which has room for one number more. @p last: whether nothing may lie
/// behind the last one's z.
template <typename Real>
void copyPoints(const Real* from, std::int64_t stride, std::int64_t count, bool last, Real* block)
{
  const std::int64_t wide = last ? count - 1 : count;
  for (std::int64_t i = 0; i < wide; ++i, from += stride)
  {
    // Four numbers are one load and one store; the next point covers the fourth.
    std::memcpy(block + 3 * i, from, 4 * sizeof(Real));
  }
  if (last && count > 0)
  {
    std::memcpy(block + 3 * wide, from, 3 * sizeof(Real));
  }
}

/// Calls body(xyz, count) for the points from @p begin to before @p end of @p size, in order: once with the
/// memory itself where points are not strided, else for copies of at most kPointBlock points. @p first: the
/// coordinates of point 0, as PointView::floats() or doubles(). Body may not keep the pointer.
template <typename Real, typename Body>
void forPointBlocks(
  const Real* first, const PointView& points, std::int64_t begin, std::int64_t end, Body&& body)
{
  const std::int64_t stride = points.stride();
  if (stride == 3)
  {
    body(first + 3 * begin, end - begin);
    return;
  }
  Real block[3 * kPointBlock + 1];
  for (; begin < end; begin += kPointBlock)
  {
    const std::int64_t count = std::min(end - begin, kPointBlock);
    copyPoints(first + stride * begin, stride, count, begin + count == points.size(), block);
    body(static_cast<const Real*>(block), count);
  }
}

} // namespace pointhaptics
