/// @file
/// The solution of the fit's normal equations, and what else it tells. Private to SurfaceFit.
#pragma once

#include "Core/Kernel/FitKernel.h"
#include "Core/SurfaceFit.h"

namespace pointhaptics
{

/// Cholesky factor of the leading n x n block, its diagonal inverted; false at a relative pivot that is too
/// small.
bool factor(const kernel::FitSums& sums, int n, double l[6][6]) noexcept;

/// Solves L L' k = rhs for the leading n unknowns, the diagonal of @p l inverted.
void backSolve(const double l[6][6], int n, const double rhs[6], double k[6]) noexcept;

/// Noise from the weighted residuals, and the diagonal of A^-1 (sum W^2/n P P') A^-1 for k0, k1, k2.
void errorsOf(const kernel::FitRows& rows, const kernel::FitSums& sums, const double l[6][6], int n,
  double residual, double rho, SurfaceFitError& error) noexcept;

/// Solves the ten equations of quadratic and cubic terms together, from the factor @p l of the six. The cubic
/// terms are multiplied by @p share, 0 to 1, and fade out where the cells hardly determine them; the others
/// are then the best beside what is left of those.
kernel::TracedFit withCubicTerms(
  const kernel::FitSums& sums, const kernel::CubicSums& cubic, const double l[6][6], double share) noexcept;

/// Adds the derivative of the fit with respect to its own origin to k1 and k2. Moving along a changes every
/// weight, by the distance and by rho, and turns the frame with the surface; the normal equations
/// differentiated give A dk = S, of which the height's part counts.
void traceSlopes(const kernel::TraceSums& sums, double strength, SurfaceFit& fit) noexcept;

} // namespace pointhaptics
