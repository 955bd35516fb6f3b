/// @file
/// The loops of VoxelKernel.h, written once over a class of vector operations. Included by one source file
/// per instruction set, each compiled with its own flags: everything here has internal linkage, and nothing
/// of the standard library is called, so that no function compiled for one set can stand in for another's.
#pragma once

#include "Core/Kernel/CellSumBody.h"
#include "Core/Kernel/CovarianceBody.h"
#include "Core/Kernel/MeanBody.h"
#include "Core/Kernel/PlacementBody.h"
#include "Core/Kernel/VoxelKernel.h"

namespace pointhaptics
{
namespace kernel
{
namespace
{

/// Widens the box by the transformed points that are finite, as AffineTransform::apply() rounds them.
template <class V, typename Real>
void bounds(const double matrix[3][4], const Real* xyz, std::int64_t count, double box[6])
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
  alignas(64) double lanes[kWidest];
  for (int axis = 0; axis < 3; ++axis)
  {
    V::store(lanes, low[axis]);
    for (int j = 0; j < V::width; ++j)
    {
      box[2 * axis] = lanes[j] < box[2 * axis] ? lanes[j] : box[2 * axis];
    }
    V::store(lanes, high[axis]);
    for (int j = 0; j < V::width; ++j)
    {
      box[2 * axis + 1] = lanes[j] > box[2 * axis + 1] ? lanes[j] : box[2 * axis + 1];
    }
  }
}

template <class V>
Kernels makeKernels()
{
  return { &partition<V, float>, &partition<V, double>, &cellsOf<V>, &mark<V>, &markCells, &V::number,
    &rank<V>, &accumulate<V>, &packedMeans<V, float>, &packedMeans<V, double>, &V::covariances,
    &means<V, float>, &means<V, double>, &bounds<V, float>, &bounds<V, double> };
}

}
} // namespace kernel
} // namespace pointhaptics
