/// @file
/// Part of VoxelKernelBody.h: the box of a cloud.
#pragma once

#include "Core/Resample/Kernel/VoxelKernel.h"

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

/// Widens the box by the transformed points that are finite, as AffineTransform::apply() rounds them, one by
/// one.
template <class V, typename Real>
void boundsOfEach(const double matrix[3][4], const Real* xyz, std::int64_t count, double box[6])
{
  const double infinity = __builtin_inf();
  typename V::Doubles low[3], high[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    low[axis] = V::all(infinity);
    high[axis] = V::all(-infinity);
  }
  const auto include = [&](const Real* from)
  {
    typename V::Doubles p[3], moved[3];
    V::load(from, p[0], p[1], p[2]);
    // What is not finite makes the sum not a number.
    typename V::Doubles check =
      V::add(V::add(V::subtract(p[0], p[0]), V::subtract(p[1], p[1])), V::subtract(p[2], p[2]));
    for (int axis = 0; axis < 3; ++axis)
    {
      const double* row = matrix[axis];
      moved[axis] =
        V::add(V::add(V::add(V::multiply(V::all(row[0]), p[0]), V::multiply(V::all(row[1]), p[1])),
                 V::multiply(V::all(row[2]), p[2])),
          V::all(row[3]));
      check = V::add(check, V::subtract(moved[axis], moved[axis]));
    }
    const typename V::Mask valid = V::finite(check);
    for (int axis = 0; axis < 3; ++axis)
    {
      low[axis] = V::least(low[axis], V::choose(valid, moved[axis], low[axis]));
      high[axis] = V::most(high[axis], V::choose(valid, moved[axis], high[axis]));
    }
  };
  std::int64_t i = 0;
  for (; i + V::width <= count; i += V::width)
  {
    include(xyz + 3 * i);
  }
  if (i < count)
  {
    Real last[3 * kWidest];
    for (int j = 0; j < 3 * kWidest; ++j)
    {
      last[j] = Real(__builtin_nan(""));
    }
    for (std::int64_t j = 0; j < 3 * (count - i); ++j)
    {
      last[j] = xyz[3 * i + j];
    }
    include(last);
  }
  alignas(64) double lows[kWidest];
  alignas(64) double highs[kWidest];
  for (int axis = 0; axis < 3; ++axis)
  {
    V::store(lows, low[axis]);
    V::store(highs, high[axis]);
    for (int j = 0; j < V::width; ++j)
    {
      widen(box, axis, lows[j], highs[j]);
    }
  }
}

/// Points looked at together by plainBounds(): a multiple of the lanes of any vector.
constexpr std::int64_t kPlainPoints = 1024;

/// The box of kPlainPoints points as they are. @return false if not all are finite; then it is not valid.
template <int vectorBytes, typename Real>
inline bool plainBounds(const Real* xyz, double box[6])
{
  constexpr int kLanes = vectorBytes / int(sizeof(Real));
  static_assert(kPlainPoints % kLanes == 0, "there are no points past the last vectors");
  typedef Real Wide __attribute__((vector_size(vectorBytes)));
  typedef Real Unaligned __attribute__((vector_size(vectorBytes), aligned(sizeof(Real)), may_alias));
  // Three vectors hold x y z x y z ...: each lane stays with one axis.
  Wide low[3], high[3], check[3];
  for (int k = 0; k < 3; ++k)
  {
    low[k] = high[k] = reinterpret_cast<const Unaligned*>(xyz)[k];
    check[k] = Wide{};
  }
  for (std::int64_t i = 0; i < kPlainPoints; i += kLanes)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Wide x = reinterpret_cast<const Unaligned*>(xyz + 3 * i)[k];
      low[k] = x < low[k] ? x : low[k];
      high[k] = x > high[k] ? x : high[k];
      check[k] += x - x; // Not a number from the first that is not finite on.
    }
  }
  bool areFinite = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    box[2 * axis] = __builtin_inf();
    box[2 * axis + 1] = -__builtin_inf();
  }
  for (int i = 0; i < 3 * kLanes; ++i)
  {
    widen(box, i % 3, double(low[i / kLanes][i % kLanes]), double(high[i / kLanes][i % kLanes]));
    areFinite = areFinite && check[i / kLanes][i % kLanes] == Real(0);
  }
  return areFinite;
}

/// Widens a box by one transformed by a diagonal matrix and an offset: rounding keeps the order of numbers,
/// so the ends of its axes are those of the points in it. @return false, without that, if they are not
/// finite.
inline bool includeMoved(const double matrix[3][4], const double plain[6], double box[6])
{
  double moved[6];
  double check = 0.0;
  for (int i = 0; i < 6; ++i)
  {
    const double* row = matrix[i / 2];
    moved[i] = row[i / 2] * plain[i] + row[3];
    check += moved[i] - moved[i];
  }
  for (int i = 0; check == 0.0 && i < 6; ++i)
  {
    widen(box, i / 2, moved[i], moved[i]);
  }
  return check == 0.0;
}

/// Widens the box by the transformed points that are finite, as AffineTransform::apply() rounds them.
template <class V, typename Real>
void bounds(const double matrix[3][4], const Real* xyz, std::int64_t count, double box[6])
{
  const bool keepsAxes = isDiagonal(matrix);
  for (; keepsAxes && count >= kPlainPoints; xyz += 3 * kPlainPoints, count -= kPlainPoints)
  {
    double plain[6];
    if (!plainBounds<8 * V::width>(xyz, plain) || !includeMoved(matrix, plain, box))
    {
      boundsOfEach<V>(matrix, xyz, kPlainPoints, box);
    }
  }
  boundsOfEach<V>(matrix, xyz, count, box);
}

}
} // namespace simd
} // namespace pointhaptics
