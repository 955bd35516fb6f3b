/// @file
/// Sums of a derivative of a Gaussian over all pairs of a univariate sample, in linear time, for
/// the Sheather-Jones bandwidth.
#pragma once

#include "Core/Bandwidth/SampleCells.h"

#include <cstdint>
#include <vector>

namespace pointhaptics
{

/// The derivative of exp(-t^2 / 2) that is summed: He_r(t) exp(-t^2 / 2), He_r the Hermite polynomial with
/// leading coefficient 1: t^4 - 6 t^2 + 3, t^6 - 15 t^4 + 45 t^2 - 15.
enum class GaussianDerivative
{
  Fourth = 4,
  Sixth = 6
};

/// sum_i sum_j H_r((x_i - x_j) / h), both over the whole sample, i = j among them; H_r as above.
///
/// Method: after an idea of Raykar and Duraiswami 2006, here for sorted data. The sample is cut into cells at
/// most h/2 wide. With D the distance of two cells' centres and u, v the offsets in them, all over h,
/// H_r(D + u - v) = sum_ab H_(r+a+b)(D) (-u)^a v^b / (a! b!), so that two cells need only the power sums of
/// their points. Cells with few points are summed point by point.
///
/// Error: by Cramer's bound |H_k(t)| <= 1.0865 sqrt(k!) the series, cut at a + b < 28, is within
/// 1.0865 sqrt((28 + r)!) / 28! 2^-28 < 3e-19 of H_r for each pair, and pairs more than 11 h apart, left out,
/// have |H_r| < 1e-20. Truncation is thus below 3e-19 n^2, less than rounding, which was measured below
/// 4e-16 |H_r(0)| n^2; GaussianPairSumTest asserts 1e-15 |H_r(0)| n^2 in all. Relative to the sum itself the
/// error is larger where terms of both signs cancel: 2e-12 for the pilot sums of a Sheather-Jones bandwidth
/// of 409,600 values.
///
/// Cost: about 28 multiplications for each value and 400 for each two cells within 11 h; at most n cells.
/// Range: any h > 0, any finite values whose differences are finite; large offsets and duplicates lose
/// nothing. The result depends on the values only: not on threads, nor on former calls.
/// An object keeps its memory from call to call and is for one thread at a time.
class GaussianPairSum
{
public:
  /// @p sorted: @p count ascending finite values; @p bandwidth h in their unit. 0 where count < 1 or h is not
  /// above 0 or not finite.
  double sum(const double* sorted, std::int64_t count, double bandwidth, GaussianDerivative derivative);

private:
  static constexpr int kTerms = 28;

  double cellPair(const detail::SampleCell& a, const detail::SampleCell& b) const;
  double bothSeries(const detail::SampleCell& a, const detail::SampleCell& b) const;
  double pointsAgainstSeries(const detail::SampleCell& points, const detail::SampleCell& series) const;
  double everyPair(const detail::SampleCell& a, const detail::SampleCell& b) const;
  const double* moments(const detail::SampleCell& cell) const
  {
    return moments_.data() + cell.series * kTerms;
  }

  const double* sorted_ = nullptr; ///< Valid during sum() only, as are the next two.
  double bandwidth_ = 1.0;
  int order_ = 0;
  std::vector<detail::SampleCell> cells_;
  std::vector<double> moments_; ///< kTerms for each cell with a series: sum u^k / k!.
};

} // namespace pointhaptics
