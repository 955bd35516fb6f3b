#include "Core/Bandwidth/GaussianSum.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace
{

using detail::SampleCell;

constexpr double kSqrtTwoPi = 2.50662827463100050242;
/// Largest |u t| that a series is used for.
constexpr double kLargestArgument = 2.0;
/// Shares of the error: a quarter is for the values beyond reach, half for the rests of the series of 64
/// cells.
constexpr double kLeftOutShare = 1.0 / 4.0;
constexpr double kSeriesRestShare = 1.0 / 2.0 / 64.0;
constexpr double kLargestError = 0.1;
/// exp(-t^2 / 2) is 0 from here on.
constexpr double kNothingBeyond = 39.0;
/// Cells of this many points get an expansion, used as far as this from their centre.
constexpr std::int64_t kExpansionCount = 64;
constexpr double kExpansionReach = 0.3;

}

Status GaussianSum::build(const double* sample, std::int64_t count, double bandwidth, double relativeError)
{
  cells_.clear();
  expansions_.clear();
  Status status = detail::copySorted(sample, count, bandwidth, sorted_);
  if (status == Status::Ok && !(relativeError >= kSmallestError && relativeError <= kLargestError))
  {
    sorted_.clear();
    status = Status::InvalidParameter;
  }
  if (status != Status::Ok)
  {
    return status;
  }
  bandwidth_ = bandwidth;
  logBudget_ = 2.0 * std::log(double(count) / (kLeftOutShare * relativeError));
  seriesRest_ = kSeriesRestShare * relativeError;
  // Where a value is near, series then do for all that is within reach.
  const double width = 2.0 * kLargestArgument / std::sqrt(logBudget_);
  const std::int64_t series = detail::splitIntoCells(sorted_.data(), count, bandwidth, width, cells_);
  moments_.resize(std::size_t(series) * kTerms);
  weightedMoments_.resize(std::size_t(series) * kTerms);
  for (const SampleCell& cell : cells_)
  {
    findMoments(cell);
  }
  for (SampleCell& cell : cells_)
  {
    expand(cell);
  }
  return Status::Ok;
}

void GaussianSum::findMoments(const SampleCell& cell)
{
  if (cell.series >= 0)
  {
    detail::cellMoments<kTerms>(
      sorted_.data(), cell, bandwidth_, [](double) { return 1.0; }, moments_.data() + cell.series * kTerms);
    detail::cellMoments<kTerms>(
      sorted_.data(), cell, bandwidth_, [](double u) { return std::exp(-0.5 * u * u); },
      weightedMoments_.data() + cell.series * kTerms);
  }
}

/// The power series of G about the centre of @p cell: G^(k) / k!.
void GaussianSum::expand(SampleCell& cell)
{
  cell.expansion = -1;
  if (cell.count() < kExpansionCount)
  {
    return;
  }
  cell.expansion = std::int64_t(expansions_.size()) / kTerms;
  double sums[kTerms] = {};
  const double far = reach(cell, kExpansionReach) + kExpansionReach + cell.halfWidth;
  const std::size_t self = std::size_t(&cell - cells_.data());
  addDerivatives(cell, cell.first, cell.halfWidth, sums);
  for (std::size_t c = self + 1; c < cells_.size() && cells_[c].gap(cell.last, bandwidth_) <= far; ++c)
  {
    addDerivatives(cells_[c], cell.first, cell.halfWidth, sums);
  }
  for (std::size_t c = self; c > 0 && cells_[c - 1].gap(cell.first, bandwidth_) <= far; --c)
  {
    addDerivatives(cells_[c - 1], cell.first, cell.halfWidth, sums);
  }
  constexpr std::array<double, kTerms> inverse = detail::inverseFactorials<kTerms>();
  for (int k = 0; k < kTerms; ++k)
  {
    expansions_.push_back((k % 2 == 0 ? sums[k] : -sums[k]) * inverse[std::size_t(k)]);
  }
}

