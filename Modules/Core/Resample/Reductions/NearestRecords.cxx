#include "Core/Resample/Reductions/NearestRecords.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace simd
{
namespace
{

/// How far, on an axis, the quantized position of a point may be from the coordinate that transforming it
/// gives, and a quantized target from the one that coordinates give.
double errorOf(const VoxelRequest& request, const PointQuantizer& quantizer, int axis)
{
  const double* const row = request.transform.m[axis];
  // Of the transform's terms: those of p - pivot are known to cost less than a quantum, unless it is
  // Motion::Compensated.
  const double terms = std::abs(row[0] * quantizer.pivot[0]) + std::abs(row[1] * quantizer.pivot[1]) +
    std::abs(row[2] * quantizer.pivot[2]) + std::abs(row[3]);
  const Lattice& lattice = request.lattice;
  const double ofCenter =
    std::abs(lattice.origin[axis]) + double(lattice.dimensions[std::size_t(axis)]) * lattice.spacing[axis];
  return 2.0 * quantizer.quantum[axis] + 0x1p-49 * (terms + ofCenter);
}

}

NearestRecords::NearestRecords(const VoxelRequest& request, const PointQuantizer& quantizer)
  : toMean_(request.representative == Representative::NearestToMean)
  , map_{ quantizer.fractionBits, {} }
  , compare_(kernelsFor(request.instructions).nearest)
{
  const Vec3& spacing = request.lattice.spacing;
  const double longest = std::max({ spacing.x, spacing.y, spacing.z });
  const double unit = std::ldexp(longest, -kNearestBits);
  double square = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    map_.scale[axis] = float(spacing[axis] / longest);
    // And of what exact comparisons are rounded to: see Representative.
    const double exact = longest * std::max(0x1p-40, 0x1p-55 * double(request.points.size()));
    const double error = (errorOf(request, quantizer, axis) + exact) / unit;
    square += error * error;
  }
  // Of the point and of the target; and of the arithmetic, in which an offset loses three units at most, and
  // a distance less than four.
  constexpr double kOfFloats = 16.0;
  error_ = quantizer.motion == Motion::Compensated ? INFINITY : 2.0 * std::sqrt(square) + kOfFloats;
}

void NearestRecords::finish()
{
  for (std::size_t v = 0; v < voxels_; ++v)
  {
    // Distances a and b that are off by e: b - a > 2 e where b^2 - a^2 > 4 e b.
    NearestPoint& nearest = nearest_[v];
    const double gap = double(nearest.second) - double(nearest.least);
    const bool isKnown = gap * gap > 16.0 * error_ * error_ * double(nearest.second);
    nearest.point = isKnown ? nearest.point : kUnknown;
  }
}

} // namespace simd
} // namespace pointhaptics
