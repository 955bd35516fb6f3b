#include "Haptics/Servo/PassivityLimit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <random>

using namespace pointhaptics;

namespace
{
constexpr double kPi = 3.14159265358979323846;
constexpr int kSubsteps = 20;

/// The Falcon's figures.
HandLimits falconLike()
{
  HandLimits limits;
  limits.damping = 2.5;
  limits.friction = 0.1;
  limits.positionStep = 60e-6;
  limits.delayTicks = 1.0;
  return limits;
}

/// A person at the grip: a push that changes with time, and hands that give or take.
struct Person
{
  double press = 0.0;     ///< N into the wall, all the time.
  double amplitude = 0.0; ///< N.
  double frequency = 0.0; ///< Hz.
  double yield = 0.0;     ///< N s/m: takes what comes back.
  double kick = 0.0;      ///< N for the first 20 ms.
  double force(double t, double v) const
  {
    return -press - amplitude * std::sin(2.0 * kPi * frequency * t) - yield * v - (t < 0.02 ? kick : 0.0);
  }
};

/// A mass with viscous and Coulomb friction before a sampled wall at x = 0: position rounded to steps, speed
/// by differences, the force held for a tick and late by the delay.
class SampledWall
{
public:
  SampledWall(const HandLimits& limits, double mass, double stiffness, double damping, double rateHz)
    : limits_(limits)
    , mass_(mass)
    , stiffness_(stiffness)
    , damping_(damping)
    , period_(1.0 / rateHz)
  {
  }

  /// Least energy (J) that @p person had spent at any time: below zero, the wall has given.
  double leastEnergySpent(const Person& person, double seconds)
  {
    double spent = 0.0;
    double least = 0.0;
    const double h = period_ / kSubsteps;
    double x = 0.002;
    double v = 0.0;
    for (int tick = 0; tick * period_ < seconds; ++tick)
    {
      const double held = answer(x);
      for (int i = 0; i < kSubsteps; ++i)
      {
        const double hand = person.force(tick * period_ + i * h, v);
        const double pull = v + h / mass_ * (hand + held - limits_.damping * v);
        const double grip = h / mass_ * limits_.friction;
        const double next = std::abs(pull) <= grip ? 0.0 : pull - std::copysign(grip, pull);
        x += h * next;
        // The mean of both speeds makes work and kinetic energy balance exactly in each substep.
        spent += hand * 0.5 * (v + next) * h;
        v = next;
      }
      least = std::min(least, spent);
    }
    return least;
  }

private:
  double answer(double x)
  {
    const double step = limits_.positionStep;
    const double seen = step > 0.0 ? step * std::round(x / step) : x;
    const double speed = (seen - lastSeen_) / period_;
    lastSeen_ = seen;
    std::rotate(late_.begin(), late_.end() - 1, late_.end());
    late_[0] = seen < 0.0 ? std::max(0.0, -stiffness_ * seen - damping_ * speed) : 0.0;
    return late_[std::size_t(limits_.delayTicks)];
  }

  HandLimits limits_;
  double mass_;
  double stiffness_;
  double damping_;
  double period_;
  double lastSeen_ = 0.002;
  std::array<double, 3> late_{};
};

Person randomPerson(std::mt19937_64& random)
{
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Person person;
  person.press = 3.0 * unit(random);
  person.amplitude = 4.0 * unit(random);
  person.frequency = std::pow(10.0, 2.5 * unit(random));
  person.yield = unit(random) < 0.5 ? 0.0 : 2.0 * unit(random);
  person.kick = unit(random) < 0.5 ? 0.0 : 5.0 * unit(random);
  return person;
}
}

TEST(PassivityLimit, IsTheFamiliarOneWithoutDelayAndDamping)
{
  HandLimits limits;
  limits.damping = 9.0;
  EXPECT_DOUBLE_EQ(largestPassiveStiffness(limits, 0.0, 1000.0), 2.0 * 9.0 / 1e-3);
  EXPECT_DOUBLE_EQ(largestPassiveStiffness(limits, 3.0, 1000.0), 2.0 * 6.0 / 1e-3);
  EXPECT_DOUBLE_EQ(largestPassiveStiffness(limits, 0.0, 10000.0), 2.0 * 9.0 / 1e-4);
  EXPECT_EQ(largestPassiveStiffness(limits, 10.0, 1000.0), 0.0);
  limits.delayTicks = 1.0;
  EXPECT_DOUBLE_EQ(largestPassiveStiffness(limits, 0.0, 1000.0), 9.0 / 1.5e-3);
}

