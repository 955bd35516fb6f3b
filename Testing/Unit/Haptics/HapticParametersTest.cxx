#include "Haptics/HapticParameters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

using namespace pointhaptics;

namespace
{
Status checkWith(const std::function<void(HapticParameters&)>& change)
{
  HapticParameters parameters;
  change(parameters);
  return parameters.check();
}
}

TEST(HapticParameters, AcceptsItsDefaultsAndPresets)
{
  EXPECT_EQ(HapticParameters().check(), Status::Ok);
  EXPECT_EQ(checkWith([](auto& p) { p.gradientSteps = GradientStepsParameters::paper(); }), Status::Ok);
  EXPECT_EQ(checkWith([](auto& p) { p.method = ProxyMethod::GradientSteps; }), Status::Ok);
  EXPECT_EQ(ForceLimits().check(), Status::Ok);
}

TEST(HapticParameters, RefusesEachNumberOutsideItsRange)
{
  using Change = std::function<void(HapticParameters&, double)>;
  const std::vector<Change> numbers = {
    [](auto& p, double value) { p.contact.stiffness = value; },
    [](auto& p, double value) { p.contact.damping = value; },
    [](auto& p, double value) { p.contact.staticFriction = value; },
    [](auto& p, double value) { p.contact.dynamicFriction = value; },
    [](auto& p, double value) { p.gradientSteps.freeGain = value; },
    [](auto& p, double value) { p.gradientSteps.normalGain = value; },
    [](auto& p, double value) { p.gradientSteps.tangentGain = value; },
    [](auto& p, double value) { p.gradientSteps.sinkTolerance = value; },
    [](auto& p, double value) { p.gradientSteps.stepPeriodSeconds = value; },
    [](auto& p, double value) { p.gradientSteps.largestStep = value; },
  };
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    for (double value : { -1.0, 1e9, std::nan(""), std::numeric_limits<double>::infinity() })
    {
      EXPECT_EQ(checkWith([&](auto& p) { numbers[i](p, value); }), Status::InvalidParameter)
        << i << ' ' << value;
    }
  }
  for (int steps : { -1, 0, 1000000 })
  {
    EXPECT_EQ(
      checkWith([=](auto& p) { p.gradientSteps.maximumStepsPerTick = steps; }), Status::InvalidParameter);
  }
}

TEST(HapticParameters, RefusesDynamicFrictionAboveStatic)
{
  const auto friction = [](double staticFriction, double dynamicFriction)
  {
    return checkWith(
      [=](auto& p)
      {
        p.contact.staticFriction = staticFriction;
        p.contact.dynamicFriction = dynamicFriction;
      });
  };
  EXPECT_EQ(friction(0.4, 0.3), Status::Ok);
  EXPECT_EQ(friction(0.3, 0.3), Status::Ok);
  EXPECT_EQ(friction(0.3, 0.4), Status::InvalidParameter);
}

TEST(HapticParameters, RefusesUnknownMethods)
{
  EXPECT_EQ(checkWith([](auto& p) { p.method = static_cast<ProxyMethod>(7); }), Status::InvalidParameter);
}

TEST(ForceLimits, RefusesNegativeAndNaN)
{
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ((ForceLimits{ infinity, infinity }.check()), Status::Ok);
  EXPECT_EQ((ForceLimits{ -1.0, 1.0 }.check()), Status::InvalidParameter);
  EXPECT_EQ((ForceLimits{ 1.0, std::nan("") }.check()), Status::InvalidParameter);
}
