#include "Core/Surface/QuadricEquations.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace
{

/// Cells do not determine a coefficient whose pivot is below this part of its diagonal.
constexpr double kPivotTolerance = 1e-7;
/// Bound of the slope that the moving fit may add.
constexpr double kLargestSlopeChange = 0.3;
/// Pivots of the cubic terms, over their diagonals: from the first on the terms count, from the second on in
/// full.
constexpr double kCubicPivotFrom = 1e-4;
constexpr double kCubicPivotTo = 1e-3;

// Numbers of unknowns are template arguments, so that the loops are unrolled: short loops of varying lengths
// cost more than their arithmetic. Eigen's LLT of fixed size takes 150 ns for six unknowns, these 41, and has
// no test of single pivots.

/// Solves L y = rhs.
template <int N>
inline void halfSolve(const double l[6][6], const double rhs[6], double y[6])
{
#pragma GCC unroll 6
  for (int i = 0; i < N; ++i)
  {
    double sum = rhs[i];
#pragma GCC unroll 6
    for (int m = 0; m < i; ++m)
    {
      sum -= l[i][m] * y[m];
    }
    y[i] = sum * l[i][i];
  }
}

/// Solves L' k = y.
template <int N>
inline void otherHalf(const double l[6][6], const double y[6], double k[6])
{
#pragma GCC unroll 6
  for (int i = N - 1; i >= 0; --i)
  {
    double sum = y[i];
#pragma GCC unroll 6
    for (int m = i + 1; m < N; ++m)
    {
      sum -= l[m][i] * k[m];
    }
    k[i] = sum * l[i][i];
  }
}

template <int N>
inline bool factorLeading(const simd::FitSums& sums, double l[6][6])
{
#pragma GCC unroll 6
  for (int i = 0; i < N; ++i)
  {
    const double* row = sums.a + i * (i + 1) / 2;
#pragma GCC unroll 6
    for (int j = 0; j <= i; ++j)
    {
      double sum = row[j];
#pragma GCC unroll 6
      for (int m = 0; m < j; ++m)
      {
        sum -= l[i][m] * l[j][m];
      }
      if (i != j)
      {
        l[i][j] = sum * l[j][j];
        continue;
      }
      // The test is negated, so that NaN fails too.
      if (!(sum > kPivotTolerance * row[i]))
      {
        return false;
      }
      l[i][i] = 1.0 / std::sqrt(sum);
    }
  }
  return true;
}

}

bool factor(const simd::FitSums& sums, int n, double l[6][6]) noexcept
{
  return n == 6 ? factorLeading<6>(sums, l) : factorLeading<3>(sums, l);
}

void backSolve(const double l[6][6], int n, const double rhs[6], double k[6]) noexcept
{
  double y[6];
  if (n == 6)
  {
    halfSolve<6>(l, rhs, y);
    otherHalf<6>(l, y, k);
  }
  else
  {
    halfSolve<3>(l, rhs, y);
    otherHalf<3>(l, y, k);
  }
}

void errorsOf(const simd::FitRows& rows, const simd::FitSums& sums, const double inverse[3][10], int terms,
  double residual, double rho, SurfaceFitError& error) noexcept
{
  double variances[3] = { 0.0, 0.0, 0.0 };
  double perPoint = 0.0;
  double all = 0.0;
  double leftOut = 0.0;
  for (int row = 0; row < rows.size; ++row)
  {
    const double w = rows.weight[row];
    const double base = std::max(0.0, 1.0 - rows.e[row]);
    const double ungated = rows.count[row] * (base * base) * (base * base);
    all += ungated;
    if (!(w > 0.0))
    {
      leftOut += ungated;
      continue;
    }
    perPoint += w / rows.count[row];
    const double u = rows.u[row];
    const double v = rows.v[row];
    const double uu = rows.uu[row];
    const double uv = rows.uv[row];
    const double vv = rows.vv[row];
    const double p[10] = { 1.0, u, v, uu, uv, vv, u * (3.0 * uu - 2.0 * u * u),
      2.0 * u * (uv - u * v) + v * uu, 2.0 * v * (uv - u * v) + u * vv, v * (3.0 * vv - 2.0 * v * v) };
    for (int i = 0; i < 3; ++i)
    {
      double change = 0.0;
      for (int n = 0; n < terms; ++n)
      {
        change += inverse[i][n] * p[n];
      }
      variances[i] += w * w / rows.count[row] * change * change;
    }
  }
  error.leftOut = all > 0.0 ? leftOut / all : 0.0;
  const double freedom = sums.cells / std::max(1.0, sums.cells - terms);
  error.noise = perPoint > 0.0 ? residual * std::sqrt(freedom * sums.a[0] / perPoint) : 0.0;
  for (int i = 0; i < 3; ++i)
  {
    error.standardError[i] = std::sqrt(variances[i]) / (i == 0 ? 1.0 : rho);
  }
}