TEST(PassivityLimit, QuantisationNeedsFriction)
{
  HandLimits limits = falconLike();
  limits.friction = 0.03;
  EXPECT_DOUBLE_EQ(largestPassiveStiffness(limits, 0.0, 1000.0), 1000.0);
  limits.friction = 0.0;
  EXPECT_EQ(largestPassiveStiffness(limits, 0.0, 1000.0), 0.0);
  limits.positionStep = 0.0;
  EXPECT_GT(largestPassiveStiffness(limits, 0.0, 1000.0), 1000.0);
}

TEST(PassivityLimit, IsTwoSided)
{
  const HandLimits limits = falconLike();
  for (double rate : { 500.0, 1000.0, 4000.0 })
  {
    for (double damping : { 0.0, 0.5, 1.0 })
    {
      const double stiffness = largestPassiveStiffness(limits, damping, rate);
      EXPECT_EQ(checkPassive(limits, stiffness, damping, rate), Status::Ok);
      EXPECT_EQ(checkPassive(limits, 1.01 * stiffness + 1.0, damping, rate), Status::NotPassive);
    }
  }
  EXPECT_EQ(checkPassive(HandLimits(), 1e5, 1e3, 1000.0), Status::Ok) << "a hand that nothing moves";
  EXPECT_EQ(checkPassive(limits, 0.0, 2.6, 1000.0), Status::NotPassive);
  EXPECT_EQ(checkPassive(limits, std::nan(""), 0.0, 1000.0), Status::NotPassive);
  HandLimits slow = limits;
  slow.maximumRateHz = 1000.0;
  EXPECT_EQ(checkPassive(slow, 100.0, 0.0, 1000.0), Status::Ok);
  EXPECT_EQ(checkPassive(slow, 100.0, 0.0, 1001.0), Status::RateNotSupported);
}

TEST(Passivity, AcceptedWallsGiveNoEnergyToAnyHand)
{
  std::mt19937_64 random(17);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  double least = 0.0;
  for (int trial = 0; trial < 400; ++trial)
  {
    HandLimits limits = falconLike();
    limits.delayTicks = double(trial % 3);
    const double rate = trial % 2 ? 1000.0 : 2000.0;
    // Half of the trials at the very edge.
    const double most = std::min(limits.damping, 2.0 * limits.friction / limits.positionStep / rate);
    const double damping = (trial % 4 < 2 ? 0.0 : unit(random)) * most;
    const double stiffness =
      largestPassiveStiffness(limits, damping, rate) * (trial % 2 ? 1.0 : unit(random));
    ASSERT_EQ(checkPassive(limits, stiffness, damping, rate), Status::Ok);
    SampledWall wall(limits, 0.05 + 0.3 * unit(random), stiffness, damping, rate);
    const double spent = wall.leastEnergySpent(randomPerson(random), 0.5);
    least = std::min(least, spent);
    EXPECT_GE(spent, -1e-9) << trial << ": K " << stiffness << " B " << damping << " rate " << rate;
  }
  std::printf("[ figure   ] least energy a hand had spent at any time: %.3g J\n", least);
}

TEST(Passivity, RefusedWallsDoGiveEnergy)
{
  // The oracle must be able to see it: walls far above the limit keep a yielding hand moving.
  const HandLimits limits = falconLike();
  Person person;
  person.press = 1.0;
  person.kick = 3.0;
  person.yield = 1.0;
  for (double damping : { 0.0, 1.0 })
  {
    const double limit = largestPassiveStiffness(limits, damping, 1000.0);
    const double stiffness = 6.0 * limit + 2000.0;
    ASSERT_EQ(checkPassive(limits, stiffness, damping, 1000.0), Status::NotPassive);
    SampledWall wall(limits, 0.1, stiffness, damping, 1000.0);
    EXPECT_LT(wall.leastEnergySpent(person, 2.0), -1e-3);
  }
}
