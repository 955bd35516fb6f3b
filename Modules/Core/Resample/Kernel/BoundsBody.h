/// @file
/// Part of VoxelKernelBody.h: the box of a cloud.
#pragma once

#include "Core/Resample/Kernel/VoxelKernel.h"
#include "Core/Simd/Words.h"

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

/// Points looked at together by keptAxes(): whole vectors.
constexpr std::int64_t kBoxPoints = 1024;

/// Widens the box by kBoxPoints points under a diagonal matrix and an offset: rounding keeps the order of
/// numbers, so the ends of each axis are those of the points as they are, moved. @return false, without that,
/// if they are not finite.
template <typename Real>
inline bool keptAxes(const double matrix[3][4], const Real* xyz, double box[6])
{
  typedef Real Numbers __attribute__((vector_size(8 * kWidth)));
  typedef Real NumbersAt __attribute__((vector_size(8 * kWidth), aligned(sizeof(Real)), may_alias));
  constexpr int kInVector = 8 * kWidth / int(sizeof(Real));
  // Three vectors hold x y z x y z ...: each lane stays with one axis.
  const auto* at = reinterpret_cast<const NumbersAt*>(xyz);
  Numbers low[3] = { at[0], at[1], at[2] };
  Numbers high[3] = { at[0], at[1], at[2] };
  Numbers check[3] = {};
  for (std::int64_t i = 0; i < kBoxPoints / kInVector; ++i, at += 3)
  {
    for (int k = 0; k < 3; ++k)
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
  for (int i = 0; i < 3 * kInVector; ++i)
  {
    const double ends[2] = { double(low[i / kInVector][i % kInVector]),
      double(high[i / kInVector][i % kInVector]) };
    for (const double end : ends)
    {
      const double x = matrix[i % 3][i % 3] * end + matrix[i % 3][3];
      sum += x - x;
      widen(moved, i % 3, x, x);
    }
    sum += double(check[i / kInVector][i % kInVector]);
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
    // What is not finite makes the sum not a number.
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

template <typename Real>
void bounds(const double matrix[3][4], const Real* xyz, std::int64_t count, double box[6])
{
  const bool keepsAxes = isDiagonal(matrix);
  for (; keepsAxes && count >= kBoxPoints; xyz += 3 * kBoxPoints, count -= kBoxPoints)
  {
    if (!keptAxes(matrix, xyz, box))
    {
      boundsOfEach(matrix, xyz, kBoxPoints, box);
    }
  }
  boundsOfEach(matrix, xyz, count, box);
}

}
} // namespace simd
} // namespace pointhaptics
