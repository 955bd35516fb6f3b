/// @file
/// The loops of FitKernel.h over Simd/Packs.h, whatever the width of a pack. Included by one source per
/// instruction set; all is in an anonymous namespace, so that the linker cannot choose one set's version for
/// the others.
#pragma once

#include "Core/Simd/Packs.h"
#include "Core/Surface/FitKernel.h"

#include <cmath>

namespace pointhaptics
{
namespace simd
{
namespace
{

static_assert(kFitLanes == simd::kLanes, "the blocks are laid out for the loops");

/// The gate opens over the last part of its depth, from this fraction on.
constexpr double kGateOpen = 0.7;

/// Returns 2 x by an addition: most of these loops wait for multiplications.
inline Pack twice(const Pack& x)
{
  return x + x;
}

/// Returns 1 - e, and 0 beyond the radius.
inline Pack inside(const Pack& e)
{
  return e < 1.0 ? 1.0 - e : simd::all(0.0);
}

/// Offsets of cells from the origin, over the radius.
struct Offsets
{
  Pack x;
  Pack y;
  Pack z;
  Pack e; ///< Sum of their squares.
};

inline Offsets offsetsOf(const FitBlock& block, int i, const Vec3& origin, double perRho)
{
  Offsets d;
  d.x = (load(block.x + i) - origin.x) * perRho;
  d.y = (load(block.y + i) - origin.y) * perRho;
  d.z = (load(block.z + i) - origin.z) * perRho;
  d.e = d.x * d.x + d.y * d.y + d.z * d.z;
  return d;
}

/// Fraction of a cell's weight that passes the gate; @p h its height.
inline Pack throughGate(
  const FitView& view, double gateFrom, double perGate, const Pack& u, const Pack& v, const Pack& h)
{
  const Pack above = h - (view.bend[0] * u * u + view.bend[1] * u * v + view.bend[2] * v * v);
  const Pack depth = view.twoSidedGate ? (above < 0.0 ? -above : above) : -above;
  const Pack raw = (depth - gateFrom) * perGate;
  const Pack t = simd::smaller(simd::larger(raw, simd::all(0.0)), simd::all(1.0));
  return 1.0 - t * t * (3.0 - twice(t));
}

/// Writes the pack of rows from @p row on, for the cells from @p i on.
inline void makeRows(
  const FitBlock& block, const FitView& view, const Offsets& d, int i, FitRows& rows, int row)
{
  const double perRho = 1.0 / view.radius;
  const double perRho2 = perRho * perRho;
  const double gateFrom = kGateOpen * view.gate;
  const double perGate = view.gate > 0.0 ? 1.0 / (view.gate - gateFrom) : 0.0;
  const Pack base = inside(d.e);
  const Pack base2 = base * base;
  const Pack count = load(block.count + i);
  const Pack u = d.x * view.a.x + d.y * view.a.y + d.z * view.a.z;
  const Pack v = d.x * view.b.x + d.y * view.b.y + d.z * view.b.z;
  const Pack h = d.x * view.normal.x + d.y * view.normal.y + d.z * view.normal.z;
  Pack weight = count * view.blendWeight;
  if (view.gate > 0.0)
  {
    weight *= throughGate(view, gateFrom, perGate, u, v, h);
  }
  const Pack xx = load(block.xx + i);
  const Pack xy = load(block.xy + i);
  const Pack xz = load(block.xz + i);
  const Pack yy = load(block.yy + i);
  const Pack yz = load(block.yz + i);
  const Pack zz = load(block.zz + i);
  const Pack cax = (xx * view.a.x + xy * view.a.y + xz * view.a.z) * perRho2;
  const Pack cay = (xy * view.a.x + yy * view.a.y + yz * view.a.z) * perRho2;
  const Pack caz = (xz * view.a.x + yz * view.a.y + zz * view.a.z) * perRho2;
  const Pack cbx = (xx * view.b.x + xy * view.b.y + xz * view.b.z) * perRho2;
  const Pack cby = (xy * view.b.x + yy * view.b.y + yz * view.b.z) * perRho2;
  const Pack cbz = (xz * view.b.x + yz * view.b.y + zz * view.b.z) * perRho2;
  simd::store(rows.u + row, u);
  simd::store(rows.v + row, v);
  simd::store(rows.uu + row, u * u + (cax * view.a.x + cay * view.a.y + caz * view.a.z));
  simd::store(rows.uv + row, u * v + (cax * view.b.x + cay * view.b.y + caz * view.b.z));
  simd::store(rows.vv + row, v * v + (cbx * view.b.x + cby * view.b.y + cbz * view.b.z));
  simd::store(rows.height + row, h);
  simd::store(rows.weight + row, weight * (base2 * base2));
  simd::store(rows.slopeWeight + row, twice(twice(weight)) * (base2 * base));
  simd::store(rows.e + row, d.e);
  simd::store(rows.can + row, cax * view.normal.x + cay * view.normal.y + caz * view.normal.z);
  simd::store(rows.cbn + row, cbx * view.normal.x + cby * view.normal.y + cbz * view.normal.z);
  simd::store(rows.count + row, count);
}

void appendRows(const FitBlock& block, const FitView& whole, FitRows& rows)
{
  // The compiler knows that stores to the rows cannot change this copy.
  const FitView view = whole;
  const double perRho = 1.0 / view.radius;
  int row = rows.size;
  for (int i = 0; i < block.size; i += kFitLanes)
  {
    Offsets d[simd::kPacks];
    bool isAnyInside = false;
#pragma GCC unroll 4
    for (int pack = 0; pack < simd::kPacks; ++pack)
    {
      d[pack] = offsetsOf(block, i + pack * simd::kWidth, view.origin, perRho);
      isAnyInside |= simd::belowBits(d[pack].e, 1.0) != 0;
    }
    // Most groups of a neighbourhood gathered with a margin lie inside; the others are cheap to skip.
    if (!isAnyInside)
    {
      continue;
    }
#pragma GCC unroll 1
    for (int pack = 0; pack < simd::kPacks; ++pack)
    {
      const int lane = pack * simd::kWidth;
      makeRows(block, view, d[pack], i + lane, rows, row + lane);
    }
    row += kFitLanes;
  }
  rows.size = row;
}

/// Means over a cell of uuu, uuv, uvv and vvv, as far as its second moments determine them.
inline void cubicTerms(
  const Pack& u, const Pack& v, const Pack& uu, const Pack& uv, const Pack& vv, Pack q[4])
{
  // uuu = u^3 + 3 u Caa where Caa = uu - u^2, and so on.
  const Pack twoUv = twice(uv);
  q[0] = u * (3.0 * uu - twice(u * u));
  q[1] = u * (twoUv - twice(u * v)) + v * uu;
  q[2] = v * (twoUv - twice(u * v)) + u * vv;
  q[3] = v * (3.0 * vv - twice(v * v));
}

/// Sums the terms from @p First to before @p Last, as many as fit in registers; those up to the last
/// quadratic one add the other sums.
template <int First, int Last>
inline void sumTermRows(const FitRows& rows, FitSums& sums)
{
  constexpr bool kAddsOthers = Last == 6;
  constexpr int kBegin = First * (First + 1) / 2;
  constexpr int kSquares = Last * (Last + 1) / 2 - kBegin;
  // A group that is copied together begins with a pack: loads across two packs would wait until these are in
  // memory.
  constexpr int kRhs = simd::wholePacks(kSquares);
  constexpr int kOthers = kRhs + Last - First;
  constexpr int kSums = kOthers + (kAddsOthers ? 2 : 0);
  const simd::LaneSums<kSums> to = simd::sumLanes<kSums>(rows.size,
    [&](int i, Pack(&s)[kSums])
    {
      const Pack weight = load(rows.weight + i);
      const Pack height = load(rows.height + i);
      const double* const p[6] = { nullptr, rows.u + i, rows.v + i, rows.uu + i, rows.uv + i, rows.vv + i };
      Pack q[4];
      if constexpr (Last > 6)
      {
        cubicTerms(load(p[1]), load(p[2]), load(p[3]), load(p[4]), load(p[5]), q);
      }
      int at = 0;
#pragma GCC unroll 10
      for (int r = First; r < Last; ++r)
      {
        const Pack wt = r == 0 ? weight : weight * (r < 6 ? load(p[r]) : q[r - 6]);
        s[kRhs + r - First] += wt * height;
        s[at++] += wt;
#pragma GCC unroll 10
        for (int c = 1; c <= r; ++c)
        {
          s[at++] += wt * (c < 6 ? load(p[c]) : q[c - 6]);
        }
      }
      if constexpr (kAddsOthers)
      {
        s[kOthers] += weight * height * height;
        s[kOthers + 1] += weight > 0.0 ? simd::all(1.0) : simd::all(0.0);
      }
    });
  for (int i = 0; i < kSquares; ++i)
  {
    sums.a[kBegin + i] = to[i];
  }
  for (int i = First; i < Last; ++i)
  {
    sums.rhs[i] = to[kRhs + i - First];
  }
  if constexpr (kAddsOthers)
  {
    sums.zz = to[kOthers];
    sums.cells = to[kOthers + 1];
  }
}

void sumRows(const FitRows& rows, FitSums& sums)
{
  sumTermRows<0, 4>(rows, sums);
  sumTermRows<4, 6>(rows, sums);
}

void sumCubicRows(const FitRows& rows, FitSums& sums)
{
  sumTermRows<6, 7>(rows, sums);
  sumTermRows<7, 8>(rows, sums);
  sumTermRows<8, 9>(rows, sums);
  sumTermRows<9, 10>(rows, sums);
}

void traceRows(const FitRows& rows, const TracedFit& fit, double ra, double rb, TraceSums& sums)
{
  const simd::LaneSums<4> to = simd::sumLanes<4>(rows.size,
    [&](int i, Pack(&s)[4])
    {
      const Pack u = load(rows.u + i);
      const Pack v = load(rows.v + i);
      const Pack h = load(rows.height + i);
      const Pack uu = load(rows.uu + i);
      const Pack uv = load(rows.uv + i);
      const Pack vv = load(rows.vv + i);
      const Pack can = load(rows.can + i);
      const Pack cbn = load(rows.cbn + i);
      Pack q[4];
      cubicTerms(u, v, uu, uv, vv, q);
      const auto height = [&](const double* k)
      {
        return k[0] + k[1] * u + k[2] * v + k[3] * uu + k[4] * uv + k[5] * vv + k[6] * q[0] + k[7] * q[1] +
          k[8] * q[2] + k[9] * q[3];
      };
      const Pack r = h - height(fit.k);
      const Pack reach = height(fit.row);
      // The turning frame changes the cell's terms: u gains h as it turns along a, v as it turns along b.
      const Pack uh = u * h + can;
      const Pack vh = v * h + cbn;
      const Pack uuh = uu * h + twice(u * can);
      const Pack uvh = uv * h + (u * cbn + v * can);
      const Pack vvh = vv * h + twice(v * cbn);
      const auto alongA = [&](const double* k) {
        return k[1] * h + k[3] * twice(uh) + k[4] * vh + k[6] * (3.0 * uuh) + k[7] * twice(uvh) + k[8] * vvh;
      };
      const auto alongB = [&](const double* k) {
        return k[2] * h + k[4] * uh + k[5] * twice(vh) + k[7] * uuh + k[8] * twice(uvh) + k[9] * (3.0 * vvh);
      };
      const Pack e = load(rows.e + i);
      const Pack moved = twice(load(rows.slopeWeight + i)) * r * reach;
      const Pack weight = load(rows.weight + i);
      s[0] += moved * (u + e * ra);
      s[1] += moved * (v + e * rb);
      s[2] += weight * (r * alongA(fit.row) - reach * alongA(fit.k));
      s[3] += weight * (r * alongB(fit.row) - reach * alongB(fit.k));
    });
  sums.moveA = to[0];
  sums.moveB = to[1];
  sums.turnA = to[2];
  sums.turnB = to[3];
}

/// @param reach2 of the group of points that begins at an index: squared distances that are within.
template <typename Reach2>
int within(const BallPoints& points, const Vec3& p, const Reach2& reach2, int* indices, int most)
{
  int found = 0;
  for (int i = 0; i < points.size && found < most; i += simd::kWidth)
  {
    const Pack dx = load(points.x + i) - p.x;
    const Pack dy = load(points.y + i) - p.y;
    const Pack dz = load(points.z + i) - p.z;
    const Pack beyond = dx * dx + dy * dy + dz * dz - reach2(i);
    for (unsigned int bits = simd::belowBits(beyond, 0.0); bits != 0 && found < most; bits &= bits - 1)
    {
      indices[found++] = i + __builtin_ctz(bits);
    }
  }
  return found;
}

int pointsWithin(const BallPoints& points, const Vec3& p, double radius2, int* indices, int most)
{
  return within(
    points, p, [radius2](int) { return simd::all(radius2); }, indices, most);
}

int ballsWithin(const BallPoints& points, const Vec3& p, double scale, double extra, int* indices, int most)
{
  const auto reach2 = [&](int i)
  {
    const Pack reach = load(points.radius + i) * scale + extra;
    return reach * reach;
  };
  return within(points, p, reach2, indices, most);
}

double sweepBall(const BallPoints& points, const Vec3& from, const Vec3& direction, double length,
  double scale, double tangential)
{
  // The tolerance is far above rounding: no point that could be met first is left out.
  constexpr double kRounding = 1e-9;
  double reached = length;
  for (int i = 0; i < points.size; i += simd::kWidth)
  {
    const Pack dx = load(points.x + i) - from.x;
    const Pack dy = load(points.y + i) - from.y;
    const Pack dz = load(points.z + i) - from.z;
    const Pack radius = load(points.radius + i) * scale;
    const Pack radius2 = radius * radius;
    const Pack along = dx * direction.x + dy * direction.y + dz * direction.z;
    // At t the ball is sqrt(outside + r^2 - along^2 + (t - along)^2) from the point.
    const Pack outside = dx * dx + dy * dy + dz * dz - radius2;
    const Pack across = outside - along * along;
    // A point ahead that the ball does not cover at the place reached so far is met later.
    const Pack there =
      outside + reached * (reached - 2.0 * along) - kRounding * (radius2 + reached * reached);
    const Pack isLater = along > reached ? there : simd::all(-1.0);
    const Pack isAhead = along > tangential * radius ? across : simd::all(1.0);
    const Pack missed = isLater < 0.0 ? isAhead : simd::all(1.0);
    for (unsigned int bits = simd::belowBits(missed, 0.0); bits != 0; bits &= bits - 1)
    {
      const int lane = __builtin_ctz(bits);
      const double t = outside[lane] / (along[lane] + std::sqrt(-across[lane]));
      reached = t < reached ? t : reached;
    }
  }
  return reached > 0.0 ? reached : 0.0;
}

void sumField(const FieldBlock& block, const Vec3& position, double reach, FieldSums& sums)
{
  const double perReach2 = 1.0 / (reach * reach);
  constexpr int kGradients = 1 + kFieldValues;
  constexpr int kSums = kGradients + 6;
  const simd::LaneSums<kSums> to = simd::sumLanes<kSums>(block.size,
    [&](int i, Pack(&s)[kSums])
    {
      const Pack d[3] = { position.x - load(block.x + i), position.y - load(block.y + i),
        position.z - load(block.z + i) };
      const Pack e = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) * perReach2;
      const Pack base = inside(e) * load(block.present + i);
      const Pack base2 = base * base;
      const Pack weight = base2 * base;
      const Pack slope = base2 * (-6.0 * perReach2);
      s[0] += weight;
#pragma GCC unroll 6
      for (int v = 0; v < kFieldValues; ++v)
      {
        s[1 + v] += weight * load(block.values[v] + i);
      }
#pragma GCC unroll 3
      for (int axis = 0; axis < 3; ++axis)
      {
        s[kGradients + axis] += slope * d[axis];
        s[kGradients + 3 + axis] += slope * d[axis] * load(block.values[0] + i);
      }
    });
  sums.weights = to[0];
  for (int v = 0; v < kFieldValues; ++v)
  {
    sums.values[v] = to[1 + v];
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    sums.weightGradient[axis] = to[kGradients + axis];
    sums.radiusGradient[axis] = to[kGradients + 3 + axis];
  }
}

constexpr FitKernels kKernels = { appendRows, sumRows, sumCubicRows, traceRows, pointsWithin, ballsWithin,
  sweepBall, sumField };

}
} // namespace simd
} // namespace pointhaptics
