/// @file
/// x_T = T x + t: the paper's affine map from the cloud's own frame into the frame of the workspace.
#pragma once

#include "Core/Base/Status.h"
#include "Core/Base/Vector3.h"

namespace pointhaptics
{

/// An affine transform in double precision; identity by default. Row by row: m[row][0..2] is T, m[row][3] is
/// t.
struct AffineTransform
{
  double m[3][4] = { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 } };

  Vec3 apply(const Vec3& p) const noexcept
  {
    return { m[0][0] * p.x + m[0][1] * p.y + m[0][2] * p.z + m[0][3],
      m[1][0] * p.x + m[1][1] * p.y + m[1][2] * p.z + m[1][3],
      m[2][0] * p.x + m[2][1] * p.y + m[2][2] * p.z + m[2][3] };
  }
  /// T v, without the translation: for directions that move with the points.
  Vec3 applyToVector(const Vec3& v) const noexcept
  {
    return { m[0][0] * v.x + m[0][1] * v.y + m[0][2] * v.z, m[1][0] * v.x + m[1][1] * v.y + m[1][2] * v.z,
      m[2][0] * v.x + m[2][1] * v.y + m[2][2] * v.z };
  }
  /// T^-T n up to length: for surface normals. Not normalised. A singular T gives a meaningless result.
  Vec3 applyToNormal(const Vec3& n) const noexcept;

  double determinant() const noexcept;
  bool isIdentity() const noexcept;
  /// True if T keeps angles, up to rounding; it may mirror. @p scale receives what it does to lengths.
  bool isSimilarity(double& scale) const noexcept;
  /// Ok, NonFiniteTransform or SingularTransform (|det T| below 1e-13 of the product of its row lengths and
  /// of that of its column lengths, or an inverse too large for a double).
  Status check() const noexcept;
  /// The inverse; identity when check() is not Ok.
  AffineTransform inverse() const noexcept;

  /// From the first three rows of a matrix, one after the other.
  static AffineTransform fromRows(const double* rows) noexcept;
  static AffineTransform scaling(const Vec3& factors) noexcept;
  /// Right-handed turn about @p axis (any length above 0) through the origin; angle in degrees.
  static AffineTransform rotation(double degrees, const Vec3& axis) noexcept;
  static AffineTransform translation(const Vec3& offset) noexcept;
};

/// a after b: (a * b).apply(p) == a.apply(b.apply(p)) up to rounding.
AffineTransform operator*(const AffineTransform& a, const AffineTransform& b) noexcept;
bool operator==(const AffineTransform& a, const AffineTransform& b) noexcept;

} // namespace pointhaptics
