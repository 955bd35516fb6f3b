/// @file
/// The loops of FitKernel.h with the compiler's vectors of eight, whatever the machine makes of them.
/// Included by one source per instruction set; all is in an anonymous namespace, so that the linker cannot
/// choose one set's version for the others.
#pragma once

#include "Core/Kernel/FitKernel.h"

namespace pointhaptics
{
namespace kernel
{
namespace
{

using Eight = double __attribute__((vector_size(64)));
/// The same where it overlays eight numbers of an array.
using EightAt = double __attribute__((vector_size(64), may_alias));

/// The gate opens over the last part of its depth.
constexpr double kGateOpen = 0.7;

inline const EightAt& eight(const double* from)
{
  return *reinterpret_cast<const EightAt*>(from);
}

inline EightAt& eight(double* to)
{
  return *reinterpret_cast<EightAt*>(to);
}

/// True where a number of @p v, none of them below 0, is not 0.
inline bool anyAboveZero(const Eight& v)
{
  const Eight four = v + __builtin_shufflevector(v, v, 4, 5, 6, 7, 0, 1, 2, 3);
  const Eight two = four + __builtin_shufflevector(four, four, 2, 3, 0, 1, 6, 7, 4, 5);
  return two[0] + two[1] > 0.0;
}

/// The sums of eight vectors, each as ((v0 + v1) + (v2 + v3)) + ((v4 + v5) + (v6 + v7)).
inline Eight joinedEach(const Eight v[8])
{
  Eight pairs[4];
  for (int i = 0; i < 4; ++i)
  {
    const Eight& a = v[2 * i];
    const Eight& b = v[2 * i + 1];
    pairs[i] = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14) +
      __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
  }
  const auto halves = [](const Eight& a, const Eight& b)
  {
    return __builtin_shufflevector(a, b, 0, 1, 4, 5, 8, 9, 12, 13) +
      __builtin_shufflevector(a, b, 2, 3, 6, 7, 10, 11, 14, 15);
  };
  return halves(halves(pairs[0], pairs[1]), halves(pairs[2], pairs[3]));
}

/// The sum of each vector, as joinedEach() does it.
template <int N, int First = 0>
inline void joinEach(const Eight (&v)[N], double* to)
{
  constexpr int kCount = N - First < 8 ? N - First : 8;
  Eight part[8] = {};
#pragma GCC unroll 8
  for (int i = 0; i < 8; ++i)
  {
    if (i < kCount)
    {
      part[i] = v[First + i];
    }
  }
  const Eight sums = joinedEach(part);
#pragma GCC unroll 8
  for (int i = 0; i < 8; ++i)
  {
    if (i < kCount)
    {
      to[First + i] = sums[i];
    }
  }
  if constexpr (First + 8 < N)
  {
    joinEach<N, First + 8>(v, to);
  }
}

void appendRows(const FitBlock& block, const FitView& view, FitRows& rows)
{
  const double perRho = 1.0 / view.radius;
  const double perRho2 = perRho * perRho;
  const Eight zero = {};
  const Eight one = zero + 1.0;
  const double gateFrom = kGateOpen * view.gate;
  const double perGate = view.gate > 0.0 ? 1.0 / (view.gate - gateFrom) : 0.0;
  for (int i = 0; i < block.size; i += kFitLanes)
  {
    const Eight x = (eight(block.x + i) - view.origin.x) * perRho;
    const Eight y = (eight(block.y + i) - view.origin.y) * perRho;
    const Eight z = (eight(block.z + i) - view.origin.z) * perRho;
    const Eight e = x * x + y * y + z * z;
    const Eight inside = e < 1.0 ? one - e : zero;
    const Eight count = eight(block.count + i);
    // Most groups of a neighbourhood gathered with a margin lie inside; those that do not are cheap to leave
    // out.
    const Eight base2 = inside * inside;
    if (!anyAboveZero(base2))
    {
      continue;
    }
    const Eight u = x * view.a.x + y * view.a.y + z * view.a.z;
    const Eight v = x * view.b.x + y * view.b.y + z * view.b.z;
    const Eight h = x * view.normal.x + y * view.normal.y + z * view.normal.z;
    Eight weight = count * view.share;
    if (view.gate > 0.0)
    {
      const Eight above = h - (view.bend[0] * u * u + view.bend[1] * u * v + view.bend[2] * v * v);
      const Eight depth = view.twoSidedGate ? (above < 0.0 ? -above : above) : -above;
      const Eight raw = (depth - gateFrom) * perGate;
      const Eight low = raw > 0.0 ? raw : zero;
      const Eight t = low < 1.0 ? low : one;
      weight *= one - t * t * (3.0 - 2.0 * t);
    }
    const Eight base3 = base2 * inside;
    const Eight xx = eight(block.xx + i);
    const Eight xy = eight(block.xy + i);
    const Eight xz = eight(block.xz + i);
    const Eight yy = eight(block.yy + i);
    const Eight yz = eight(block.yz + i);
    const Eight zz = eight(block.zz + i);
    const Eight cax = (xx * view.a.x + xy * view.a.y + xz * view.a.z) * perRho2;
    const Eight cay = (xy * view.a.x + yy * view.a.y + yz * view.a.z) * perRho2;
    const Eight caz = (xz * view.a.x + yz * view.a.y + zz * view.a.z) * perRho2;
    const Eight cbx = (xx * view.b.x + xy * view.b.y + xz * view.b.z) * perRho2;
    const Eight cby = (xy * view.b.x + yy * view.b.y + yz * view.b.z) * perRho2;
    const Eight cbz = (xz * view.b.x + yz * view.b.y + zz * view.b.z) * perRho2;
    const int row = rows.size;
    eight(rows.u + row) = u;
    eight(rows.v + row) = v;
    eight(rows.uu + row) = u * u + (cax * view.a.x + cay * view.a.y + caz * view.a.z);
    eight(rows.uv + row) = u * v + (cax * view.b.x + cay * view.b.y + caz * view.b.z);
    eight(rows.vv + row) = v * v + (cbx * view.b.x + cby * view.b.y + cbz * view.b.z);
    eight(rows.height + row) = h;
    eight(rows.weight + row) = weight * (base2 * base2);
    eight(rows.slopeWeight + row) = 4.0 * weight * base3;
    eight(rows.e + row) = e;
    eight(rows.can + row) = cax * view.normal.x + cay * view.normal.y + caz * view.normal.z;
    eight(rows.cbn + row) = cbx * view.normal.x + cby * view.normal.y + cbz * view.normal.z;
    eight(rows.count + row) = count;
    rows.size += kFitLanes;
  }
}

void sumRows(const FitRows& rows, FitSums& sums)
{
  const Eight zero = {};
  const Eight one = zero + 1.0;
  Eight a[21] = {};
  Eight rhs[6] = {};
  Eight squares = zero;
  Eight cells = zero;
  for (int i = 0; i < rows.size; i += kFitLanes)
  {
    const Eight weight = eight(rows.weight + i);
    const Eight height = eight(rows.height + i);
    const Eight p[6] = { one, eight(rows.u + i), eight(rows.v + i), eight(rows.uu + i), eight(rows.uv + i),
      eight(rows.vv + i) };
    int at = 0;
#pragma GCC unroll 6
    for (int r = 0; r < 6; ++r)
    {
      const Eight wp = r == 0 ? weight : weight * p[r];
      rhs[r] += wp * height;
      a[at++] += wp;
#pragma GCC unroll 6
      for (int c = 1; c <= r; ++c)
      {
        a[at++] += wp * p[c];
      }
    }
    squares += weight * height * height;
    cells += weight > 0.0 ? one : zero;
  }
  joinEach(a, sums.a);
  const Eight others[8] = { rhs[0], rhs[1], rhs[2], rhs[3], rhs[4], rhs[5], squares, cells };
  const Eight joinedOthers = joinedEach(others);
  for (int i = 0; i < 6; ++i)
  {
    sums.rhs[i] = joinedOthers[i];
  }
  sums.zz = joinedOthers[6];
  sums.cells = joinedOthers[7];
}

/// The means over a cell of uuu, uuv, uvv and vvv, as far as its second moments tell them.
inline void cubicTerms(
  const Eight& u, const Eight& v, const Eight& uu, const Eight& uv, const Eight& vv, Eight q[4])
{
  // uuu = u^3 + 3 u Caa where Caa = uu - u^2, and so on.
  const Eight twoUv = 2.0 * uv;
  q[0] = u * (3.0 * uu - 2.0 * (u * u));
  q[1] = u * (twoUv - 2.0 * (u * v)) + v * uu;
  q[2] = v * (twoUv - 2.0 * (u * v)) + u * vv;
  q[3] = v * (3.0 * vv - 2.0 * (v * v));
}

/// The sums of the cubic terms @p First and the next one: two at a time, or the registers do not hold them.
template <int First>
inline void sumTwoCubicRows(const FitRows& rows, CubicSums& sums)
{
  constexpr int kProducts = 2 * First + 3;
  Eight qp[12] = {};
  Eight qq[kProducts] = {};
  Eight rhs[2] = {};
  for (int i = 0; i < rows.size; i += kFitLanes)
  {
    const Eight weight = eight(rows.weight + i);
    const Eight height = eight(rows.height + i);
    const Eight p[5] = { eight(rows.u + i), eight(rows.v + i), eight(rows.uu + i), eight(rows.uv + i),
      eight(rows.vv + i) };
    Eight q[4];
    cubicTerms(p[0], p[1], p[2], p[3], p[4], q);
    int at = 0;
#pragma GCC unroll 2
    for (int r = 0; r < 2; ++r)
    {
      const Eight wq = weight * q[First + r];
      rhs[r] += wq * height;
      qp[6 * r] += wq;
#pragma GCC unroll 5
      for (int c = 0; c < 5; ++c)
      {
        qp[6 * r + 1 + c] += wq * p[c];
      }
#pragma GCC unroll 4
      for (int c = 0; c <= First + r; ++c)
      {
        qq[at++] += wq * q[c];
      }
    }
  }
  joinEach(qp, sums.qp + 6 * First);
  joinEach(qq, sums.qq + First * (First + 1) / 2);
  joinEach(rhs, sums.rhs + First);
}

void sumCubicRows(const FitRows& rows, CubicSums& sums)
{
  sumTwoCubicRows<0>(rows, sums);
  sumTwoCubicRows<2>(rows, sums);
}

void traceRows(const FitRows& rows, const TracedFit& fit, double ra, double rb, TraceSums& sums)
{
  const double* k = fit.k;
  const double* x = fit.row;
  Eight moveA = {};
  Eight moveB = {};
  Eight turnA = {};
  Eight turnB = {};
  for (int i = 0; i < rows.size; i += kFitLanes)
  {
    const Eight u = eight(rows.u + i);
    const Eight v = eight(rows.v + i);
    const Eight h = eight(rows.height + i);
    const Eight uu = eight(rows.uu + i);
    const Eight uv = eight(rows.uv + i);
    const Eight vv = eight(rows.vv + i);
    const Eight can = eight(rows.can + i);
    const Eight cbn = eight(rows.cbn + i);
    Eight q[4];
    cubicTerms(u, v, uu, uv, vv, q);
    const Eight r = h -
      (k[0] + k[1] * u + k[2] * v + k[3] * uu + k[4] * uv + k[5] * vv + k[6] * q[0] + k[7] * q[1] +
        k[8] * q[2] + k[9] * q[3]);
    const Eight reach = x[0] + x[1] * u + x[2] * v + x[3] * uu + x[4] * uv + x[5] * vv + x[6] * q[0] +
      x[7] * q[1] + x[8] * q[2] + x[9] * q[3];
    // What the turning frame does to the cell's terms: u gains h as it turns along a, v as it turns along b.
    const Eight uh = u * h + can;
    const Eight vh = v * h + cbn;
    const Eight uuh = uu * h + 2.0 * (u * can);
    const Eight uvh = uv * h + (u * cbn + v * can);
    const Eight vvh = vv * h + 2.0 * (v * cbn);
    const Eight ka =
      k[1] * h + k[3] * (2.0 * uh) + k[4] * vh + k[6] * (3.0 * uuh) + k[7] * (2.0 * uvh) + k[8] * vvh;
    const Eight kb =
      k[2] * h + k[4] * uh + k[5] * (2.0 * vh) + k[7] * uuh + k[8] * (2.0 * uvh) + k[9] * (3.0 * vvh);
    const Eight xa =
      x[1] * h + x[3] * (2.0 * uh) + x[4] * vh + x[6] * (3.0 * uuh) + x[7] * (2.0 * uvh) + x[8] * vvh;
    const Eight xb =
      x[2] * h + x[4] * uh + x[5] * (2.0 * vh) + x[7] * uuh + x[8] * (2.0 * uvh) + x[9] * (3.0 * vvh);
    const Eight e = eight(rows.e + i);
    const Eight moved = 2.0 * eight(rows.slopeWeight + i) * r * reach;
    const Eight weight = eight(rows.weight + i);
    moveA += moved * (u + e * ra);
    moveB += moved * (v + e * rb);
    turnA += weight * (r * xa - reach * ka);
    turnB += weight * (r * xb - reach * kb);
  }
  const Eight all[4] = { moveA, moveB, turnA, turnB };
  double joinedAll[4];
  joinEach(all, joinedAll);
  sums.moveA = joinedAll[0];
  sums.moveB = joinedAll[1];
  sums.turnA = joinedAll[2];
  sums.turnB = joinedAll[3];
}

void sumPlaces(const FitBlock& block, const Vec3& origin, double radius, CentroidSums& sums)
{
  const double perRadius2 = 1.0 / (radius * radius);
  const Eight zero = {};
  const Eight one = zero + 1.0;
  Eight weights = zero;
  Eight place[3] = { zero, zero, zero };
  for (int i = 0; i < block.size; i += kFitLanes)
  {
    const Eight d[3] = { eight(block.x + i) - origin.x, eight(block.y + i) - origin.y,
      eight(block.z + i) - origin.z };
    const Eight e = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) * perRadius2;
    const Eight base = e < 1.0 ? one - e : zero;
    const Eight base2 = base * base;
    const Eight weight = eight(block.count + i) * (base2 * base2);
    weights += weight;
    for (int axis = 0; axis < 3; ++axis)
    {
      place[axis] += weight * d[axis];
    }
  }
  const Eight all[4] = { weights, place[0], place[1], place[2] };
  double joinedAll[4];
  joinEach(all, joinedAll);
  sums.weights = joinedAll[0];
  for (int axis = 0; axis < 3; ++axis)
  {
    sums.place[axis] = joinedAll[1 + axis];
  }
}

void sumField(const FieldBlock& block, const Vec3& position, double reach, FieldSums& sums)
{
  const double perReach2 = 1.0 / (reach * reach);
  const Eight zero = {};
  const Eight one = zero + 1.0;
  Eight weights = zero;
  Eight radius = zero;
  Eight gate = zero;
  Eight countRadius = zero;
  Eight proxyRadius = zero;
  Eight cubic = zero;
  Eight weightGradient[3] = { zero, zero, zero };
  Eight radiusGradient[3] = { zero, zero, zero };
  for (int i = 0; i < block.size; i += kFitLanes)
  {
    const Eight d[3] = { position.x - eight(block.x + i), position.y - eight(block.y + i),
      position.z - eight(block.z + i) };
    const Eight e = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) * perReach2;
    const Eight base = (e < 1.0 ? one - e : zero) * eight(block.present + i);
    const Eight base2 = base * base;
    const Eight weight = base2 * base;
    const Eight slope = base2 * (-6.0 * perReach2);
    const Eight value = eight(block.radius + i);
    weights += weight;
    radius += weight * value;
    gate += weight * eight(block.gate + i);
    countRadius += weight * eight(block.countRadius + i);
    proxyRadius += weight * eight(block.proxyRadius + i);
    cubic += weight * eight(block.cubic + i);
    for (int axis = 0; axis < 3; ++axis)
    {
      weightGradient[axis] += slope * d[axis];
      radiusGradient[axis] += slope * d[axis] * value;
    }
  }
  const Eight all[12] = { weights, radius, gate, countRadius, proxyRadius, cubic, weightGradient[0],
    weightGradient[1], weightGradient[2], radiusGradient[0], radiusGradient[1], radiusGradient[2] };
  double joinedAll[12];
  joinEach(all, joinedAll);
  sums.weights = joinedAll[0];
  sums.radius = joinedAll[1];
  sums.gate = joinedAll[2];
  sums.countRadius = joinedAll[3];
  sums.proxyRadius = joinedAll[4];
  sums.cubic = joinedAll[5];
  for (int axis = 0; axis < 3; ++axis)
  {
    sums.weightGradient[axis] = joinedAll[6 + axis];
    sums.radiusGradient[axis] = joinedAll[9 + axis];
  }
}

constexpr FitKernels kKernels = { appendRows, sumRows, sumCubicRows, traceRows, sumPlaces, sumField };

}
} // namespace kernel
} // namespace pointhaptics
