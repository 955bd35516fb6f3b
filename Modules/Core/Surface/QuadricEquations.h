/// @file
/// The solution of the fit's normal equations, with its standard errors. Private to SurfaceFit.
#pragma once

#include "Core/Surface/FitKernel.h"
#include "Core/Surface/SurfaceFit.h"

namespace pointhaptics
{

/// Cholesky factor of the leading n x n block, its diagonal inverted; false at a relative pivot that is too
/// small.
bool factor(const simd::FitSums& sums, int n, double l[6][6]) noexcept;

/// Solves L L' k = rhs for the leading n unknowns, the diagonal of @p l inverted.
void backSolve(const double l[6][6], int n, const double rhs[6], double k[6]) noexcept;

/// Factor of the ten equations of quadratic and cubic terms together, below that of the six.
struct CubicFactor
{
  double half[4][6];
  double m[4][4];
  double weight; ///< Weight of the cubic terms: as given, or less where the cells hardly determine them.
};

/// @param l factor of the six. @param cubicWeight 0 to 1.
CubicFactor factorCubic(const simd::CubicSums& cubic, const double l[6][6], double cubicWeight) noexcept;

/// Solves the ten equations for right hand sides @p p of the six and @p q of the four. The cubic terms are
/// multiplied by the factor's weight; the others are then solved for the remaining right hand side.
void solveCubic(const CubicFactor& factor, const double l[6][6], const double p[6], const double q[4],
  double x[10]) noexcept;

/// Returns the ten terms of the height and the row that gives k0.
simd::TracedFit withCubicTerms(
  const simd::FitSums& sums, const simd::CubicSums& cubic, const double l[6][6], double cubicWeight) noexcept;

/// Estimates the noise from the weighted residuals, and the diagonal of A^-1 (sum W^2/n P P') A^-1 for k0,
/// k1, k2. @param inverse their rows of A^-1, over @p terms terms, the rest zero.
void errorsOf(const simd::FitRows& rows, const simd::FitSums& sums, const double inverse[3][10], int terms,
  double residual, double rho, SurfaceFitError& error) noexcept;

/// Adds the derivative of the fit with respect to its own origin to k1 and k2. Moving along a changes every
/// weight, by the distance and by rho, and turns the frame with the surface; the normal equations
/// differentiated give A dk = S, of which the height's part counts.
void traceSlopes(const simd::TraceSums& sums, double strength, SurfaceFit& fit) noexcept;

} // namespace pointhaptics
