#include "Core/Resample/Stages/PointQuantizer.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace pointhaptics::simd
{
namespace
{

using Wide = long double;

/// Bits of a double below the highest.
constexpr int kDoubleBits = 52;

/// Solves T p = b by cofactors. Not by Eigen: one pivot of 170 would differ in its last bit, and positions
/// with it, for a few solutions a run.
void solve(const AffineTransform& transform, const Wide b[3], Wide p[3])
{
  const auto& m = transform.m;
  const auto cofactor = [&](int row, int column)
  {
    const int r0 = (row + 1) % 3;
    const int r1 = (row + 2) % 3;
    const int c0 = (column + 1) % 3;
    const int c1 = (column + 2) % 3;
    return Wide(m[r0][c0]) * Wide(m[r1][c1]) - Wide(m[r0][c1]) * Wide(m[r1][c0]);
  };
  const Wide determinant =
    Wide(m[0][0]) * cofactor(0, 0) + Wide(m[0][1]) * cofactor(0, 1) + Wide(m[0][2]) * cofactor(0, 2);
  for (int axis = 0; axis < 3; ++axis)
  {
    p[axis] = (cofactor(0, axis) * b[0] + cofactor(1, axis) * b[1] + cofactor(2, axis) * b[2]) / determinant;
  }
}

/// See compensatedDot() of QuantizeBody.h: the same operations in the same order, less those that change
/// nothing. @p left: what rounding takes from it.
double compensatedDot(const double row[3], const double p[3], double offset, double offsetRest, double& left)
{
  double sum = offset;
  double rest = offsetRest;
  for (int column = 0; column < 3; ++column)
  {
    if (row[column] == 0.0)
    {
      continue;
    }
    const double term = p[column] * row[column];
    rest += std::fma(p[column], row[column], -term);
    const double total = sum + term;
    const double added = total - sum;
    rest += (sum - (total - added)) + (term - added);
    sum = total;
  }
  const double v = sum + rest;
  left = (sum - v) + rest;
  return v;
}

/// Rounding error of a - b (Knuth).
double leftOfDifference(double a, double b)
{
  const double difference = a - b;
  const double back = difference - a;
  return (a - (difference - back)) - (b + back);
}

/// Where rounding p - pivot, the products and their sums could move a point inside by more than an eighth of
/// a quantum: under matrices of a large condition number.
bool needsCompensation(const AffineTransform& transform, const PointQuantizer& quantizer)
{
  constexpr Wide kRounding = 0x1p-50L; // of a term of the sum, in total
  constexpr Wide kMostLost = 0.125L;
  Wide largest[3] = { 0, 0, 0 }; // |p - pivot| of the points inside
  for (int axis = 0; axis < 3; ++axis)
  {
    Wide extent[3] = { 0, 0, 0 };
    Wide edge[3];
    extent[axis] =
      std::ldexp(Wide(quantizer.quantum[axis]), kPositionBits) + std::abs(Wide(quantizer.offset[axis]));
    solve(transform, extent, edge);
    for (int column = 0; column < 3; ++column)
    {
      largest[column] += std::abs(edge[column]);
    }
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    Wide terms = std::abs(Wide(quantizer.offset[axis]));
    for (int column = 0; column < 3; ++column)
    {
      terms += std::abs(Wide(transform.m[axis][column])) * largest[column];
    }
    if (!(kRounding * terms <= kMostLost * Wide(quantizer.quantum[axis])))
    {
      return true;
    }
  }
  return false;
}

/// Sets the transformed pivot, from the lattice's origin.
void setOffset(const AffineTransform& transform, const Lattice& lattice, PointQuantizer& quantizer)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    // Their difference in two words (Knuth).
    const double t = transform.m[axis][3];
    const double o = lattice.origin[axis];
    const double rest = leftOfDifference(t, o);
    double left = 0.0;
    quantizer.offset[axis] =
      compensatedDot(quantizer.matrix[axis], quantizer.pivot, t - o, rest, left) + 0.0; // never -0
    quantizer.offsetRest[axis] = rest;
  }
}

}

int indexBitsOf(const Lattice& lattice)
{
  const std::int64_t largest =
    std::max({ lattice.dimensions[0], lattice.dimensions[1], lattice.dimensions[2] });
  int bits = 0;
  while ((std::int64_t(1) << bits) < largest)
  {
    ++bits;
  }
  return bits;
}

int fractionBitsOf(const Lattice& lattice)
{
  const int indexBits = indexBitsOf(lattice);
  return (indexBits <= kMaximumIndexBits ? kPositionBits : kDoubleBits) - indexBits;
}

