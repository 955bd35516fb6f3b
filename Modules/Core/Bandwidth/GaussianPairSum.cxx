#include "Core/Bandwidth/GaussianPairSum.h"

#include <cmath>

namespace pointhaptics
{
namespace
{

using detail::SampleCell;

constexpr double kCellWidth = 0.5;
constexpr double kReach = 11.0;

/// He_order(t) exp(-t^2 / 2).
double derivativeAt(double t, int order)
{
  const double q = t * t;
  const double height = std::exp(-0.5 * q);
  return order == 4 ? ((q - 6.0) * q + 3.0) * height : (((q - 15.0) * q + 45.0) * q - 15.0) * height;
}

}

double GaussianPairSum::bothSeries(const SampleCell& a, const SampleCell& b) const
{
  double table[kTerms];
  const double distance = (a.first - b.first) / bandwidth_ + (a.halfWidth - b.halfWidth);
  detail::hermiteTable(distance, order_, kTerms, table);
  const double* ma = moments(a);
  const double* mb = moments(b);
  // inner[j] = sum_i (-1)^i ma[i] table[i + j]
  double inner[kTerms] = {};
  for (int i = 0; i < kTerms; ++i)
  {
    const double factor = i % 2 == 0 ? ma[i] : -ma[i];
    for (int j = 0; j < kTerms - i; ++j)
    {
      inner[j] += factor * table[i + j];
    }
  }
  double sum = 0.0;
  for (int j = kTerms - 1; j >= 0; --j)
  {
    sum += mb[j] * inner[j];
  }
  return sum;
}

double GaussianPairSum::pointsAgainstSeries(const SampleCell& points, const SampleCell& series) const
{
  const double* m = moments(series);
  double table[kTerms];
  double sum = 0.0;
  for (std::int64_t i = points.begin; i < points.end; ++i)
  {
    detail::hermiteTable(series.offset(sorted_[i], bandwidth_), order_, kTerms, table);
    double terms = 0.0;
    for (int k = kTerms - 1; k >= 0; --k)
    {
      terms += m[k] * table[k];
    }
    sum += terms;
  }
  return sum;
}

double GaussianPairSum::everyPair(const SampleCell& a, const SampleCell& b) const
{
  const bool same = a.begin == b.begin;
  double sum = 0.0;
  for (std::int64_t i = a.begin; i < a.end; ++i)
  {
    for (std::int64_t j = same ? i + 1 : b.begin; j < b.end; ++j)
    {
      sum += derivativeAt((sorted_[i] - sorted_[j]) / bandwidth_, order_);
    }
  }
  return same ? 2.0 * sum + double(a.count()) * derivativeAt(0.0, order_) : sum;
}

double GaussianPairSum::cellPair(const SampleCell& a, const SampleCell& b) const
{
  if (a.series >= 0 && b.series >= 0)
  {
    return bothSeries(a, b);
  }
  if (a.series >= 0)
  {
    return pointsAgainstSeries(b, a);
  }
  return b.series >= 0 ? pointsAgainstSeries(a, b) : everyPair(a, b);
}

double GaussianPairSum::sum(
  const double* sorted, std::int64_t count, double bandwidth, GaussianDerivative derivative)
{
  if (count < 1 || !(bandwidth > 0.0) || !std::isfinite(bandwidth))
  {
    return 0.0;
  }
  sorted_ = sorted;
  bandwidth_ = bandwidth;
  order_ = int(derivative);
  const std::int64_t series = detail::splitIntoCells(sorted, count, bandwidth, kCellWidth, cells_);
  moments_.resize(std::size_t(series) * kTerms);
  for (const SampleCell& cell : cells_)
  {
    if (cell.series >= 0)
    {
      detail::cellMoments<kTerms>(sorted, cell, bandwidth, moments_.data() + cell.series * kTerms);
    }
  }
  detail::CompensatedSum total;
  for (std::size_t a = 0; a < cells_.size(); ++a)
  {
    total.add(cellPair(cells_[a], cells_[a]));
    for (std::size_t b = a + 1; b < cells_.size() && (cells_[b].first - cells_[a].last) / bandwidth <= kReach;
         ++b)
    {
      total.add(2.0 * cellPair(cells_[a], cells_[b]));
    }
  }
  return total.value();
}

} // namespace pointhaptics
