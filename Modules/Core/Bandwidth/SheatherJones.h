/// @file
/// The plug-in bandwidths of Sheather and Jones for univariate data.
#pragma once

#include "Core/Bandwidth/GaussianPairSum.h"
#include "Core/Base/Status.h"

#include <cstdint>

namespace pointhaptics
{

/// Source: Sheather and Jones 1991. With n values of scale s and the estimates
///   S(g) = sum_ij H_4((x_i - x_j) / g) / (n (n - 1) sqrt(2 pi) g^5) of the integral of f''^2,
///   T(g) = -sum_ij H_6((x_i - x_j) / g) / (n (n - 1) sqrt(2 pi) g^7) of the integral of f'''^2
/// (sums with i = j; H_r as in GaussianPairSum.h) and the pilot bandwidths a = 1.24 s n^(-1/7),
/// b = 1.23 s n^(-1/9):
///   solveTheEquation: b solves h = (2 sqrt(pi) n S(g(h)))^(-1/5), g(h) = 1.357 (S(a) / T(b))^(1/7) h^(5/7),
///   directPlugIn: h = (2 sqrt(pi) n S((2.394 / (n T(b)))^(1/7)))^(-1/5).
/// The same as R's bw.SJ with methods "ste" and "dpi" on data that are not binned. S and T are never
/// negative and the equation always has a solution. It may have several where values coincide or cluster. The
/// search begins at 1.144 s n^(-1/5), goes down if the left-hand side is the larger one there, else up, in
/// steps of a fifth, and takes the first solution it meets.
///
/// Accuracy: within 1e-9 relative of the exact sums and solution, about 1e-12 as measured
/// (SheatherJonesTest). b scales with the sample and does not change when it is shifted.
///
/// Cost: 10 to 20 evaluations of the pair sums, O(n + cells) each: 0.1 s for 400,000 values. An object keeps
/// its memory, so that later samples of no greater size allocate nothing; one thread at a time.
class SheatherJones
{
public:
  /// @p sorted: @p count ascending finite values; @p scale s in their unit: min(sd, IQR / 1.349), or sd where
  /// the quartiles coincide. @p bandwidth in their unit. Errors, which leave @p bandwidth untouched:
  /// DegenerateSample where count < 2 or scale is not above 0 or not finite; EquationUnsolved where no
  /// positive finite solution was found within a factor of 1e15, as where the values stand at the end of the
  /// range of double numbers.
  Status solveTheEquation(const double* sorted, std::int64_t count, double scale, double& bandwidth);
  Status directPlugIn(const double* sorted, std::int64_t count, double scale, double& bandwidth);

private:
  Status begin(const double* sorted, std::int64_t count, double scale);
  double roughness(double g, int derivative);
  double optimal(double g);
  double excess(double logarithm);
  bool bracket(double& low, double& high, double& atLow, double& atHigh);
  double root(double low, double high, double atLow, double atHigh);

  // Values of the present sample; bandwidths are in units of scale_, which keeps their powers in range.
  const double* sorted_ = nullptr;
  std::int64_t count_ = 0;
  double n_ = 0.0;
  double scale_ = 1.0;
  double thirdDerivative_ = 0.0; ///< T(b).
  double pilotFactor_ = 0.0;     ///< 1.357 (S(a) / T(b))^(1/7).
  GaussianPairSum sums_;
};

} // namespace pointhaptics
