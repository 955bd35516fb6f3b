#include "Haptics/Servo/ForceGate.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace pointhaptics;

TEST(ForceGate, IsOpenFromTheBeginningAndExactlyOne)
{
  ForceGate gate(0.1, 1.0);
  EXPECT_EQ(gate.fraction(), 1.0);
  EXPECT_EQ(gate.step(true, 1e-3), 1.0);
}

TEST(ForceGate, ClosesAndOpensInItsTimesAndEndsExactly)
{
  ForceGate gate(0.1, 1.0);
  for (int tick = 1; tick <= 100; ++tick)
  {
    EXPECT_NEAR(gate.step(false, 1e-3), 1.0 - tick / 100.0, 1e-9);
  }
  EXPECT_EQ(gate.fraction(), 0.0);
  EXPECT_EQ(gate.step(false, 1e-3), 0.0);
  for (int tick = 1; tick <= 1000; ++tick)
  {
    EXPECT_NEAR(gate.step(true, 1e-3), tick / 1000.0, 1e-9);
  }
  EXPECT_EQ(gate.fraction(), 1.0);
}

TEST(ForceGate, MovesAtOnceWithoutATime)
{
  ForceGate gate;
  EXPECT_EQ(gate.step(false, 1e-3), 0.0);
  EXPECT_EQ(gate.step(true, 1e-3), 1.0);
  ForceGate odd(-1.0, std::nan(""));
  EXPECT_EQ(odd.step(false, 1e-3), 0.0);
  EXPECT_EQ(odd.step(true, 1e-3), 1.0);
}

TEST(ForceGate, StandsStillWhenTimeDoes)
{
  ForceGate gate(0.1, 1.0);
  gate.step(false, 0.05);
  for (double dt : { 0.0, -1.0, std::nan("") })
  {
    EXPECT_NEAR(gate.step(false, dt), 0.5, 1e-12);
    EXPECT_NEAR(gate.step(true, dt), 0.5, 1e-12);
  }
}
