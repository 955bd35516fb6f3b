/// @file
/// The solution of the fit's normal equations, with its standard errors. Private to SurfaceFit.
#pragma once

#include "Core/Surface/FitKernel.h"
#include "Core/Surface/SurfaceFit.h"

namespace pointhaptics
{

/// Cholesky factor of the normal equations, its diagonal inverted.
struct FitFactor
{
  double l[10][10];
  int terms = 0; ///< 3: a plane, 6: a quadric, 10: with the cubic terms.
  /// Factor of the cubic terms' coefficients: as asked for, or less where the cells hardly determine them.
  double cubicWeight = 0.0;
};

/// Factors the equations of @p terms terms, 3 or 6; false at a relative pivot that is too small.
bool factor(const simd::FitSums& sums, int terms, FitFactor& factor) noexcept;
/// Adds the rows of the cubic terms to a factor of six. @param weight 0 to 1.
void addCubicTerms(const simd::FitSums& sums, double weight, FitFactor& factor) noexcept;

/// Solves for the terms of the factor; other elements of @p x stay. Cubic terms are multiplied by their
/// weight; the others are then solved for the remaining right hand side.
void solve(const FitFactor& factor, const double* rhs, double* x) noexcept;
/// Row @p term of the inverse normal matrix, below 3; 0 beyond the terms.
void inverseRow(const FitFactor& factor, int term, double row[10]) noexcept;

/// Estimates the noise from the weighted residuals, and the diagonal of A^-1 (sum W^2/n P P') A^-1 for k0,
/// k1, k2.
void errorsOf(const simd::FitRows& rows, const simd::FitSums& sums, const FitFactor& factor, double residual,
  double rho, SurfaceFitError& error) noexcept;

/// Adds the derivative of the fit with respect to its own origin to k1 and k2. Moving along a changes every
/// weight, by the distance and by rho, and turns the frame with the surface; the normal equations
/// differentiated give A dk = S, of which the height's part counts.
void traceSlopes(const simd::TraceSums& sums, double strength, SurfaceFit& fit) noexcept;

} // namespace pointhaptics
