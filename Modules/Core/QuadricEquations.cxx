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

bool factor(const NormalEquations& eq, int n, double l[6][6]) noexcept
{
  for (int i = 0; i < n; ++i)
  {
    for (int j = 0; j <= i; ++j)
    {
      double sum = eq.a[i][j];
      for (int m = 0; m < j; ++m)
      {
        sum -= l[i][m] * l[j][m];
      }
      if (i == j)
      {
        // Negated, so that NaN fails too.
        if (!(sum > kPivotTolerance * eq.a[i][i]))
        {
          return false;
        }
        l[i][i] = std::sqrt(sum);
      }
      else
      {
        l[i][j] = sum / l[j][j];
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
    y[i] = sum / l[i][i];
  }
  for (int i = n - 1; i >= 0; --i)
  {
    double sum = y[i];
    for (int m = i + 1; m < n; ++m)
    {
      sum -= l[m][i] * k[m];
    }
    k[i] = sum / l[i][i];
  }
}

void errorsOf(const NormalEquations& eq, const double l[6][6], int n, double residual, double rho,
  SurfaceFitError& error) noexcept
{
  const double freedom = double(eq.cells) / std::max(1.0, double(eq.cells - n));
  error.noise = eq.perPoint > 0.0 ? residual * std::sqrt(freedom * eq.weights / eq.perPoint) : 0.0;
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
        variance += y[r] * eq.scatter[r][c] * y[c];
      }
    }
    error.standardError[i] = std::sqrt(std::max(0.0, variance)) / (i == 0 ? 1.0 : rho);
  }
}

void traceSlopes(const SeenCells& seen, const double l[6][6], const SurfaceFrame& frame,
  const TracedSlopes& slopes, SurfaceFit& fit) noexcept
{
  const double* k = fit.k;
  const double ra = dot(slopes.radiusGradient, frame.a);
  const double rb = dot(slopes.radiusGradient, frame.b);
  double sa[6] = {};
  double sb[6] = {};
  double turnA[6] = {};
  double turnB[6] = {};
  for (int c = 0; c < seen.count; ++c)
  {
    const SeenCell& cell = seen.cells[c];
    const double u = cell.p[1];
    const double v = cell.p[2];
    double r = cell.z;
    for (int i = 0; i < 6; ++i)
    {
      r -= k[i] * cell.p[i];
    }
    // What the turning frame does to the cell's row P, and through it to its residual.
    const double qa[6] = { 0.0, cell.z, 0.0, 2.0 * (u * cell.z + cell.can), v * cell.z + cell.cbn, 0.0 };
    const double qb[6] = { 0.0, 0.0, cell.z, 0.0, u * cell.z + cell.can, 2.0 * (v * cell.z + cell.cbn) };
    double kqa = 0.0;
    double kqb = 0.0;
    for (int i = 0; i < 6; ++i)
    {
      kqa += k[i] * qa[i];
      kqb += k[i] * qb[i];
    }
    const double wa = 2.0 * cell.slopeWeight * (u + cell.e * ra) * r;
    const double wb = 2.0 * cell.slopeWeight * (v + cell.e * rb) * r;
    for (int i = 0; i < 6; ++i)
    {
      sa[i] += wa * cell.p[i];
      sb[i] += wb * cell.p[i];
      turnA[i] += cell.weight * (r * qa[i] - kqa * cell.p[i]);
      turnB[i] += cell.weight * (r * qb[i] - kqb * cell.p[i]);
    }
  }
  for (int i = 0; i < 6; ++i)
  {
    sa[i] += 2.0 * k[3] * turnA[i] + k[4] * turnB[i];
    sb[i] += k[4] * turnA[i] + 2.0 * k[5] * turnB[i];
  }
  double da[6] = {};
  double db[6] = {};
  backSolve(l, 6, sa, da);
  backSolve(l, 6, sb, db);
  fit.k[1] += std::clamp(slopes.strength * da[0], -kLargestSlopeChange, kLargestSlopeChange);
  fit.k[2] += std::clamp(slopes.strength * db[0], -kLargestSlopeChange, kLargestSlopeChange);
}

} // namespace pointhaptics
