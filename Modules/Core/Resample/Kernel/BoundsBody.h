/// @file
/// Part of VoxelKernelBody.h: the box of a cloud.
#pragma once

#include "Core/Base/PointBlocks.h"
#include "Core/Resample/Kernel/VoxelKernel.h"
#include "Core/Simd/Words.h"

#include <cstdint>

namespace pointhaptics::simd
{
namespace
{

/// Widens the box by the transformed points that are finite, as AffineTransform::apply() rounds them.
/// @tparam Diagonal: the other products are 0, and change nothing.
template <bool Diagonal, typename Real>
void boundsOfPacked(const double matrix[3][4], const Real* xyz, std::int64_t count, double box[6])
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
      moved[axis] =
        (Diagonal ? row[axis] * p[axis] : (row[0] * p[0] + row[1] * p[1]) + row[2] * p[2]) + row[3];
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
    double* const ends = box + 2 * (j % 3);
    ends[0] = low[j % 3][j / 3] < ends[0] ? low[j % 3][j / 3] : ends[0];
    ends[1] = high[j % 3][j / 3] > ends[1] ? high[j % 3][j / 3] : ends[1];
  }
}

template <typename Real>
void bounds(
  const double matrix[3][4], const Real* xyz, std::int64_t count, std::int64_t stride, double box[6])
{
  const auto ofPacked = isDiagonal(matrix) ? &boundsOfPacked<true, Real> : &boundsOfPacked<false, Real>;
  forPointBlocks(xyz, PointView(xyz, count, stride), 0, count,
    [&](const Real* some, std::int64_t size) { ofPacked(matrix, some, size, box); });
}

}
} // namespace pointhaptics::simd
