#include "Core/Bandwidth/Density.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace pointhaptics
{
namespace
{

constexpr double kPi = 3.14159265358979323846;
constexpr double kTwoPi = 6.28318530717958647693;

double weightOf(const std::vector<double>& counts, std::int64_t index)
{
  return counts.empty() ? 1.0 : std::max(1.0, counts[std::size_t(index)]);
}

/// What each kernel counts, by slot, and the sum of all.
struct Weights
{
  const NeighborQuery& query;
  const std::vector<double> ofPlaces; ///< The points of each place together; empty: 1 each.
  double total = 0.0;
  /// A power of two by which the total is at most OrderedSum::kMost.
  double scale = 1.0;

  double at(std::int64_t slot) const
  {
    return scale * (ofPlaces.empty() ? 1.0 : ofPlaces[std::size_t(slot)]);
  }
};

std::vector<double> weightsOfPlaces(const NeighborQuery& query, const std::vector<double>& counts)
{
  return counts.empty() && query.finitePoints() == query.size()
    ? std::vector<double>()
    : query.valuesOfPlaces([&](std::int64_t index) { return weightOf(counts, index); }, std::plus<>());
}

/// A sum of numbers from 0 to 2^34 that does not depend on their order: each is cut to multiples of 2^-60, in
/// two words.
class OrderedSum
{
public:
  static constexpr double kMost = 0x1p34;

  void add(double value)
  {
    const double scaled = value * kHighScale;
    const auto high = std::int64_t(scaled);
    high_ += high;
    low_ += std::int64_t((scaled - double(high)) * kLowScale);
  }
  double value() const
  {
    const std::int64_t carry = low_ >> kLowBits;
    const std::int64_t low = low_ - (carry << kLowBits);
    return (double(high_ + carry) + double(low) / kLowScale) / kHighScale;
  }

private:
  static constexpr int kLowBits = 34;
  static constexpr double kHighScale = 0x1p26;
  static constexpr double kLowScale = 0x1p34;
  std::int64_t high_ = 0;
  std::int64_t low_ = 0;
};

double densityAt(const Weights& weights, const Vec3& center, double b, DensityKernel kernel)
{
  const bool isGaussian = kernel == DensityKernel::Gaussian;
  const double reach = densityReach(kernel) * b;
  OrderedSum sum;
  weights.query.visitBallSlots(center, reach,
    [&](double d2, std::int64_t slot)
    {
      const double height =
        isGaussian ? std::exp(-0.5 * d2 / (b * b)) : std::max(0.0, 1.0 - d2 / (reach * reach));
      sum.add(weights.at(slot) * height);
    });
  const double all = weights.scale * weights.total;
  return sum.value() / (isGaussian ? all * kTwoPi * b * b : all * 0.5 * kPi * reach * reach);
}

}

double totalWeight(const PointView& points, const std::vector<double>& counts)
{
  double total = 0.0;
  for (std::int64_t i = 0; i < points.size(); ++i)
  {
    total += isFinite(points[i]) ? weightOf(counts, i) : 0.0;
  }
  return total;
}

double densityReach(DensityKernel kernel)
{
  return kernel == DensityKernel::Epanechnikov ? kEpanechnikovReachOnSurface : kDensityCutoff;
}

void surfaceDensities(const PointView& points, const std::vector<double>& counts, const NeighborQuery& query,
  const std::vector<double>& bandwidths, std::vector<double>& densities, const Executor& executor,
  DensityKernel kernel, std::optional<double> given)
{
  const double total = given ? *given : totalWeight(points, counts);
  densities.assign(std::size_t(points.size()), 0.0);
  if (!std::isfinite(total))
  {
    return;
  }
  Weights weights{ query, weightsOfPlaces(query, counts), total };
  while (weights.scale * total > OrderedSum::kMost)
  {
    weights.scale *= 0.5;
  }
  // In spatial order, where the points of one ball after the other are close in memory.
  forEachIndex(executor, query.size(),
    [&](std::int64_t slot)
    {
      const std::size_t i = std::size_t(query.index(slot));
      if (bandwidths[i] > 0.0)
      {
        densities[i] = densityAt(weights, query.point(slot), bandwidths[i], kernel);
      }
    });
  query.copyToRepeats(densities);
}

} // namespace pointhaptics
