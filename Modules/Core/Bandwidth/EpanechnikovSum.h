/// @file
/// Epanechnikov kernel sums over a univariate sample at any number of targets.
#pragma once

#include "Core/Bandwidth/SampleCells.h"
#include "Core/Base/Status.h"

#include <cstdint>
#include <vector>

namespace pointhaptics
{

/// E(y) = sum_i (1 - (y - x_i)^2 / w^2) over the values closer than w, the half width.
///
/// Method: running sums of u and u^2 within cells of values at most w wide, u the offset from the cell's
/// centre over w; a target takes differences of them in at most four cells. Nothing is truncated.
/// Error: below 1e-14 m, m the number of values within w (asserted in EpanechnikovSumTest; rounding of the
/// running sums is compensated). Cost: a binary search for each target. Memory 40 bytes a value.
/// Range, order and threads as for GaussianSum.
class EpanechnikovSum
{
public:
  /// As GaussianSum::build, for the half width w.
  Status build(const double* sample, std::int64_t count, double halfWidth);
  /// E at @p target; 0 where that is not finite.
  double sum(double target) const noexcept;
  /// Density estimate 3 E / (4 n w), per unit of the values.
  double density(double target) const noexcept;
  std::int64_t size() const noexcept { return std::int64_t(sorted_.size()); }

private:
  double cellSum(
    const detail::SampleCell& cell, std::int64_t begin, std::int64_t end, double target) const noexcept;

  template <typename Before>
  std::int64_t edge(const detail::SampleCell& cell, Before&& before) const noexcept;

  struct Running
  {
    detail::CompensatedSum first;  ///< Of u over the cell's points up to and with this one.
    detail::CompensatedSum second; ///< Of u^2.
  };
  void accumulate(const detail::SampleCell& cell);

  double halfWidth_ = 1.0;
  std::vector<double> sorted_;
  std::vector<detail::SampleCell> cells_;
  std::vector<Running> running_;
};

} // namespace pointhaptics
