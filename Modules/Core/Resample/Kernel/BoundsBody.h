/// @file
/// Part of VoxelKernelBody.h: the box of a cloud.
#pragma once

#include "Core/Base/PointBlocks.h"
#include "Core/Resample/Kernel/VoxelKernel.h"
#include "Core/Simd/Words.h"

#include <algorithm>
#include <cstdint>

namespace pointhaptics
{
namespace simd
{
namespace
{

inline void widen(double box[6], int axis, double low, double high)
{
  box[2 * axis] = low < box[2 * axis] ? low : box[2 * axis];
  box[2 * axis + 1] = high > box[2 * axis + 1] ? high : box[2 * axis + 1];
}

/// Most points looked at together by keptAxes().
constexpr std::int64_t kBoxPoints = 1024;
/// It takes whole vectors.
template <typename Real>
constexpr std::int64_t kInVector = 8 * kWidth / std::int64_t(sizeof(Real));

/// Widens the box by @p count points, at least one vector, under a diagonal matrix and an offset: rounding
/// keeps the order of numbers, so the ends of each axis are those of the points as they are, moved. @return
/// false, without that, if they are not finite. A point is @p Stride numbers, 3 or 4, of which the last is
/// skipped.
template <int Stride, typename Real>
inline bool keptAxes(const double matrix[3][4], const Real* xyz, std::int64_t count, double box[6])
{
  typedef Real Numbers __attribute__((vector_size(8 * kWidth)));
  typedef Real NumbersAt __attribute__((vector_size(8 * kWidth), aligned(sizeof(Real)), may_alias));
  constexpr int kInOne = int(kInVector<Real>);
  // So many vectors hold x y z x y z ... of whole points: each lane stays with one axis.
  const auto* at = reinterpret_cast<const NumbersAt*>(xyz);
  Numbers low[Stride];
  Numbers high[Stride];
  Numbers check[Stride] = {};
  for (int k = 0; k < Stride; ++k)
  {
    low[k] = high[k] = at[k];
  }
  for (std::int64_t i = 0; i < count / kInOne; ++i, at += Stride)
  {
    for (int k = 0; k < Stride; ++k)
    {
      const Numbers x = at[k];
      low[k] = x < low[k] ? x : low[k];
      high[k] = x > high[k] ? x : high[k];
      check[k] += x - x; // Not a number from the first that is not finite on.
    }
  }
  double moved[6] = { __builtin_inf(), -__builtin_inf(), __builtin_inf(), -__builtin_inf(), __builtin_inf(),
    -__builtin_inf() };
  double sum = 0.0;
  for (int i = 0; i < Stride * kInOne; ++i)
  {
    const int axis = i % Stride;
    if (axis == 3)
    {
      continue;
    }
    const double ends[2] = { double(low[i / kInOne][i % kInOne]), double(high[i / kInOne][i % kInOne]) };
    for (const double end : ends)
    {
      const double x = matrix[axis][axis] * end + matrix[axis][3];
      sum += x - x;
      widen(moved, axis, x, x);
    }
    sum += double(check[i / kInOne][i % kInOne]);
  }
  for (int axis = 0; sum == 0.0 && axis < 3; ++axis)
  {
    widen(box, axis, moved[2 * axis], moved[2 * axis + 1]);
  }
  return sum == 0.0;
}

/// Widens the box by the transformed points that are finite, as AffineTransform::apply() rounds them, each.
template <typename Real>
void boundsOfEach(const double matrix[3][4], const Real* xyz, std::int64_t count, double box[6])
{
  Pack low[3], high[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    low[axis] = all(__builtin_inf());
    high[axis] = all(-__builtin_inf());
  }
  const auto include = [&](const Real* from)
  {
    Pack p[3], moved[3];
    loadPoints(from, p);
    // A coordinate that is not finite makes the sum NaN.
    Pack check = (p[0] - p[0]) + (p[1] - p[1]) + (p[2] - p[2]);
    for (int axis = 0; axis < 3; ++axis)
    {
      const double* row = matrix[axis];
      moved[axis] = ((row[0] * p[0] + row[1] * p[1]) + row[2] * p[2]) + row[3];
      check += moved[axis] - moved[axis];
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      // Not a number: neither is chosen.
      low[axis] = smaller(moved[axis] + check, low[axis]);
      high[axis] = larger(moved[axis] + check, high[axis]);
    }
  };
  for (; count >= kWidth; count -= kWidth, xyz += 3 * kWidth)
  {
    include(xyz);
  }
  for (; count > 0; --count, xyz += 3)
  {
    Real one[3 * kWidth];
    for (int j = 0; j < 3 * kWidth; ++j)
    {
      one[j] = xyz[j % 3];
    }
    include(one);
  }
  for (int j = 0; j < 3 * kWidth; ++j)
  {
    const int axis = j % 3;
    widen(box, axis, low[axis][j / 3], high[axis][j / 3]);
  }
}

/// Leaves points that fill no vector.
template <int Stride, typename Real>
void boundsOfBlocks(const double matrix[3][4], const Real*& xyz, std::int64_t& count, double box[6])
{
  const auto blockOf = [](std::int64_t points)
  { return std::min(kBoxPoints, points / kInVector<Real> * kInVector<Real>); };
  constexpr std::int64_t kUnread = Stride - 3; // nothing may lie behind the last one's z
  for (std::int64_t block; (block = blockOf(count - kUnread)) > 0; xyz += Stride * block, count -= block)
  {
    if (!keptAxes<Stride>(matrix, xyz, block, box))
    {
      forPointBlocks(xyz, PointView(xyz, count, Stride), 0, block,
        [&](const Real* some, std::int64_t size) { boundsOfEach(matrix, some, size, box); });
    }
  }
}

template <typename Real>
void boundsOfPacked(const double matrix[3][4], const Real* xyz, std::int64_t count, double box[6])
{
  if (isDiagonal(matrix))
  {
    boundsOfBlocks<3>(matrix, xyz, count, box);
  }
  boundsOfEach(matrix, xyz, count, box);
}

template <typename Real>
void bounds(
  const double matrix[3][4], const Real* xyz, std::int64_t count, std::int64_t stride, double box[6])
{
  if (stride == 4 && isDiagonal(matrix))
  {
    boundsOfBlocks<4>(matrix, xyz, count, box);
  }
  forPointBlocks(xyz, PointView(xyz, count, stride), 0, count,
    [&](const Real* some, std::int64_t size) { boundsOfPacked(matrix, some, size, box); });
}

}
} // namespace simd
} // namespace pointhaptics
