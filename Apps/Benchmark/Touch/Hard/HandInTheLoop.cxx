#include "Benchmark/Touch/Hard/HandInTheLoop.h"

#include "Haptics/Servo/ForceGuard.h"

#include <algorithm>
#include <cmath>
#include <deque>

namespace pointhaptics::bench::touch::hard
{
namespace
{

constexpr int kHoldTicks = 1000;
constexpr std::size_t kMeanTicks = 50; ///< To either side.

/// Where the person wants the hand, and the ticks at which holds end.
struct Wish
{
  TouchStroke stroke;
  std::vector<std::size_t> holdEnds;
};

Wish wishAt(const TouchPlace& place)
{
  const auto at = [&](double height, double way)
  { return place.point + height * place.up + way * anyPerpendicular(place.up); };
  Wish wish;
  moveTo(wish.stroke, at(5e-3, 0.0), at(-3e-3, 0.0), 0.020);
  stay(wish.stroke, kHoldTicks);
  wish.holdEnds.push_back(wish.stroke.hip.size());
  goTo(wish.stroke, at(-3e-3, 5e-3), 0.020);
  stay(wish.stroke, kHoldTicks);
  wish.holdEnds.push_back(wish.stroke.hip.size());
  goTo(wish.stroke, at(20e-3, 5e-3), 0.050);
  stay(wish.stroke, kRestTicks);
  return wish;
}

/// A drift is no oscillation: the way from the running mean.
double oscillationOf(const std::vector<Vec3>& positions, const std::vector<std::size_t>& holdEnds)
{
  double largest = 0.0;
  for (const std::size_t end : holdEnds)
  {
    for (std::size_t i = end - kHoldTicks / 2; i + kMeanTicks < end; ++i)
    {
      Vec3 mean;
      for (std::size_t k = i - kMeanTicks; k <= i + kMeanTicks; ++k)
      {
        mean += positions[k] / double(2 * kMeanTicks + 1);
      }
      largest = std::max(largest, norm(positions[i] - mean));
    }
  }
  return largest;
}

} // namespace

std::vector<LoopHand> loopHands(bool quick)
{
  std::vector<LoopHand> hands;
  for (const double mass : { 0.1, 0.3, 1.0 })
  {
    for (const double grip : { 50.0, 300.0 })
    {
      for (const double stiffness : { 800.0, 1500.0 })
      {
        for (const int delay : { 1, 2 })
        {
          hands.push_back({ mass, grip, 0.4, 2.5, stiffness, delay });
        }
      }
    }
  }
  if (quick)
  {
    hands = { hands[4], hands[12] };
  }
  return hands;
}

LoopFigures runLoop(
  const LoopHand& hand, const TouchPlace& place, const std::function<Vec3(const Vec3&)>& force)
{
  constexpr int kSubsteps = 10;
  constexpr double kStep = kTickSeconds / kSubsteps;
  const double damping = 2.0 * hand.dampingRatio * std::sqrt(hand.grip * hand.mass) + hand.deviceDamping;
  const Wish wish = wishAt(place);
  ForceGuard guard;
  std::deque<Vec3> coming(std::size_t(hand.delay), Vec3());
  std::vector<Vec3> positions;
  Vec3 position = wish.stroke.hip.front();
  Vec3 velocity;
  LoopFigures figures;
  for (const Vec3& target : wish.stroke.hip)
  {
    coming.push_back(guard.limit(force(position), kTickSeconds));
    const Vec3 applied = coming.front();
    coming.pop_front();
    const Vec3 before = position;
    for (int i = 0; i < kSubsteps; ++i)
    {
      const Vec3 pull = hand.grip * (target - position) - damping * velocity + applied;
      velocity += (kStep / hand.mass) * pull;
      position += kStep * velocity;
    }
    figures.energyJoule += dot(applied, position - before);
    positions.push_back(position);
  }
  figures.oscillation = oscillationOf(positions, wish.holdEnds);
  return figures;
}

LoopFigures runOnPlane(const LoopHand& hand, const TouchPlace& place)
{
  return runLoop(hand, place,
    [&](const Vec3& hip)
    { return hand.stiffness * std::max(0.0, dot(place.point - hip, place.up)) * place.up; });
}

} // namespace pointhaptics::bench::touch::hard
