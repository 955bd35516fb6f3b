#include "Haptics/Contact/FootSearch.h"

#include <cmath>

namespace pointhaptics
{
namespace
{

/// A learned way is used only if it leads at least kLeastGain of the remaining way towards the foot and is at
/// most kMostGain of it long. Else it was learned at another place.
constexpr double kLeastGain = 0.15;
constexpr double kMostGain = 1.5;
/// A step teaches nothing if it led less than this fraction in the expected direction.
constexpr double kLeastProgress = 0.1;

double product(const FootSearch::Way& v, const FootSearch::Way& w) noexcept
{
  return v.a * w.a + v.b * w.b;
}

}

FootSearch::Way FootSearch::wayFor(const Way& left) noexcept
{
  const Way way = along(left);
  const double length2 = product(left, left);
  // The test is negated, so that a way that is not finite is rejected too.
  if (!(product(way, left) >= kLeastGain * length2 && product(way, way) <= kMostGain * kMostGain * length2))
  {
    this->reset();
    return left;
  }
  return way;
}

void FootSearch::learn(const Way& went, const Way& less) noexcept
{
  const Way expected = along(less);
  const double progress = product(went, expected);
  if (!(std::abs(progress) > kLeastProgress * product(went, went)))
  {
    return;
  }
  const Way row{ (went.a * gain_[0] + went.b * gain_[2]) / progress,
    (went.a * gain_[1] + went.b * gain_[3]) / progress };
  gain_[0] += (went.a - expected.a) * row.a;
  gain_[1] += (went.a - expected.a) * row.b;
  gain_[2] += (went.b - expected.b) * row.a;
  gain_[3] += (went.b - expected.b) * row.b;
}

} // namespace pointhaptics
