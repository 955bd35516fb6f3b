#include "FrameBudget.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace
{

/// Weight of a frame in the next estimate: about the last seven count.
constexpr double kMemory = 0.85;
/// Part of the frame that is planned; the rest is a reserve for variation.
constexpr double kPlannedPart = 0.9;
/// A line is fitted if the numbers of points spread by more than this, over their mean.
constexpr double kEnoughSpread = 0.05;

} // namespace

FrameBudget::FrameBudget(double secondsPerFrame)
  : SecondsPerFrame(secondsPerFrame)
{
}

void FrameBudget::add(std::int64_t points, double seconds)
{
  if (points <= 0 || !(seconds > 0.0) || !std::isfinite(seconds))
  {
    return;
  }
  const double n = double(points);
  this->Weight = kMemory * this->Weight + 1.0;
  this->SumPoints = kMemory * this->SumPoints + n;
  this->SumSeconds = kMemory * this->SumSeconds + seconds;
  this->SumPointsSquared = kMemory * this->SumPointsSquared + n * n;
  this->SumProducts = kMemory * this->SumProducts + n * seconds;

  const double mean = this->SumPoints / this->Weight;
  const double meanSeconds = this->SumSeconds / this->Weight;
  const double variance = this->SumPointsSquared / this->Weight - mean * mean;
  const double covariance = this->SumProducts / this->Weight - mean * meanSeconds;
  const double planned = kPlannedPart * this->SecondsPerFrame;
  double fitting = n * planned / seconds;
  if (variance > kEnoughSpread * kEnoughSpread * mean * mean && covariance > 0.0)
  {
    fitting = mean + (planned - meanSeconds) * variance / covariance;
  }
  fitting = std::min(std::max(fitting, 0.25 * n), 2.0 * n);
  this->Points = std::max(kFewestPoints, std::int64_t(fitting));
}

} // namespace pointhaptics
