#include "Haptics/HapticParameters.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <string>

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
  const std::set<std::string> unbounded = { "contact.settleRate", "contact.forceLimit" };
  HapticParameters parameters;
  int numbers = 0;
  visitSettings(parameters,
    [&](const std::string& name, auto& member)
    {
      if constexpr (std::is_same_v<std::decay_t<decltype(member)>, double>)
      {
        const double before = member;
        for (double value : { -1.0, 1e9, std::nan(""), std::numeric_limits<double>::infinity() })
        {
          member = value;
          const bool isValid = value > 0.0 && unbounded.count(name) > 0;
          EXPECT_EQ(parameters.check(), isValid ? Status::Ok : Status::InvalidParameter)
            << name << ' ' << value;
        }
        member = before;
        ++numbers;
      }
    });
  EXPECT_EQ(numbers, 12);
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

TEST(HapticParameters, NameTheFirstNumberThatIsOutOfItsRange)
{
  HapticParameters parameters;
  EXPECT_EQ(firstOutOfRange(parameters).name, nullptr);
  parameters.gradientSteps.largestStep = 20.0;
  EXPECT_STREQ(firstOutOfRange(parameters).name, "largestStep");
  EXPECT_EQ(firstOutOfRange(parameters).range.maximum, 10.0);
  parameters.contact.forceLimit = 0.0;
  EXPECT_STREQ(firstOutOfRange(parameters).name, "forceLimit");
  EXPECT_EQ(firstOutOfRange(parameters).value, 0.0);
}
