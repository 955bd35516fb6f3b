#include "Core/QuadricEquations.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace
{

/// A pivot below this part of its diagonal means the cells do not determine that coefficient.
constexpr double kPivotTolerance = 1e-7;
/// Bound of what the moving fit may add to a slope.
constexpr double kLargestSlopeChange = 0.3;
/// Pivots of the cubic terms, over their diagonals, at which these begin to count and count in full.
constexpr double kCubicPivotFrom = 1e-4;
constexpr double kCubicPivotTo = 1e-3;

/// L y = rhs.
void halfSolve(const double l[6][6], int n, const double rhs[6], double y[6])
{
  for (int i = 0; i < n; ++i)
  {
    double sum = rhs[i];
    for (int m = 0; m < i; ++m)
    {
      sum -= l[i][m] * y[m];
    }
    y[i] = sum * l[i][i];
  }
}

/// L' k = y.
void otherHalf(const double l[6][6], int n, const double y[6], double k[6])
{
  for (int i = n - 1; i >= 0; --i)
  {
    double sum = y[i];
    for (int m = i + 1; m < n; ++m)
    {
      sum -= l[m][i] * k[m];
    }
    k[i] = sum * l[i][i];
  }
}

}

bool factor(const kernel::FitSums& sums, int n, double l[6][6]) noexcept
{
  for (int i = 0, at = 0; i < n; ++i)
  {
    for (int j = 0; j <= i; ++j, ++at)
    {
      double sum = sums.a[at];
      for (int m = 0; m < j; ++m)
      {
        sum -= l[i][m] * l[j][m];
      }
      if (i == j)
      {
        // Negated, so that NaN fails too.
        if (!(sum > kPivotTolerance * sums.a[at]))
        {
          return false;
        }
        l[i][i] = 1.0 / std::sqrt(sum);
      }
      else
      {
        l[i][j] = sum * l[j][j];
      }
    }
  }
  return true;
}

void backSolve(const double l[6][6], int n, const double rhs[6], double k[6]) noexcept
{
  double y[6];
  halfSolve(l, n, rhs, y);
  otherHalf(l, n, y, k);
}

void errorsOf(const kernel::FitRows& rows, const kernel::FitSums& sums, const double l[6][6], int n,
  double residual, double rho, SurfaceFitError& error) noexcept
{
  double scatter[6][6] = {};
  double perPoint = 0.0;
  for (int row = 0; row < rows.size; ++row)
  {
    const double w = rows.weight[row];
    if (!(w > 0.0))
    {
      continue;
    }
    perPoint += w / rows.count[row];
    const double w2 = w * w / rows.count[row];
    const double p[6] = { 1.0, rows.u[row], rows.v[row], rows.uu[row], rows.uv[row], rows.vv[row] };
    for (int i = 0; i < n; ++i)
    {
      for (int j = 0; j <= i; ++j)
      {
        scatter[i][j] += w2 * p[i] * p[j];
      }
    }
  }
  const double freedom = sums.cells / std::max(1.0, sums.cells - n);
  error.noise = perPoint > 0.0 ? residual * std::sqrt(freedom * sums.a[0] / perPoint) : 0.0;
  for (int i = 0; i < 3; ++i)
  {
    double unit[6] = {};
    unit[i] = 1.0;
    double y[6] = {};
    backSolve(l, n, unit, y);
    double variance = 0.0;
    for (int r = 0; r < n; ++r)
    {
      for (int c = 0; c < n; ++c)
      {
        variance += y[r] * scatter[std::max(r, c)][std::min(r, c)] * y[c];
      }
    }
    error.standardError[i] = std::sqrt(std::max(0.0, variance)) / (i == 0 ? 1.0 : rho);
  }
}

kernel::TracedFit withCubicTerms(
  const kernel::FitSums& sums, const kernel::CubicSums& cubic, const double l[6][6], double share) noexcept
{
  // The factor goes on below l with (half, m).
  double half[4][6];
  double m[4][4];
  for (int i = 0, at = 0; i < 4 && share > 0.0; ++i)
  {
    halfSolve(l, 6, cubic.qp + 6 * i, half[i]);
    for (int j = 0; j <= i; ++j, ++at)
    {
      double sum = cubic.qq[at];
      for (int n = 0; n < 6; ++n)
      {
        sum -= half[i][n] * half[j][n];
      }
      for (int n = 0; n < j; ++n)
      {
        sum -= m[i][n] * m[j][n];
      }
      if (i != j)
      {
        m[i][j] = sum * m[j][j];
        continue;
      }
      // Zero where sum is not a number, too.
      const double pivot = sum > kCubicPivotFrom * cubic.qq[at] ? sum / cubic.qq[at] : 0.0;
      const double t = std::clamp((pivot - kCubicPivotFrom) / (kCubicPivotTo - kCubicPivotFrom), 0.0, 1.0);
      share *= t * t * (3.0 - 2.0 * t);
      m[i][i] = 1.0 / std::sqrt(sum);
    }
  }
  const auto solve = [&](const double p[6], const double q[4], double x[10])
  {
    double y[6];
    halfSolve(l, 6, p, y);
    if (share > 0.0)
    {
      double z[4];
      for (int i = 0; i < 4; ++i)
      {
        double sum = q[i];
        for (int n = 0; n < 6; ++n)
        {
          sum -= half[i][n] * y[n];
        }
        for (int n = 0; n < i; ++n)
        {
          sum -= m[i][n] * z[n];
        }
        z[i] = sum * m[i][i];
      }
      for (int i = 3; i >= 0; --i)
      {
        for (int n = i + 1; n < 4; ++n)
        {
          z[i] -= m[n][i] * z[n];
        }
        z[i] *= m[i][i];
      }
      for (int i = 0; i < 4; ++i)
      {
        x[6 + i] = share * z[i];
        for (int n = 0; n < 6; ++n)
        {
          y[n] -= half[i][n] * x[6 + i];
        }
      }
    }
    otherHalf(l, 6, y, x);
  };
  const double unit[6] = { 1.0, 0.0, 0.0, 0.0, 0.0, 0.0 };
  const double none[4] = { 0.0, 0.0, 0.0, 0.0 };
  kernel::TracedFit fit;
  solve(sums.rhs, cubic.rhs, fit.k);
  solve(unit, none, fit.row);
  return fit;
}

void traceSlopes(const kernel::TraceSums& sums, double strength, SurfaceFit& fit) noexcept
{
  const double* k = fit.k;
  const double da = sums.moveA + 2.0 * k[3] * sums.turnA + k[4] * sums.turnB;
  const double db = sums.moveB + k[4] * sums.turnA + 2.0 * k[5] * sums.turnB;
  fit.k[1] += std::clamp(strength * da, -kLargestSlopeChange, kLargestSlopeChange);
  fit.k[2] += std::clamp(strength * db, -kLargestSlopeChange, kLargestSlopeChange);
}

} // namespace pointhaptics