CubicFactor factorCubic(const simd::CubicSums& cubic, const double l[6][6], double cubicWeight) noexcept
{
  CubicFactor factor;
  factor.weight = cubicWeight;
#pragma GCC unroll 4
  for (int i = 0; i < 4; ++i)
  {
    const double* row = cubic.qq + i * (i + 1) / 2;
    halfSolve<6>(l, cubic.qp + 6 * i, factor.half[i]);
#pragma GCC unroll 4
    for (int j = 0; j <= i; ++j)
    {
      double sum = row[j];
#pragma GCC unroll 6
      for (int n = 0; n < 6; ++n)
      {
        sum -= factor.half[i][n] * factor.half[j][n];
      }
#pragma GCC unroll 6
      for (int n = 0; n < j; ++n)
      {
        sum -= factor.m[i][n] * factor.m[j][n];
      }
      if (i != j)
      {
        factor.m[i][j] = sum * factor.m[j][j];
        continue;
      }
      // NaN gives zero, too.
      const double pivot = sum > kCubicPivotFrom * row[i] ? sum / row[i] : 0.0;
      const double t = std::clamp((pivot - kCubicPivotFrom) / (kCubicPivotTo - kCubicPivotFrom), 0.0, 1.0);
      factor.weight *= t * t * (3.0 - 2.0 * t);
      factor.m[i][i] = 1.0 / std::sqrt(sum);
    }
  }
  return factor;
}

void solveCubic(const CubicFactor& factor, const double l[6][6], const double p[6], const double q[4],
  double x[10]) noexcept
{
  double y[6];
  halfSolve<6>(l, p, y);
  if (factor.weight > 0.0)
  {
    double z[4];
#pragma GCC unroll 6
    for (int i = 0; i < 4; ++i)
    {
      double sum = q[i];
#pragma GCC unroll 6
      for (int n = 0; n < 6; ++n)
      {
        sum -= factor.half[i][n] * y[n];
      }
#pragma GCC unroll 6
      for (int n = 0; n < i; ++n)
      {
        sum -= factor.m[i][n] * z[n];
      }
      z[i] = sum * factor.m[i][i];
    }
#pragma GCC unroll 6
    for (int i = 3; i >= 0; --i)
    {
#pragma GCC unroll 6
      for (int n = i + 1; n < 4; ++n)
      {
        z[i] -= factor.m[n][i] * z[n];
      }
      z[i] *= factor.m[i][i];
    }
#pragma GCC unroll 6
    for (int i = 0; i < 4; ++i)
    {
      x[6 + i] = factor.weight * z[i];
#pragma GCC unroll 6
      for (int n = 0; n < 6; ++n)
      {
        y[n] -= factor.half[i][n] * x[6 + i];
      }
    }
  }
  else
  {
    std::fill(x + 6, x + 10, 0.0);
  }
  otherHalf<6>(l, y, x);
}

simd::TracedFit withCubicTerms(
  const simd::FitSums& sums, const simd::CubicSums& cubic, const double l[6][6], double cubicWeight) noexcept
{
  const CubicFactor factor = factorCubic(cubic, l, cubicWeight);
  const double unit[6] = { 1.0, 0.0, 0.0, 0.0, 0.0, 0.0 };
  const double none[4] = { 0.0, 0.0, 0.0, 0.0 };
  simd::TracedFit fit;
  solveCubic(factor, l, sums.rhs, cubic.rhs, fit.k);
  solveCubic(factor, l, unit, none, fit.row);
  return fit;
}

void traceSlopes(const simd::TraceSums& sums, double strength, SurfaceFit& fit) noexcept
{
  const double* k = fit.k;
  const double da = sums.moveA + 2.0 * k[3] * sums.turnA + k[4] * sums.turnB;
  const double db = sums.moveB + k[4] * sums.turnA + 2.0 * k[5] * sums.turnB;
  fit.k[1] += std::clamp(strength * da, -kLargestSlopeChange, kLargestSlopeChange);
  fit.k[2] += std::clamp(strength * db, -kLargestSlopeChange, kLargestSlopeChange);
}

} // namespace pointhaptics
