#include "Core/Bandwidth/EpanechnikovSum.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace
{

using detail::SampleCell;

/// So few points are summed one by one, which is as fast and keeps the digits of points near the edge.
constexpr std::int64_t kOneByOne = 8;

}

Status EpanechnikovSum::build(const double* sample, std::int64_t count, double halfWidth)
{
  cells_.clear();
  running_.clear();
  const Status status = detail::copySorted(sample, count, halfWidth, sorted_);
  if (status != Status::Ok)
  {
    return status;
  }
  halfWidth_ = halfWidth;
  detail::splitIntoCells(sorted_.data(), count, halfWidth, 1.0, cells_);
  running_.resize(sorted_.size());
  for (const SampleCell& cell : cells_)
  {
    accumulate(cell);
  }
  return Status::Ok;
}

void EpanechnikovSum::accumulate(const SampleCell& cell)
{
  Running running;
  for (std::int64_t i = cell.begin; i < cell.end; ++i)
  {
    const double u = cell.offset(sorted_[std::size_t(i)], halfWidth_);
    running.first.add(u);
    running.second.add(u * u);
    running_[std::size_t(i)] = running;
  }
}

/// Over points [begin, end) of @p cell, all of them closer to @p target than the half width.
double EpanechnikovSum::cellSum(
  const SampleCell& cell, std::int64_t begin, std::int64_t end, double target) const noexcept
{
  if (end - begin <= kOneByOne)
  {
    double sum = 0.0;
    for (std::int64_t i = begin; i < end; ++i)
    {
      const double u = (target - sorted_[std::size_t(i)]) / halfWidth_;
      sum += (1.0 - u) * (1.0 + u);
    }
    return sum;
  }
  const Running& upTo = running_[std::size_t(end - 1)];
  const Running before = begin > cell.begin ? running_[std::size_t(begin - 1)] : Running();
  const double t = cell.offset(target, halfWidth_);
  return (1.0 - t) * (1.0 + t) * double(end - begin) + 2.0 * t * upTo.first.minus(before.first) -
    upTo.second.minus(before.second);
}

/// How many values are @p before the edge of the kernel, the edge lying in @p cell, after what it holds, or
/// before all cells. Values at the edge itself add 0, so that a rounding of its position does not matter.
template <typename Before>
std::int64_t EpanechnikovSum::edge(const SampleCell& cell, Before&& before) const noexcept
{
  return std::partition_point(sorted_.begin() + cell.begin, sorted_.begin() + cell.end, before) -
    sorted_.begin();
}

double EpanechnikovSum::sum(double target) const noexcept
{
  if (cells_.empty() || !std::isfinite(target))
  {
    return 0.0;
  }
  const std::size_t first = std::max<std::size_t>(detail::cellAfter(cells_, target - halfWidth_), 1) - 1;
  const std::size_t last = std::max<std::size_t>(detail::cellAfter(cells_, target + halfWidth_), 1) - 1;
  const std::int64_t begin = edge(cells_[first], [&](double value) { return target - value >= halfWidth_; });
  const std::int64_t end = edge(cells_[last], [&](double value) { return value - target < halfWidth_; });
  double total = 0.0;
  for (std::size_t c = first; c <= last; ++c)
  {
    const SampleCell& cell = cells_[c];
    total += cellSum(cell, std::max(begin, cell.begin), std::min(end, cell.end), target);
  }
  return total;
}

double EpanechnikovSum::density(double target) const noexcept
{
  return cells_.empty() ? 0.0 : 0.75 * sum(target) / double(size()) / halfWidth_;
}

} // namespace pointhaptics
