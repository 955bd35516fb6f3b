/// @file
/// The normal equations of a quadric height field, and what else their solution tells. Private to SurfaceFit.
#pragma once

#include "Core/SurfaceFit.h"

namespace pointhaptics
{

/// A cell as the traced slopes look at it again.
struct SeenCell
{
  double p[6];
  double z;
  double weight;      ///< n g (1 - e)^4
  double slopeWeight; ///< 4 n g (1 - e)^3
  double e;
  double can; ///< a'C n / rho^2
  double cbn; ///< b'C n / rho^2
};

struct SeenCells
{
  static constexpr int kCapacity = 512;
  SeenCell cells[kCapacity];
  int count = 0; ///< Above kCapacity: some were not kept.
};

/// Normal equations of up to six coefficients, lower triangle.
struct NormalEquations
{
  double a[6][6] = {};
  double rhs[6] = {};
  double zz = 0.0;
  double weights = 0.0;
  double sumU = 0.0;
  double sumV = 0.0;
  int cells = 0;
  // For the errors only: sums of W^2 / n P P' and of W / n.
  bool withErrors = false;
  SeenCells* seen = nullptr;
  double scatter[6][6] = {};
  double perPoint = 0.0;

  void addScatter(const double p[6], double w, double count)
  {
    perPoint += w / count;
    const double w2 = w * w / count;
    for (int i = 0; i < 6; ++i)
    {
      for (int j = 0; j < 6; ++j)
      {
        scatter[i][j] += w2 * p[i] * p[j];
      }
    }
  }

  void add(const double p[6], double z, double u, double v, double w)
  {
    for (int i = 0; i < 6; ++i)
    {
      const double wp = w * p[i];
      rhs[i] += wp * z;
      for (int j = 0; j <= i; ++j)
      {
        a[i][j] += wp * p[j];
      }
    }
    zz += w * z * z;
    weights += w;
    sumU += w * u;
    sumV += w * v;
    ++cells;
  }
};

/// Cholesky factor of the leading n x n block; false at a relative pivot that is too small.
bool factor(const NormalEquations& eq, int n, double l[6][6]) noexcept;

/// Solves L L' k = rhs for the leading n unknowns.
void backSolve(const double l[6][6], int n, const double rhs[6], double k[6]) noexcept;

/// Noise from the weighted residuals, and the diagonal of A^-1 (sum W^2/n P P') A^-1 for k0, k1, k2.
void errorsOf(const NormalEquations& eq, const double l[6][6], int n, double residual, double rho,
  SurfaceFitError& error) noexcept;

/// Adds the derivative of the fit with respect to its own origin to k1 and k2. Moving along a changes every
/// weight, by the distance and by rho, and turns the frame with the surface; the normal equations
/// differentiated give A dk = S, of which the height's part counts.
void traceSlopes(const SeenCells& seen, const double l[6][6], const SurfaceFrame& frame,
  const TracedSlopes& slopes, SurfaceFit& fit) noexcept;

} // namespace pointhaptics
