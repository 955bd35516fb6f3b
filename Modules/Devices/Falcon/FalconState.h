/// @file
/// The Falcon's states and the events between them.
#pragma once

namespace pointhaptics
{

enum class FalconState
{
  Closed,  ///< Not in use.
  Opening, ///< Looking for the device; also while it is unplugged.
  Boot,    ///< Talking to its boot loader.
  Loading, ///< Sending the firmware.
  Unhomed, ///< Runs; waits until the person has pulled the grip out and pushed it in.
  Homed,   ///< Knows where the grip is; no force.
  Armed,   ///< Pushes.
  Fault,   ///< Lost or silent: no force; goes back to Opening by itself.
};

enum class FalconEvent
{
  Open,       ///< The program wants the device.
  Connected,  ///< Found and claimed.
  Running,    ///< Its firmware answers (loaded a moment ago, or there already).
  BootDone,   ///< The boot loader answers: firmware can be sent.
  HomedAll,   ///< All three encoders know their origin.
  HomingLost, ///< One of them no longer does.
  Arm,        ///< The program lets forces through.
  Disarm,
  Failed, ///< Unplugged, silent, refused: whatever ends the connection.
  Retry,  ///< Time to look for it again.
  Close,  ///< The program is done with it.
};

/// The one table of the state machine: an event that means nothing in a state leaves it where it is. Only
/// Armed may push, and only HomedAll followed by Arm leads there.
FalconState next(FalconState state, FalconEvent event) noexcept;

/// "closed", "opening", ...; never null.
const char* name(FalconState state) noexcept;

} // namespace pointhaptics
