#include "Core/Base/Vector3.h"

#include <utility>

namespace pointhaptics
{
namespace
{

/// One rotation of Jacobi's method: makes a[p][q] zero and turns the eigenvectors with it.
void rotate(double (&a)[3][3], std::array<Vec3, 3>& v, int p, int q) noexcept
{
  if (a[p][q] == 0.0)
  {
    return;
  }
  const double theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
  const double t = std::copysign(1.0, theta) / (std::abs(theta) + std::sqrt(theta * theta + 1.0));
  const double c = 1.0 / std::sqrt(t * t + 1.0);
  const double s = t * c;
  for (int k = 0; k < 3; ++k)
  {
    const double akp = a[k][p];
    const double akq = a[k][q];
    a[k][p] = c * akp - s * akq;
    a[k][q] = s * akp + c * akq;
  }
  for (int k = 0; k < 3; ++k)
  {
    const double apk = a[p][k];
    const double aqk = a[q][k];
    a[p][k] = c * apk - s * aqk;
    a[q][k] = s * apk + c * aqk;
  }
  const Vec3 vp = v[p];
  v[p] = c * vp - s * v[q];
  v[q] = s * vp + c * v[q];
}

} // namespace

SymEigen symmetricEigen(const SymMat3& m) noexcept
{
  SymEigen result;
  result.vectors = { Vec3{ 1, 0, 0 }, Vec3{ 0, 1, 0 }, Vec3{ 0, 0, 1 } };
  if (!isFinite(m))
  {
    return result;
  }
  double a[3][3] = { { m.xx, m.xy, m.xz }, { m.xy, m.yy, m.yz }, { m.xz, m.yz, m.zz } };
  auto& v = result.vectors;
  for (int sweep = 0; sweep < 16; ++sweep)
  {
    const double off = a[0][1] * a[0][1] + a[0][2] * a[0][2] + a[1][2] * a[1][2];
    const double on = a[0][0] * a[0][0] + a[1][1] * a[1][1] + a[2][2] * a[2][2];
    if (off <= 1e-34 * on || off == 0.0)
    {
      break;
    }
    for (int p = 0; p < 2; ++p)
    {
      for (int q = p + 1; q < 3; ++q)
      {
        rotate(a, v, p, q);
      }
    }
  }
  result.values = { a[0][0], a[1][1], a[2][2] };
  for (int i = 0; i < 2; ++i)
  {
    for (int j = 0; j < 2 - i; ++j)
    {
      if (result.values[j] > result.values[j + 1])
      {
        std::swap(result.values[j], result.values[j + 1]);
        std::swap(v[j], v[j + 1]);
      }
    }
  }
  return result;
}

} // namespace pointhaptics