PointQuantizer makeQuantizer(const AffineTransform& transform, const Lattice& lattice)
{
  const int indexBits = indexBitsOf(lattice);
  PointQuantizer quantizer{};
  quantizer.motion = isDiagonal(transform.m) ? Motion::Scale : Motion::General;
  quantizer.fractionBits = fractionBitsOf(lattice);
  quantizer.correctsRounding = indexBits > kUncorrectedIndexBits;
  Wide toOrigin[3];
  Wide pivot[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    toOrigin[axis] = Wide(lattice.origin[axis]) - Wide(transform.m[axis][3]);
    pivot[axis] = toOrigin[axis] / Wide(transform.m[axis][axis]);
    std::copy(transform.m[axis], transform.m[axis] + 3, quantizer.matrix[axis]);
  }
  if (quantizer.motion == Motion::General)
  {
    solve(transform, toOrigin, pivot);
  }
  const bool finite =
    std::isfinite(double(pivot[0])) && std::isfinite(double(pivot[1])) && std::isfinite(double(pivot[2]));
  for (int axis = 0; axis < 3; ++axis)
  {
    quantizer.pivot[axis] = finite ? double(pivot[axis]) : 0.0;
  }
  setOffset(transform, lattice, quantizer);
  for (int axis = 0; axis < 3; ++axis)
  {
    const double quantum = std::ldexp(lattice.spacing[axis], -quantizer.fractionBits);
    quantizer.quantum[axis] = quantum;
    quantizer.reciprocal[axis] = 1.0 / quantum;
    quantizer.remainder[axis] = -std::fma(quantizer.reciprocal[axis], quantum, -1.0) / quantum;
    quantizer.limit[axis] = std::ldexp(
      std::min(double(lattice.dimensions[std::size_t(axis)]), lattice.end[axis]), quantizer.fractionBits);
  }
  if (indexBits > kMaximumIndexBits ||
    (quantizer.motion == Motion::General && needsCompensation(transform, quantizer)))
  {
    quantizer.motion = Motion::Compensated;
    std::fill(quantizer.pivot, quantizer.pivot + 3, 0.0);
    setOffset(transform, lattice, quantizer);
  }
  return quantizer;
}

bool hasOrdinarySpacing(const Lattice& lattice)
{
  constexpr double kTiny = 1e-150;
  constexpr double kHuge = 1e150;
  return std::all_of(&lattice.spacing.x, &lattice.spacing.x + 3,
    [](double spacing) { return spacing > kTiny && spacing < kHuge; });
}

namespace
{

/// @return the quantum that v and what rounding @p left of it lie in, near @p position; but no point changes
/// voxels.
std::uint64_t nearer(std::uint64_t position, double v, double left, double quantum)
{
  constexpr int kLeastFractionBits = 31; // The faces of all lattices are there.
  const double beyond = std::fma(-double(position), quantum, v) + left;
  const int more = (beyond >= quantum) + (beyond >= 2.0 * quantum) - (beyond < 0.0) - (beyond < -quantum);
  const std::uint64_t found = position + std::uint64_t(std::int64_t(more));
  return found >> kLeastFractionBits == position >> kLeastFractionBits ? found : position;
}

}

PointLocation quantizePoint(const PointQuantizer& quantizer, const Vec3& point, std::uint64_t position[3])
{
  constexpr std::uint64_t kMantissa = (std::uint64_t(1) << 52) - 1;
  const double p[3] = { point.x - quantizer.pivot[0], point.y - quantizer.pivot[1],
    point.z - quantizer.pivot[2] };
  bool inside = true;
  bool finite = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double* row = quantizer.matrix[axis];
    // The vector loops do these operations in this order.
    const double offset = quantizer.offset[axis];
    double left = 0.0;
    const double v = quantizer.motion == Motion::Compensated
      ? compensatedDot(row, p, offset, quantizer.offsetRest[axis], left)
      : quantizer.motion == Motion::General ? ((p[0] * row[0] + p[1] * row[1]) + p[2] * row[2]) + offset
                                            : p[axis] * row[axis] + offset;
    const double u = v / quantizer.quantum[axis];
    finite = finite && std::isfinite(v);
    inside = inside && v >= 0.0 && u < quantizer.limit[axis];
    const double rounded = u + kToBits;
    std::memcpy(&position[axis], &rounded, sizeof rounded);
    position[axis] = (position[axis] - (rounded - kToBits > u)) & kMantissa;
    if (quantizer.correctsRounding && inside)
    {
      position[axis] = nearer(position[axis], v, left, quantizer.quantum[axis]);
    }
  }
  return inside ? PointLocation::Inside : finite ? PointLocation::Outside : PointLocation::Invalid;
}

} // namespace pointhaptics::simd
