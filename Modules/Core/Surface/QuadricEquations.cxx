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
inline void halfSolve(const FitFactor& f, const double* rhs, double y[10])
{
#pragma GCC unroll 10
  for (int i = 0; i < N; ++i)
  {
    double sum = rhs[i];
#pragma GCC unroll 10
    for (int m = 0; m < i; ++m)
    {
      sum -= f.l[i][m] * y[m];
    }
    y[i] = sum * f.l[i][i];
  }
}

/// Solves L' k = y for the unknowns from @p First to before @p Last.
template <int First, int Last>
inline void otherHalf(const FitFactor& f, const double y[10], double* k)
{
#pragma GCC unroll 10
  for (int i = Last - 1; i >= First; --i)
  {
    double sum = y[i];
#pragma GCC unroll 10
    for (int m = i + 1; m < Last; ++m)
    {
      sum -= f.l[m][i] * k[m];
    }
    k[i] = sum * f.l[i][i];
  }
}

/// Factors the rows from @p First to before @p Last. @p isUsable is asked about each pivot and its diagonal.
template <int First, int Last, typename IsUsable>
inline bool factorRows(const simd::FitSums& sums, FitFactor& f, const IsUsable& isUsable)
{
#pragma GCC unroll 10
  for (int i = First; i < Last; ++i)
  {
    const double* row = sums.a + i * (i + 1) / 2;
#pragma GCC unroll 10
    for (int j = 0; j <= i; ++j)
    {
      double sum = row[j];
#pragma GCC unroll 10
      for (int m = 0; m < j; ++m)
      {
        sum -= f.l[i][m] * f.l[j][m];
      }
      if (i != j)
      {
        f.l[i][j] = sum * f.l[j][j];
        continue;
      }
      if (!isUsable(sum, row[i]))
      {
        return false;
      }
      f.l[i][i] = 1.0 / std::sqrt(sum);
    }
  }
  f.terms = Last;
  return true;
}

}

bool factor(const simd::FitSums& sums, int terms, FitFactor& factor) noexcept
{
  // False for NaN, too.
  const auto isUsable = [](double pivot, double diagonal) { return pivot > kPivotTolerance * diagonal; };
  return terms == 6 ? factorRows<0, 6>(sums, factor, isUsable) : factorRows<0, 3>(sums, factor, isUsable);
}

void addCubicTerms(const simd::FitSums& sums, double weight, FitFactor& factor) noexcept
{
  factor.cubicWeight = weight;
  factorRows<6, 10>(sums, factor,
    [&factor](double sum, double diagonal)
    {
      // NaN gives zero, too.
      const double pivot = sum > kCubicPivotFrom * diagonal ? sum / diagonal : 0.0;
      const double t = std::clamp((pivot - kCubicPivotFrom) / (kCubicPivotTo - kCubicPivotFrom), 0.0, 1.0);
      factor.cubicWeight *= t * t * (3.0 - 2.0 * t);
      return true;
    });
}

void solve(const FitFactor& factor, const double* rhs, double* x) noexcept
{
  double y[10];
  if (factor.terms == 3)
  {
    halfSolve<3>(factor, rhs, y);
    otherHalf<0, 3>(factor, y, x);
    return;
  }
  if (factor.terms == 10 && factor.cubicWeight > 0.0)
  {
    halfSolve<10>(factor, rhs, y);
    otherHalf<6, 10>(factor, y, x);
#pragma GCC unroll 4
    for (int i = 6; i < 10; ++i)
    {
      x[i] *= factor.cubicWeight;
#pragma GCC unroll 6
      for (int n = 0; n < 6; ++n)
      {
        y[n] -= factor.l[i][n] * x[i];
      }
    }
  }
  else
  {
    halfSolve<6>(factor, rhs, y);
    std::fill(x + 6, x + factor.terms, 0.0);
  }
  otherHalf<0, 6>(factor, y, x);
}

void inverseRow(const FitFactor& factor, int term, double row[10]) noexcept
{
  double unit[10] = {};
  unit[term] = 1.0;
  std::fill(row, row + 10, 0.0);
  solve(factor, unit, row);
}

void errorsOf(const simd::FitRows& rows, const simd::FitSums& sums, const FitFactor& factor, double residual,
  double rho, SurfaceFitError& error) noexcept
{
  const int terms = factor.terms;
  double inverse[3][10];
  for (int i = 0; i < 3; ++i)
  {
    inverseRow(factor, i, inverse[i]);
  }
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

void traceSlopes(const simd::TraceSums& sums, double strength, SurfaceFit& fit) noexcept
{
  const double* k = fit.k;
  const double da = sums.moveA + 2.0 * k[3] * sums.turnA + k[4] * sums.turnB;
  const double db = sums.moveB + k[4] * sums.turnA + 2.0 * k[5] * sums.turnB;
  fit.k[1] += std::clamp(strength * da, -kLargestSlopeChange, kLargestSlopeChange);
  fit.k[2] += std::clamp(strength * db, -kLargestSlopeChange, kLargestSlopeChange);
}

} // namespace pointhaptics
