#include "Core/AffineTransform.h"

namespace pointhaptics
{
namespace
{
/// Below this fraction of the product of its row lengths a determinant is rounding noise.
constexpr double kSingularRatio = 1e-13;
constexpr double kSmallestDeterminant = 1e-300;

Vec3 row(const AffineTransform& t, int r)
{
  return { t.m[r][0], t.m[r][1], t.m[r][2] };
}
}

double AffineTransform::determinant() const noexcept
{
  return dot(row(*this, 0), cross(row(*this, 1), row(*this, 2)));
}

bool AffineTransform::isIdentity() const noexcept
{
  return *this == AffineTransform();
}

Vec3 AffineTransform::applyToNormal(const Vec3& n) const noexcept
{
  // The cofactor matrix is det(T) T^-T: no division, and a mirror keeps its sign through the determinant.
  const Vec3 r0 = row(*this, 0);
  const Vec3 r1 = row(*this, 1);
  const Vec3 r2 = row(*this, 2);
  const Vec3 result = { dot(cross(r1, r2), n), dot(cross(r2, r0), n), dot(cross(r0, r1), n) };
  return determinant() < 0.0 ? -result : result;
}

Status AffineTransform::check() const noexcept
{
  double lengths = 1.0;
  for (const auto& r : m)
  {
    for (double value : r)
    {
      if (!std::isfinite(value))
      {
        return Status::NonFiniteTransform;
      }
    }
    lengths *= norm({ r[0], r[1], r[2] });
  }
  const double det = std::abs(determinant());
  // Negated comparisons, so that an overflow to NaN or infinity counts as singular too.
  if (!(det > kSmallestDeterminant) || !(det > kSingularRatio * lengths) || !std::isfinite(det))
  {
    return Status::SingularTransform;
  }
  return Status::Ok;
}

AffineTransform AffineTransform::inverse() const noexcept
{
  AffineTransform result;
  if (check() != Status::Ok)
  {
    return result;
  }
  const double det = determinant();
  const Vec3 columns[3] = { cross(row(*this, 1), row(*this, 2)) / det,
    cross(row(*this, 2), row(*this, 0)) / det, cross(row(*this, 0), row(*this, 1)) / det };
  for (int r = 0; r < 3; ++r)
  {
    for (int c = 0; c < 3; ++c)
    {
      result.m[r][c] = columns[c][r];
    }
  }
  const Vec3 t = result.applyToVector({ m[0][3], m[1][3], m[2][3] });
  for (int r = 0; r < 3; ++r)
  {
    result.m[r][3] = -t[r];
  }
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
  for (int r = 0; r < 3; ++r)
  {
    for (int c = 0; c < 4; ++c)
    {
      if (a.m[r][c] != b.m[r][c])
      {
        return false;
      }
    }
  }
  return true;
}

} // namespace pointhaptics
