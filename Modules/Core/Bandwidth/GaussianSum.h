/// @file
/// Gaussian kernel sums over a univariate sample at any number of targets: O(n log n) once, then a cost for
/// each target that does not grow with n.
#pragma once

#include "Core/Bandwidth/SampleCells.h"
#include "Core/Base/Status.h"

#include <cstdint>
#include <vector>

namespace pointhaptics
{

/// G(y) = sum_i exp(-(y - x_i)^2 / (2 h^2)), right relative to G itself, in the tails too.
///
/// Method: after an idea of Raykar and Duraiswami 2006, here for sorted data, cut into cells of 0.4 to 0.5 h.
/// With u and t the offsets of x and y from a cell's centre over h, exp(-(t - u)^2 / 2) = exp(-t^2 / 2)
/// exp(-u^2 / 2) exp(u t), and exp(u t) is a power series: sums M_k = sum_i exp(-u_i^2 / 2) u_i^k / k! do not
/// depend on y. A target walks outwards over the cells from the nearest one. For cells of many values that is
/// done beforehand: there G itself is a power series in t.
///
/// Error: truncation is below epsilon G(y), epsilon = 2e-13 by default, for n <= 5e8.
/// - The nearest cell, of m values no further than r, gives G >= m exp(-r^2 / 2). What lies further than
///   sqrt(r^2 + 2 ln(4 n / (epsilon m))) is left out: at most epsilon G / 4.
/// - Walk: series are used where z = max |u t| <= 2. Stopped after p terms they leave out at most
///   2 z^p / p! m exp(-t^2 / 2), and they stop where that is below epsilon G / 128 (a walk meets fewer than
///   64 cells), or after 24 terms, where it is below 5e-16 of the cell's own sum, whose terms are all
///   positive.
/// - Beforehand: used for |t| <= 0.3 around cells of 64 values and more, where G >= 55. Two-fold series of 24
///   by 24 terms; by Cramer's bound |He_k(t)| exp(-t^2 / 2) <= 1.0865 sqrt(k!) each value leaves out at most
///   1.0865 sum_(a >= 24 or b >= 24) (0.3 sqrt 2)^a (0.24 sqrt 2)^b / sqrt(a! b!) < 4e-21.
/// Rounding was measured below 1e-14; GaussianSumTest asserts 1e-12 in all. Kernels below the smallest
/// normal number (37 h away) lose digits and count as 0 from 39 h on.
///
/// Cost: about 60 multiplications for each value once; for each target a binary search over the cells and 24
/// multiplications where values are dense, else some 40 cells with an exponential and about ten
/// multiplications each. Cells with |u t| > 2 are summed point by point: they are more than 8 h away, and
/// matter only to targets with few values or none nearby, which may cost up to n exponentials. Memory 8 to 70
/// bytes a value.
///
/// Range: any h > 0, any finite values whose differences are finite; large offsets and duplicates lose
/// nothing. The result depends on values and target only: not on their order, nor on threads.
///
/// Thread safety: sum() and density() from any number of threads after build(); they allocate nothing.
class GaussianSum
{
public:
  static constexpr double kSmallestError = 2e-13;

  /// Copies and sorts @p count values. @param relativeError epsilon, from kSmallestError to 0.1: a larger one
  /// saves time where values are sparse. InvalidParameter where @p bandwidth is not above 0 or not finite, a
  /// value is not finite or relativeError out of its range, Empty where count < 1: every sum is then 0.
  Status build(
    const double* sample, std::int64_t count, double bandwidth, double relativeError = kSmallestError);
  /// G at @p target; 0 where that is not finite.
  double sum(double target) const noexcept;
  /// Density estimate G / (n h sqrt(2 pi)), per unit of the values.
  double density(double target) const noexcept;
  std::int64_t size() const noexcept { return std::int64_t(sorted_.size()); }

private:
  static constexpr int kTerms = 24;

  void findMoments(const detail::SampleCell& cell);
  void expand(detail::SampleCell& cell);
  void addDerivatives(const detail::SampleCell& from, double center, double halfWidth, double* sums) const;
  double reach(const detail::SampleCell& nearest, double distance) const noexcept;
  double cellSum(const detail::SampleCell& cell, double target, double total) const noexcept;
  double walk(std::size_t nearest, double target) const noexcept;

  double bandwidth_ = 1.0;
  double logBudget_ = 0.0;  ///< 2 ln(n / part that may be left out).
  double seriesRest_ = 0.0; ///< Part of the sum that the rest of one cell's series may make up.
  std::vector<double> sorted_;
  std::vector<detail::SampleCell> cells_;
  /// kTerms for each cell with a series: sum_i u^k / k!, and the same with the weight exp(-u^2 / 2).
  std::vector<double> moments_;
  std::vector<double> weightedMoments_;
  std::vector<double> expansions_; ///< kTerms for each cell with an expansion: G is their power series in t.
};

} // namespace pointhaptics
