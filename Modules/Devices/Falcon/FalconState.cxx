#include "Devices/Falcon/FalconState.h"

namespace pointhaptics
{
namespace
{
struct Step
{
  FalconState from;
  FalconEvent event;
  FalconState to;
};

// Close and Failed are not in the table: they act alike in every state.
constexpr Step kSteps[] = {
  { FalconState::Closed, FalconEvent::Open, FalconState::Opening },
  { FalconState::Opening, FalconEvent::Connected, FalconState::Boot },
  { FalconState::Boot, FalconEvent::BootDone, FalconState::Loading },
  { FalconState::Boot, FalconEvent::Running, FalconState::Unhomed },
  { FalconState::Loading, FalconEvent::Running, FalconState::Unhomed },
  { FalconState::Unhomed, FalconEvent::HomedAll, FalconState::Homed },
  { FalconState::Homed, FalconEvent::HomingLost, FalconState::Unhomed },
  { FalconState::Homed, FalconEvent::Arm, FalconState::Armed },
  { FalconState::Armed, FalconEvent::Disarm, FalconState::Homed },
  { FalconState::Armed, FalconEvent::HomingLost, FalconState::Unhomed },
  { FalconState::Fault, FalconEvent::Retry, FalconState::Opening },
};
}

FalconState next(FalconState state, FalconEvent event) noexcept
{
  if (event == FalconEvent::Close)
  {
    return FalconState::Closed;
  }
  if (event == FalconEvent::Failed)
  {
    return state == FalconState::Closed ? state : FalconState::Fault;
  }
  for (const Step& step : kSteps)
  {
    if (step.from == state && step.event == event)
    {
      return step.to;
    }
  }
  return state;
}

const char* name(FalconState state) noexcept
{
  constexpr const char* kNames[] = { "closed", "opening", "boot", "loading", "unhomed", "homed", "armed",
    "fault" };
  return kNames[int(state)];
}

} // namespace pointhaptics
