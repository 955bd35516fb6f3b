#include "Core/Bandwidth/SheatherJones.h"

#include "Core/Bandwidth/GaussianPairSum.h"

#include <cmath>

namespace pointhaptics
{
namespace
{

constexpr double kSqrtPi = 1.77245385090551602730;
constexpr double kSqrtTwoPi = 2.50662827463100050242;
/// Where the search begins, a little above the best bandwidth for any density of this scale (Terrell 1990).
constexpr double kStart = 1.144;
/// Steps of the search, as a ratio, and how many: 1.2^190 > 1e15.
constexpr double kStepRatio = 1.2;
constexpr int kLargestNumberOfSteps = 190;
constexpr int kLargestNumberOfRefinements = 100;
/// Steps of the logarithm of b as short as this end the refinement, which by then converges superlinearly.
constexpr double kTolerance = 1e-12;

bool isUsable(double value)
{
  return value > 0.0 && std::isfinite(value);
}

/// A sample and the constants of its equation. Bandwidths are in units of the scale, which keeps their powers
/// in range.
class Equation
{
public:
  Equation(const double* sorted, std::int64_t count, double scale)
    : sorted_(sorted)
    , count_(count)
    , n_(double(count))
    , scale_(scale)
    , thirdDerivative_(roughness(1.23 * std::pow(n_, -1.0 / 9.0), false))
    , pilotFactor_(
        1.357 * std::pow(roughness(1.24 * std::pow(n_, -1.0 / 7.0), true) / thirdDerivative_, 1.0 / 7.0))
  {
  }
  bool isSolvable() const { return isUsable(thirdDerivative_) && isUsable(pilotFactor_); }
  bool bracket(double& low, double& high, double& atLow, double& atHigh);
  double root(double low, double high, double atLow, double atHigh);

private:
  double roughness(double g, bool second);
  double excess(double logarithm);

  const double* sorted_;
  std::int64_t count_;
  double n_;
  double scale_;
  GaussianPairSum sums_;   ///< Before what is made with it.
  double thirdDerivative_; ///< T(b).
  double pilotFactor_;     ///< 1.357 (S(a) / T(b))^(1/7).
};

/// Integral of the squared second or third derivative of the density with unit scale.
double Equation::roughness(double g, bool second)
{
  const double sum =
    sums_.sum(sorted_, count_, g * scale_, second ? GaussianDerivative::Fourth : GaussianDerivative::Sixth);
  return (second ? sum : -sum) / (n_ * (n_ - 1.0) * kSqrtTwoPi * std::pow(g, second ? 5.0 : 7.0));
}

/// log of right-hand side over left-hand side of the equation at bandwidth exp(logarithm); falls to 0 at a
/// solution.
double Equation::excess(double logarithm)
{
  const double g = pilotFactor_ * std::exp(5.0 / 7.0 * logarithm);
  return std::log(std::pow(2.0 * kSqrtPi * n_ * roughness(g, true), -0.2)) - logarithm;
}

bool Equation::bracket(double& low, double& high, double& atLow, double& atHigh)
{
  const double step = std::log(kStepRatio);
  low = high = std::log(kStart * std::pow(n_, -0.2));
  atLow = atHigh = excess(low);
  const bool down = atLow < 0.0;
  for (int i = 0; i < kLargestNumberOfSteps && std::isfinite(atLow) && std::isfinite(atHigh); ++i)
  {
    if (atLow >= 0.0 && atHigh <= 0.0)
    {
      return true;
    }
    if (down)
    {
      high = low;
      atHigh = atLow;
      low -= step;
      atLow = excess(low);
    }
    else
    {
      low = high;
      atLow = atHigh;
      high += step;
      atHigh = excess(high);
    }
  }
  return false;
}

/// Regula falsi where the end that stays has its value halved (Illinois): never leaves the bracket.
double Equation::root(double low, double high, double atLow, double atHigh)
{
  double last = low;
  int side = 0;
  for (int i = 0; i < kLargestNumberOfRefinements && atLow != atHigh; ++i)
  {
    const double next = high - atHigh * (high - low) / (atHigh - atLow);
    const bool arrived = std::fabs(next - last) <= kTolerance;
    last = next;
    if (arrived)
    {
      break;
    }
    const double value = excess(next);
    if (value > 0.0)
    {
      low = next;
      atLow = value;
      atHigh *= side > 0 ? 0.5 : 1.0;
      side = 1;
    }
    else
    {
      high = next;
      atHigh = value;
      atLow *= side < 0 ? 0.5 : 1.0;
      side = -1;
    }
  }
  return last;
}

}

Status sheatherJones(const double* sorted, std::int64_t count, double scale, double& bandwidth)
{
  if (count < 2 || !isUsable(scale))
  {
    return Status::DegenerateSample;
  }
  Equation equation(sorted, count, scale);
  double low = 0.0, high = 0.0, atLow = 0.0, atHigh = 0.0;
  if (!equation.isSolvable() || !equation.bracket(low, high, atLow, atHigh))
  {
    return Status::EquationUnsolved;
  }
  const double result = std::exp(equation.root(low, high, atLow, atHigh)) * scale;
  if (!isUsable(result))
  {
    return Status::EquationUnsolved;
  }
  bandwidth = result;
  return Status::Ok;
}

} // namespace pointhaptics
