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

inline double joined(const Eight& v)
{
  return ((v[0] + v[1]) + (v[2] + v[3])) + ((v[4] + v[5]) + (v[6] + v[7]));
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
    if (joined(base2) == 0.0)
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
  for (int i = 0; i < 21; ++i)
  {
    sums.a[i] = joined(a[i]);
  }
  for (int i = 0; i < 6; ++i)
  {
    sums.rhs[i] = joined(rhs[i]);
  }
  sums.zz = joined(squares);
  sums.cells = joined(cells);
}

void traceRows(const FitRows& rows, const double* k, double ra, double rb, TraceSums& sums)
{
  Eight moveA[6] = {};
  Eight moveB[6] = {};
  Eight turnA[6] = {};
  Eight turnB[6] = {};
  const Eight one = Eight{} + 1.0;
  for (int i = 0; i < rows.size; i += kFitLanes)
  {
    const Eight u = eight(rows.u + i);
    const Eight v = eight(rows.v + i);
    const Eight h = eight(rows.height + i);
    const Eight p[6] = { one, u, v, eight(rows.uu + i), eight(rows.uv + i), eight(rows.vv + i) };
    const Eight r = h - (k[0] + k[1] * p[1] + k[2] * p[2] + k[3] * p[3] + k[4] * p[4] + k[5] * p[5]);
    // What the turning frame does to the cell's row P, and through it to its residual.
    const Eight uh = u * h + eight(rows.can + i);
    const Eight vh = v * h + eight(rows.cbn + i);
    const Eight kqa = k[1] * h + k[3] * (2.0 * uh) + k[4] * vh;
    const Eight kqb = k[2] * h + k[4] * uh + k[5] * (2.0 * vh);
    const Eight e = eight(rows.e + i);
    const Eight w = 2.0 * eight(rows.slopeWeight + i) * r;
    const Eight wa = w * (u + e * ra);
    const Eight wb = w * (v + e * rb);
    const Eight weight = eight(rows.weight + i);
    const Eight ta = weight * kqa;
    const Eight tb = weight * kqb;
#pragma GCC unroll 6
    for (int c = 0; c < 6; ++c)
    {
      moveA[c] += wa * p[c];
      moveB[c] += wb * p[c];
      turnA[c] -= ta * p[c];
      turnB[c] -= tb * p[c];
    }
    const Eight wr = weight * r;
    turnA[1] += wr * h;
    turnA[3] += wr * (2.0 * uh);
    turnA[4] += wr * vh;
    turnB[2] += wr * h;
    turnB[4] += wr * uh;
    turnB[5] += wr * (2.0 * vh);
  }
  for (int c = 0; c < 6; ++c)
  {
    sums.moveA[c] = joined(moveA[c]);
    sums.moveB[c] = joined(moveB[c]);
    sums.turnA[c] = joined(turnA[c]);
    sums.turnB[c] = joined(turnB[c]);
  }
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
  sums.weights = joined(weights);
  for (int axis = 0; axis < 3; ++axis)
  {
    sums.place[axis] = joined(place[axis]);
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
    for (int axis = 0; axis < 3; ++axis)
    {
      weightGradient[axis] += slope * d[axis];
      radiusGradient[axis] += slope * d[axis] * value;
    }
  }
  sums.weights = joined(weights);
  sums.radius = joined(radius);
  sums.gate = joined(gate);
  sums.countRadius = joined(countRadius);
  sums.proxyRadius = joined(proxyRadius);
  for (int axis = 0; axis < 3; ++axis)
  {
    sums.weightGradient[axis] = joined(weightGradient[axis]);
    sums.radiusGradient[axis] = joined(radiusGradient[axis]);
  }
}

constexpr FitKernels kKernels = { appendRows, sumRows, traceRows, sumPlaces, sumField };

}
} // namespace kernel
} // namespace pointhaptics
