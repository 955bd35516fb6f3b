/// @file
/// The plane through a few points from their second moments: fast, for millions of neighbourhoods.
#pragma once

#include "Core/Base/Vector3.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{

/// Eigenvalues of a symmetric matrix in ascending order, by the trigonometric solution of the cubic, and the
/// eigenvector of the smallest. The matrix must be no multiple of the identity. The absolute error is about
/// 1e-8 of the largest eigenvalue, which thinness does not see.
struct PrincipalPlane
{
  double values[3] = { 0.0, 0.0, 0.0 };
  Vec3 normal;
};

inline Vec3 nullVector(const SymMat3& m, double value)
{
  const Vec3 rows[3] = { { m.xx - value, m.xy, m.xz }, { m.xy, m.yy - value, m.yz },
    { m.xz, m.yz, m.zz - value } };
  Vec3 best;
  double longest = 0.0;
  for (int i = 0; i < 3; ++i)
  {
    const Vec3 candidate = cross(rows[i], rows[(i + 1) % 3]);
    if (norm2(candidate) > longest)
    {
      longest = norm2(candidate);
      best = candidate;
    }
  }
  return longest > 0.0 ? best / std::sqrt(longest) : Vec3();
}

inline PrincipalPlane principalPlane(const SymMat3& m)
{
  PrincipalPlane spread;
  const double mean = m.trace() / 3.0;
  const SymMat3 a{ m.xx - mean, m.yy - mean, m.zz - mean, m.xy, m.yz, m.xz };
  const double p2 =
    (a.xx * a.xx + a.yy * a.yy + a.zz * a.zz + 2.0 * (a.xy * a.xy + a.yz * a.yz + a.xz * a.xz)) / 6.0;
  const double p = std::sqrt(p2);
  if (!(p > 0.0))
  {
    std::fill(spread.values, spread.values + 3, mean);
    return spread;
  }
  const double determinant = a.xx * (a.yy * a.zz - a.yz * a.yz) - a.xy * (a.xy * a.zz - a.yz * a.xz) +
    a.xz * (a.xy * a.yz - a.yy * a.xz);
  const double angle = std::acos(std::clamp(determinant / (2.0 * p2 * p), -1.0, 1.0)) / 3.0;
  spread.values[2] = mean + 2.0 * p * std::cos(angle);
  const double smallest = mean + 2.0 * p * std::cos(angle + 2.0 * 3.14159265358979323846 / 3.0);
  spread.values[0] = std::max(0.0, smallest);
  spread.values[1] = std::max(spread.values[0], 3.0 * mean - spread.values[0] - spread.values[2]);
  spread.normal = nullVector(m, smallest);
  return spread;
}

} // namespace pointhaptics
