#include "Devices/Falcon/FalconState.h"

#include <gtest/gtest.h>

#include <utility>

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
    EXPECT_STRNE(name(state), "unknown");
  }
}

TEST(FalconState, WalksFromClosedToArmedAndBackFromAFault)
{
  FalconState state = FalconState::Closed;
  const std::pair<FalconEvent, FalconState> steps[] = { { FalconEvent::Arm, FalconState::Closed },
    { FalconEvent::Open, FalconState::Opening }, { FalconEvent::HomedAll, FalconState::Opening },
    { FalconEvent::Connected, FalconState::Boot }, { FalconEvent::BootDone, FalconState::Loading },
    { FalconEvent::Running, FalconState::Unhomed }, { FalconEvent::Arm, FalconState::Unhomed },
    { FalconEvent::HomedAll, FalconState::Homed }, { FalconEvent::Arm, FalconState::Armed },
    { FalconEvent::Disarm, FalconState::Homed }, { FalconEvent::Arm, FalconState::Armed },
    { FalconEvent::HomingLost, FalconState::Unhomed }, { FalconEvent::Failed, FalconState::Fault },
    { FalconEvent::Arm, FalconState::Fault }, { FalconEvent::Retry, FalconState::Opening } };
  for (const auto& [event, expected] : steps)
  {
    state = next(state, event);
    EXPECT_EQ(state, expected);
  }
}
