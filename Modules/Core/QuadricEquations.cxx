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
  for (int i = 0; i < n; ++i)
  {
    double sum = rhs[i];
    for (int m = 0; m < i; ++m)
    {
      sum -= l[i][m] * y[m];
    }
    y[i] = sum * l[i][i];
  }
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

void traceSlopes(
  const kernel::TraceSums& sums, const double l[6][6], double strength, SurfaceFit& fit) noexcept
{
  const double* k = fit.k;
  double sa[6];
  double sb[6];
  for (int i = 0; i < 6; ++i)
  {
    sa[i] = sums.moveA[i] + 2.0 * k[3] * sums.turnA[i] + k[4] * sums.turnB[i];
    sb[i] = sums.moveB[i] + k[4] * sums.turnA[i] + 2.0 * k[5] * sums.turnB[i];
  }
  // Of A^-1 S only the height: one solution serves both directions.
  const double unit[6] = { 1.0, 0.0, 0.0, 0.0, 0.0, 0.0 };
  double row[6];
  backSolve(l, 6, unit, row);
  double da = 0.0;
  double db = 0.0;
  for (int i = 0; i < 6; ++i)
  {
    da += row[i] * sa[i];
    db += row[i] * sb[i];
  }
  fit.k[1] += std::clamp(strength * da, -kLargestSlopeChange, kLargestSlopeChange);
  fit.k[2] += std::clamp(strength * db, -kLargestSlopeChange, kLargestSlopeChange);
}

} // namespace pointhaptics
