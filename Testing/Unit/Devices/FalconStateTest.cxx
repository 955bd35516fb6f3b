#include "Devices/Falcon/FalconState.h"

#include <gtest/gtest.h>

using namespace pointhaptics;

TEST(FalconState, PushesOnlyAfterHomingAndArming)
{
  constexpr int kStates = 8;
  constexpr int kEvents = 11;
  for (int s = 0; s < kStates; ++s)
  {
    const auto state = FalconState(s);
    for (int e = 0; e < kEvents; ++e)
    {
      const FalconState after = next(state, FalconEvent(e));
      if (after == FalconState::Armed && state != FalconState::Armed)
      {
        EXPECT_EQ(state, FalconState::Homed);
        EXPECT_EQ(FalconEvent(e), FalconEvent::Arm);
      }
      if (after == FalconState::Homed && state != FalconState::Homed)
      {
        EXPECT_TRUE(state == FalconState::Unhomed || state == FalconState::Armed) << name(state);
      }
    }
    EXPECT_EQ(next(state, FalconEvent::Close), FalconState::Closed);
    EXPECT_EQ(next(state, FalconEvent::Failed),
      state == FalconState::Closed ? FalconState::Closed : FalconState::Fault);
    EXPECT_STRNE(name(state), "");
  }
}
