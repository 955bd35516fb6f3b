/// @file
/// The Falcon's messages while it runs, 16 bytes each way, and a finder for them in a broken stream.
#pragma once

#include <array>
#include <cstdint>

namespace pointhaptics
{

constexpr int kFalconFrameSize = 16;
constexpr int kFalconLegs = 3;
using FalconFrame = std::array<std::uint8_t, kFalconFrameSize>;

/// Bits of the LED byte. One home for them: which bit is which LED can only be confirmed on hardware
/// (`pointhaptics devices --diagnose`).
enum FalconLed : std::uint8_t
{
  kFalconLedNone = 0,
  kFalconHomingBit = 1, ///< Asks the firmware to watch for the homing stops; in every command. It is not an
                        ///< LED.
  kFalconLedGreen = 2,
  kFalconLedBlue = 4,
  kFalconLedRed = 8,
};

/// A command of the computer.
struct FalconCommand
{
  std::array<std::int16_t, kFalconLegs> motors{}; ///< Motor values, -4096 to 4096 in use; 0: no torque.
  std::uint8_t leds = kFalconLedNone;             ///< FalconLed bits, 0 to 15.
};

/// A reply of the Falcon.
struct FalconReply
{
  std::array<std::int16_t, kFalconLegs> encoders{}; ///< Counts.
  std::uint8_t buttons = 0;                         ///< Bits 0 to 3.
  std::uint8_t homed = 0;                           ///< Bits 0 to 2: encoder i knows its origin.
  bool allHomed() const noexcept { return homed == 7; }
};

FalconFrame encode(const FalconCommand& command) noexcept;
/// Decodes a frame. False: a byte is invalid; @p reply is then unchanged.
bool decode(const FalconFrame& frame, FalconReply& reply) noexcept;

/// Finds frames in a stream of bytes. '<' begins one wherever it stands. An invalid byte drops the collected
/// bytes, and the next '<' begins anew, so one damaged frame costs itself alone. Constant memory, one thread.
class FalconFrameFinder
{
public:
  /// True: @p byte ends a whole frame, which frame() gives until the next call.
  bool take(std::uint8_t byte) noexcept;
  const FalconFrame& frame() const noexcept { return frame_; }
  /// Bytes that belonged to no whole frame. What is still being collected is not among them.
  std::uint64_t droppedBytes() const noexcept { return dropped_; }
  /// Forgets a frame that has begun.
  void reset() noexcept { size_ = 0; }

private:
  FalconFrame frame_{};
  int size_ = 0;
  std::uint64_t dropped_ = 0;
};

} // namespace pointhaptics
