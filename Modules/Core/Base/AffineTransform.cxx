#include "Core/Base/AffineTransform.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace
{
/// Below this fraction of the products of its row and column lengths a determinant is rounding noise.
constexpr double kSingularRatio = 1e-13;
/// Part of a length by which a similarity may change it with its direction: rounding, also of products of
/// many transforms.
constexpr double kSimilarityTolerance = 1e-9;
constexpr int kElements = 12; ///< They lie one after the other.

Vec3 row(const AffineTransform& t, int r)
{
  return { t.m[r][0], t.m[r][1], t.m[r][2] };
}

/// T = 2^exponent rows, whose largest entry is about 1: products of three neither overflow nor vanish.
struct ScaledRows
{
  Vec3 rows[3];
  int exponent = 0;

  explicit ScaledRows(const AffineTransform& t)
  {
    double largest = 0.0;
    for (const auto& r : t.m)
    {
      largest = std::max({ largest, std::abs(r[0]), std::abs(r[1]), std::abs(r[2]) });
    }
    if (std::isfinite(largest))
    {
      std::frexp(largest, &exponent);
    }
    for (int r = 0; r < 3; ++r)
    {
      for (int c = 0; c < 3; ++c)
      {
        rows[r][c] = std::ldexp(t.m[r][c], -exponent);
      }
    }
  }
  double determinant() const { return dot(rows[0], cross(rows[1], rows[2])); }
  /// Row r of the cofactor matrix, det(T) T^-T.
  Vec3 cofactors(int r) const { return cross(rows[(r + 1) % 3], rows[(r + 2) % 3]); }
};
}

double AffineTransform::determinant() const noexcept
{
  return dot(row(*this, 0), cross(row(*this, 1), row(*this, 2)));
}

bool AffineTransform::isIdentity() const noexcept
{
  return *this == AffineTransform();
}

bool AffineTransform::isSimilarity(double& scale) const noexcept
{
  const Vec3 axes[3] = { applyToVector({ 1, 0, 0 }), applyToVector({ 0, 1, 0 }), applyToVector({ 0, 0, 1 }) };
  const double square = (norm2(axes[0]) + norm2(axes[1]) + norm2(axes[2])) / 3.0;
  scale = std::sqrt(square);
  for (int i = 0; i < 3; ++i)
  {
    // Negated, so that NaN fails too.
    if (!(std::abs(norm2(axes[i]) - square) <= kSimilarityTolerance * square) ||
      !(std::abs(dot(axes[i], axes[(i + 1) % 3])) <= kSimilarityTolerance * square))
    {
      return false;
    }
  }
  return scale > 0.0;
}

Vec3 AffineTransform::applyToNormal(const Vec3& n) const noexcept
{
  // The cofactor matrix is det(T) T^-T: no division, and a mirror keeps its sign through the determinant.
  const ScaledRows scaled(*this);
  const Vec3 result = { dot(scaled.cofactors(0), n), dot(scaled.cofactors(1), n),
    dot(scaled.cofactors(2), n) };
  return scaled.determinant() < 0.0 ? -result : result;
}

Status AffineTransform::check() const noexcept
{
  if (!std::all_of(m[0], m[0] + kElements, [](double value) { return std::isfinite(value); }))
  {
    return Status::NonFiniteTransform;
  }
  const ScaledRows scaled(*this);
  // Each product in the determinant has one entry of each row and one of each column.
  double rowLengths = 1.0;
  double columnLengths = 1.0;
  double largestCofactor = 0.0;
  for (int i = 0; i < 3; ++i)
  {
    rowLengths *= norm(scaled.rows[i]);
    columnLengths *= norm({ scaled.rows[0][i], scaled.rows[1][i], scaled.rows[2][i] });
    const Vec3 c = scaled.cofactors(i);
    largestCofactor = std::max({ largestCofactor, std::abs(c.x), std::abs(c.y), std::abs(c.z) });
  }
  const double det = std::abs(scaled.determinant());
  if (!(det > kSingularRatio * std::min(rowLengths, columnLengths)) ||
    !std::isfinite(std::ldexp(largestCofactor / det, -scaled.exponent)))
  {
    return Status::SingularTransform;
  }
  return Status::Ok;
}

/// Inverts scaled rows, as check() judges them. Determinants of the unscaled rows, which Eigen forms, would
/// overflow where entries are beyond 1e103.
AffineTransform AffineTransform::inverse() const noexcept
{
  AffineTransform result;
  if (check() != Status::Ok)
  {
    return result;
  }
  const ScaledRows scaled(*this);
  const double det = scaled.determinant();
  for (int c = 0; c < 3; ++c)
  {
    const Vec3 column = scaled.cofactors(c) / det;
    for (int r = 0; r < 3; ++r)
    {
      result.m[r][c] = std::ldexp(column[r], -scaled.exponent);
    }
  }
  const Vec3 t = result.applyToVector({ m[0][3], m[1][3], m[2][3] });
  for (int r = 0; r < 3; ++r)
  {
    result.m[r][3] = -t[r];
  }
  return result;
}

AffineTransform AffineTransform::fromRows(const double* rows) noexcept
{
  AffineTransform result;
  std::copy_n(rows, kElements, result.m[0]);
  return result;
}

AffineTransform AffineTransform::scaling(const Vec3& factors) noexcept
{
  AffineTransform result;
  for (int r = 0; r < 3; ++r)
  {
    result.m[r][r] = factors[r];
  }
  return result;
}

AffineTransform AffineTransform::rotation(double degrees, const Vec3& axis) noexcept
{
  const double radians = degrees * (3.14159265358979323846 / 180.0);
  const double c = std::cos(radians);
  const double s = std::sin(radians);
  const Vec3 u = normalized(axis);
  AffineTransform result;
  for (int r = 0; r < 3; ++r)
  {
    Vec3 unit;
    unit[r] = 1.0;
    // Row r of the rotation is the inverse rotation of axis r (Rodrigues' formula with -s).
    const Vec3 turned = c * unit - s * cross(u, unit) + (1.0 - c) * dot(u, unit) * u;
    for (int k = 0; k < 3; ++k)
    {
      result.m[r][k] = turned[k];
    }
  }
  return result;
}

AffineTransform AffineTransform::translation(const Vec3& offset) noexcept
{
  AffineTransform result;
  for (int r = 0; r < 3; ++r)
  {
    result.m[r][3] = offset[r];
  }
  return result;
}

AffineTransform operator*(const AffineTransform& a, const AffineTransform& b) noexcept
{
  AffineTransform result;
  for (int r = 0; r < 3; ++r)
  {
    for (int c = 0; c < 4; ++c)
    {
      result.m[r][c] =
        a.m[r][0] * b.m[0][c] + a.m[r][1] * b.m[1][c] + a.m[r][2] * b.m[2][c] + (c == 3 ? a.m[r][3] : 0.0);
    }
  }
  return result;
}

bool operator==(const AffineTransform& a, const AffineTransform& b) noexcept
{
  return std::equal(a.m[0], a.m[0] + kElements, b.m[0]);
}

} // namespace pointhaptics