/// Adds sum_i He_k(D - u_i) exp(-(D - u_i)^2 / 2) over the points of @p from to sums[k], D - u_i being the
/// distance over h of the point @p center + @p halfWidth h from them.
void GaussianSum::addDerivatives(const SampleCell& from, double center, double halfWidth, double* sums) const
{
  double table[2 * kTerms];
  if (from.series < 0)
  {
    for (std::int64_t i = from.begin; i < from.end; ++i)
    {
      detail::hermiteTable((center - sorted_[std::size_t(i)]) / bandwidth_ + halfWidth, 0, kTerms, table);
      for (int k = 0; k < kTerms; ++k)
      {
        sums[k] += table[k];
      }
    }
    return;
  }
  const double distance = (center - from.first) / bandwidth_ + (halfWidth - from.halfWidth);
  detail::hermiteTable(distance, 0, 2 * kTerms, table);
  const double* moments = moments_.data() + from.series * kTerms;
  for (int j = kTerms - 1; j >= 0; --j)
  {
    for (int k = 0; k < kTerms; ++k)
    {
      sums[k] += moments[j] * table[j + k];
    }
  }
}

/// How far from a target the values are to be summed, if it is @p distance from the centre of @p nearest.
double GaussianSum::reach(const SampleCell& nearest, double distance) const noexcept
{
  const double far = distance + nearest.halfWidth;
  return std::sqrt(std::max(0.0, logBudget_ + far * far - 2.0 * std::log(double(nearest.count()))));
}

/// What @p cell adds at @p target, @p total having been found already.
double GaussianSum::cellSum(const SampleCell& cell, double target, double total) const noexcept
{
  const double t = cell.offset(target, bandwidth_);
  const double z = std::fabs(t) * cell.halfWidth;
  if (cell.series < 0 || !(z <= kLargestArgument))
  {
    double sum = 0.0;
    for (std::int64_t i = cell.begin; i < cell.end; ++i)
    {
      const double u = (target - sorted_[std::size_t(i)]) / bandwidth_;
      sum += std::exp(-0.5 * u * u);
    }
    return sum;
  }
  static constexpr std::array<double, kTerms + 1> kInverse = detail::inverseFactorials<kTerms + 1>();
  const double* moments = weightedMoments_.data() + cell.series * kTerms;
  const double height = std::exp(-0.5 * t * t);
  const double enough = seriesRest_ * total / (2.0 * height * double(cell.count()));
  double sum = 0.0;
  double powerOfT = 1.0;
  double powerOfZ = 1.0;
  for (int k = 0; k < kTerms; ++k)
  {
    sum += powerOfT * moments[k];
    powerOfT *= t;
    powerOfZ *= z;
    // From the third term on each is at most half the one before.
    if (k >= 2 && powerOfZ * kInverse[std::size_t(k + 1)] <= enough)
    {
      break;
    }
  }
  return height * sum;
}

double GaussianSum::walk(std::size_t nearest, double target) const noexcept
{
  const double far = reach(cells_[nearest], std::fabs(cells_[nearest].offset(target, bandwidth_)));
  double total = cellSum(cells_[nearest], target, 0.0);
  for (std::size_t c = nearest + 1; c < cells_.size() && cells_[c].gap(target, bandwidth_) <= far; ++c)
  {
    total += cellSum(cells_[c], target, total);
  }
  for (std::size_t c = nearest; c > 0 && cells_[c - 1].gap(target, bandwidth_) <= far; --c)
  {
    total += cellSum(cells_[c - 1], target, total);
  }
  return total;
}

double GaussianSum::sum(double target) const noexcept
{
  if (cells_.empty() || !std::isfinite(target))
  {
    return 0.0;
  }
  std::size_t nearest = detail::cellAfter(cells_, target);
  if (nearest == cells_.size() ||
    (nearest > 0 && cells_[nearest - 1].gap(target, bandwidth_) <= cells_[nearest].gap(target, bandwidth_)))
  {
    --nearest;
  }
  const SampleCell& cell = cells_[nearest];
  const double t = cell.offset(target, bandwidth_);
  if (cell.expansion >= 0 && std::fabs(t) <= kExpansionReach)
  {
    const double* coefficients = expansions_.data() + cell.expansion * kTerms;
    double sum = 0.0;
    for (int k = kTerms - 1; k >= 0; --k)
    {
      sum = sum * t + coefficients[k];
    }
    return sum;
  }
  return cell.gap(target, bandwidth_) < kNothingBeyond ? walk(nearest, target) : 0.0;
}

double GaussianSum::density(double target) const noexcept
{
  return cells_.empty() ? 0.0 : sum(target) / (double(size()) * kSqrtTwoPi) / bandwidth_;
}

} // namespace pointhaptics
