#include "Benchmark/Bandwidth/Expected.h"

#include "Core/Reference/ReferenceBandwidth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace bench
{
namespace bandwidth
{
namespace
{

constexpr double kOursMayDiffer = 1e-9;
constexpr double kOthersMayDiffer = 1e-4;

ExpectedPoint expectedAt(const BandwidthTask& task, std::int64_t center, std::vector<Neighbor>& all)
{
  all.clear();
  for (std::int64_t i = 0; i < task.points.size(); ++i)
  {
    all.push_back({ norm2(task.points[i] - task.points[center]), i });
  }
  const std::ptrdiff_t count = std::min<std::ptrdiff_t>(task.neighbors + 1, std::ptrdiff_t(all.size()));
  std::nth_element(all.begin(), all.begin() + count - 1, all.end());
  std::vector<std::int64_t> indices;
  std::for_each(all.begin(), all.begin() + count, [&](const Neighbor& n) { indices.push_back(n.index); });
  const auto n = (long double)(count);
  const long double b = reference::bandwidthFactor(BandwidthRule::NormalReference, n, 2) *
    reference::surfaceSpread(task.points, indices);
  const long double farthest = all[std::size_t(count - 1)].squaredDistance;
  const long double spacing = std::sqrt(farthest * 3.14159265358979323846264338327950288L / (n - 1));
  ExpectedPoint point;
  point.index = std::size_t(center);
  point.bandwidth = double(b);
  point.radius = double(std::max(kRadiusScale * b, kSmallestRadiusInSpacings * spacing));
  return point;
}

double relativeError(double value, double expected)
{
  const double error = std::fabs(value / expected - 1.0);
  return std::isfinite(error) ? error : INFINITY;
}

} // namespace

std::vector<ExpectedPoint> expectedPoints(const BandwidthTask& task, int count)
{
  std::vector<ExpectedPoint> expected;
  std::vector<Neighbor> all;
  const std::int64_t step = std::max<std::int64_t>(1, task.points.size() / count);
  for (std::int64_t i = 0; i < task.points.size(); i += step)
  {
    const ExpectedPoint point = expectedAt(task, i, all);
    if (point.bandwidth > 0.0)
    {
      expected.push_back(point);
    }
  }
  return expected;
}

Verdict judge(const BandwidthAnswer& answer, const std::vector<ExpectedPoint>& expected, bool isOurs)
{
  const double tolerance = isOurs ? kOursMayDiffer : kOthersMayDiffer;
  Verdict verdict;
  std::size_t different = 0;
  for (const ExpectedPoint& point : expected)
  {
    const bool there = point.index < answer.bandwidths.size() && point.index < answer.radii.size();
    const double error = there ? std::max(relativeError(answer.bandwidths[point.index], point.bandwidth),
                                   relativeError(answer.radii[point.index], point.radius))
                               : INFINITY;
    verdict.worstError = std::max(verdict.worstError, error);
    different += error > tolerance ? 1 : 0;
  }
  verdict.right = different == 0;
  verdict.text = verdict.right ? fmt::format("right to {:.1g}", verdict.worstError)
                               : fmt::format("{}{} of {} differ by up to {:.2g} %", isOurs ? "wrong: " : "",
                                   different, expected.size(), 100.0 * verdict.worstError);
  return verdict;
}

} // namespace bandwidth
} // namespace bench
} // namespace pointhaptics
