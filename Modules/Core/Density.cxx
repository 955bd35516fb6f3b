#include "Core/Density.h"

#include <cmath>

namespace pointhaptics
{
namespace
{
constexpr double kTwoPi = 6.28318530717958647693;
}

double gaussianDensity(double x, const double* sample, std::int64_t count, double bandwidth) noexcept
{
  if (count < 1 || !(bandwidth > 0.0))
  {
    return 0.0;
  }
  double sum = 0.0;
  for (std::int64_t i = 0; i < count; ++i)
  {
    const double u = (x - sample[i]) / bandwidth;
    sum += std::exp(-0.5 * u * u);
  }
  return sum / (double(count) * bandwidth * std::sqrt(kTwoPi));
}

void surfaceDensities(const PointView& points, const NeighborQuery& query,
  const std::vector<double>& bandwidths, std::vector<double>& densities, const Executor& executor)
{
  densities.assign(std::size_t(points.size()), 0.0);
  forRange(executor, points.size(),
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t i = begin; i < end; ++i)
      {
        const double b = bandwidths[std::size_t(i)];
        const Vec3 center = points[i];
        if (!(b > 0.0) || !isFinite(center))
        {
          continue;
        }
        double sum = 0.0;
        query.visitBall(center, kDensityCutoff * b,
          [&](const Vec3&, double d2, std::int64_t) { sum += std::exp(-0.5 * d2 / (b * b)); });
        densities[std::size_t(i)] = sum / (double(query.size()) * kTwoPi * b * b);
      }
    });
}

} // namespace pointhaptics
