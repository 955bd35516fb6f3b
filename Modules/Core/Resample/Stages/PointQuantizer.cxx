#include "Core/Resample/Stages/PointQuantizer.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics::simd
{
namespace
{

/// A row of the matrix times a point, and the offset, in two words: see compensatedDot() of QuantizeBody.h.
double compensatedDot(const double row[3], const double p[3], double offset, double offsetRest)
{
  double sum = offset;
  double rest = offsetRest;
  for (int column = 0; column < 3; ++column)
  {
    const double term = p[column] * row[column];
    rest += std::fma(p[column], row[column], -term);
    const double total = sum + term;
    const double added = total - sum;
    rest += (sum - (total - added)) + (term - added);
    sum = total;
  }
  return sum + rest;
}

/// True if the rounding of M (p - pivot) + offset could move a point of the lattice by more than an eighth of
/// a quantum, as under matrices of a large condition number.
bool needsCompensation(const AffineTransform& inverse, const PointQuantizer& quantizer)
{
  constexpr double kRounding = 0x1p-50;   // of all operations of a row, over the sum of its terms'
                                          // magnitudes: 8 units in the last place
  constexpr double kLargestError = 0.125; // quanta
  double largest[3] = { 0, 0, 0 };        // |p - pivot| of points of the lattice, at most
  for (int axis = 0; axis < 3; ++axis)
  {
    const double extent =
      std::ldexp(quantizer.quantum[axis], kPositionBits) + std::abs(quantizer.offset[axis]);
    for (int column = 0; column < 3; ++column)
    {
      largest[column] += std::abs(inverse.m[column][axis]) * extent;
    }
  }
  return !std::all_of(quantizer.matrix, quantizer.matrix + 3,
    [&](const auto& row)
    {
      const std::ptrdiff_t axis = &row - quantizer.matrix;
      double terms = std::abs(quantizer.offset[axis]);
      for (int column = 0; column < 3; ++column)
      {
        terms += std::abs(row[column]) * largest[column];
      }
      return kRounding * terms <= kLargestError * quantizer.quantum[axis];
    });
}

/// Sets the pivot, and where it is mapped, from the lattice's origin.
void setPivot(const AffineTransform& transform, const Lattice& lattice, const Vec3& pivot, PointQuantizer& to)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    to.pivot[axis] = isFinite(pivot) ? pivot[axis] : 0.0;
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    // The difference of t and o in two words (Knuth).
    const double t = transform.m[axis][3];
    const double o = lattice.origin[axis];
    const double difference = t - o;
    const double back = difference - t;
    to.offsetRest[axis] = (t - (difference - back)) - (o + back);
    to.offset[axis] =
      compensatedDot(to.matrix[axis], to.pivot, difference, to.offsetRest[axis]) + 0.0; // never -0
  }
}

}

int indexBitsOf(const Lattice& lattice)
{
  const std::int64_t largest =
    std::max({ lattice.dimensions[0], lattice.dimensions[1], lattice.dimensions[2] });
  int bits = kMinimumIndexBits;
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
  PointQuantizer quantizer{};
  quantizer.motion = isDiagonal(transform.m) ? Motion::Scale : Motion::General;
  quantizer.fractionBits = fractionBitsOf(lattice);
  for (int axis = 0; axis < 3; ++axis)
  {
    std::copy(transform.m[axis], transform.m[axis] + 3, quantizer.matrix[axis]);
    const double quantum = std::ldexp(lattice.spacing[axis], -quantizer.fractionBits);
    quantizer.quantum[axis] = quantum;
    quantizer.reciprocal[axis] = 1.0 / quantum;
    quantizer.remainder[axis] = -std::fma(quantizer.reciprocal[axis], quantum, -1.0) / quantum;
    quantizer.limit[axis] = std::ldexp(
      std::min(double(lattice.dimensions[std::size_t(axis)]), lattice.end[axis]), quantizer.fractionBits);
  }
  const AffineTransform inverse = transform.inverse();
  const Vec3 translation(transform.m[0][3], transform.m[1][3], transform.m[2][3]);
  setPivot(transform, lattice, inverse.applyToVector(lattice.origin - translation), quantizer);
  const bool isFine = indexBitsOf(lattice) > kMaximumIndexBits;
  if (isFine || (quantizer.motion == Motion::General && needsCompensation(inverse, quantizer)))
  {
    quantizer.motion = isFine ? Motion::Fine : Motion::Compensated;
    setPivot(transform, lattice, Vec3(), quantizer);
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

} // namespace pointhaptics::simd
