/// @file
/// Part of VoxelKernelBody.h: from sums to means.
#pragma once

#include "Core/Resample/Kernel/Fetch.h"
#include "Core/Resample/Kernel/VoxelKernel.h"

namespace pointhaptics
{
namespace simd
{
namespace
{

/// Lists the lanes of a group that are not clear of the faces.
inline int listLanes(unsigned lanes, int first, int last, int* list, int found)
{
  for (; lanes != 0; lanes &= lanes - 1)
  {
    const int i = first + __builtin_ctz(lanes);
    if (i < last)
    {
      list[found++] = i;
    }
  }
  return found;
}

/// Stores the first of a vector's points, at most @p room.
template <class V, typename Real>
inline void storePoints(Real* to, int room, const typename V::Doubles xyz[3])
{
  if (room >= V::width)
  {
    V::storeInterleaved(to, xyz);
    return;
  }
  Real all[3 * kWidest];
  V::storeInterleaved(all, xyz);
  for (int i = 0; i < 3 * room; ++i)
  {
    to[i] = all[i];
  }
}

/// Stores the first of a vector's counts, at most @p room. Not by a mask: that takes as long as twenty stores
/// on Zen 3.
template <class V>
inline void storeCounts(std::int64_t* to, int room, typename V::Bits counts)
{
  if (room >= V::width)
  {
    V::storeCounts(to, counts);
    return;
  }
  std::int64_t all[kWidest];
  V::storeCounts(all, counts);
  for (int i = 0; i < room; ++i)
  {
    to[i] = all[i];
  }
}

/// a / n, correctly rounded, for counts n below 2^48. The product is within 2^-52 of a / n, relatively, and
/// what is corrected within 2^-103: no quotient by such an n is that near to the midpoint of two doubles.
template <class V>
inline typename V::Doubles divideByCount(
  typename V::Doubles a, typename V::Doubles n, typename V::Doubles reciprocal)
{
  if constexpr (V::hasFusedMultiply)
  {
    return V::corrected(V::multiply(a, reciprocal), a, n, reciprocal);
  }
  else
  {
    return V::quotient(a, n);
  }
}

/// The constants of MeanMap, in vectors.
template <class V>
struct MeanVectors
{
  using Doubles = typename V::Doubles;
  Doubles origin[3], spacing[3], quantum, one;
  // In quanta: from the lower face, and from there on to as much below the upper one.
  Doubles margin[3], clearance[3];

  explicit MeanVectors(const MeanMap& map)
    : quantum(V::all(map.quantum))
    , one(V::all(1.0))
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      origin[axis] = V::all(map.origin[axis]);
      spacing[axis] = V::all(map.spacing[axis]);
      const double width = 1.0 - 2.0 * map.faceMargin[axis];
      margin[axis] = V::all(map.faceMargin[axis] / map.quantum);
      clearance[axis] = V::all(width > 0.0 ? width / map.quantum : 0.0);
    }
  }
  /// Coordinates of a vector's means. Bit i of the result: that of voxel i is clear of the faces.
  unsigned mean(Doubles count, const Doubles sums[3], const Doubles indices[3], Doubles xyz[3]) const
  {
    const Doubles reciprocal = V::quotient(one, count);
    typename V::Mask clear = V::allTrue();
    for (int axis = 0; axis < 3; ++axis)
    {
      const Doubles fraction = divideByCount<V>(sums[axis], count, reciprocal);
      const Doubles u = V::multiplyAdd(fraction, quantum, indices[axis]);
      xyz[axis] = V::add(origin[axis], V::multiply(u, spacing[axis]));
      clear = V::below(clear, V::subtract(fraction, margin[axis]), clearance[axis]);
    }
    return V::toUnsigned(clear);
  }
};

template <class V, typename Real>
int means(const MeanMap& map, const MomentBatch<std::int64_t>& batch, Real* xyz, int* nearFace)
{
  const MeanVectors<V> constants(map);
  int found = 0;
  // Whole vectors: past the batch's end they work on what an earlier one left there.
  for (int i = 0; i < batch.size; i += V::width)
  {
    typename V::Doubles sums[3], indices[3], means[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      sums[axis] = V::fromInts(batch.sums[axis] + i);
      indices[axis] = V::fromInts(batch.indices[axis] + i);
    }
    const unsigned clear = constants.mean(V::fromInts(batch.counts + i), sums, indices, means);
    storePoints<V>(xyz + 3 * i, batch.size - i, means);
    if (clear != V::full)
    {
      found = listLanes(V::full & ~clear, i, batch.size, nearFace, found);
    }
  }
  return found;
}

template <class V, typename Real>
int packedMeans(const MeanMap& map, const CellMap& cellMap, const std::uint32_t* cells,
  const PackedSums* packed, int size, Real* xyz, std::int64_t* counts, int* nearFace)
{
  using Doubles = typename V::Doubles;
  const MeanVectors<V> constants(map);
  const Doubles columns = V::all(double(cellMap.columns));
  const Doubles perColumn = V::all(1.0 / double(cellMap.columns));
  const Doubles rows = V::all(double(cellMap.rowsPerLayer));
  const Doubles perLayer = V::all(1.0 / double(cellMap.rowsPerLayer));
  const Doubles firstRow = V::all(double(cellMap.firstRow));
  // The integer below a quotient a / b of integers, from 1 / b: the one nearest to (a + 1/2) / b - 1/2, which
  // rounding does not carry over a midpoint.
  const Doubles toColumn = V::all(0.5 / double(cellMap.columns) - 0.5);
  const Doubles toLayer = V::all(0.5 / double(cellMap.rowsPerLayer) - 0.5);
  constexpr int kAhead = 64; // The result is memory of another update, far away.
  int found = 0;
  for (int i = 0; i < size; i += V::width)
  {
    fetchToWrite(xyz + 3 * (i + kAhead), 3 * V::width * sizeof(Real));
    fetchToWrite(counts + i + kAhead, V::width * sizeof(std::int64_t));
    typename V::Bits lanes[4];
    V::loadPacked(packed + i, lanes);
    const typename V::Bits count = V::template rightBy<kCountShift>(lanes[3]);
    const typename V::Bits z = V::addBits(lanes[2], V::template left<kLowBits>(V::onlyPosition(lanes[3])));
    const typename V::Bits sumBits[3] = { lanes[0], lanes[1], z };
    const bool areSmall = V::areSmall(sumBits); // As most are.
    Doubles sums[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      sums[axis] = areSmall ? V::smallToDoubles(sumBits[axis]) : V::toDoubles(sumBits[axis]);
    }
    const Doubles cell = V::fromInts(reinterpret_cast<const std::int32_t*>(cells + i));
    const Doubles localRow = V::nearest(V::multiplyAdd(cell, perColumn, toColumn));
    const Doubles row = V::add(localRow, firstRow);
    const Doubles layer = V::nearest(V::multiplyAdd(row, perLayer, toLayer));
    const Doubles indices[3] = { V::subtract(cell, V::multiply(localRow, columns)),
      V::subtract(row, V::multiply(layer, rows)), layer };
    Doubles means[3];
    const unsigned clear = constants.mean(V::smallToDoubles(count), sums, indices, means);
    storePoints<V>(xyz + 3 * i, size - i, means);
    storeCounts<V>(counts + i, size - i, count);
    if (clear != V::full)
    {
      found = listLanes(V::full & ~clear, i, size, nearFace, found);
    }
  }
  return found;
}

}
} // namespace simd
} // namespace pointhaptics
