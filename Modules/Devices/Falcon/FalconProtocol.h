/// @file
/// The Falcon's side of a servo tick: answers to positions, forces to commands. Private to the driver.
#pragma once

#include "Devices/Falcon/FalconDevice.h"

#include "Haptics/Servo/LatestValue.h"

namespace pointhaptics
{

/// Owned and used by one thread at a time; statistics and raw values may be read by any.
class FalconProtocol
{
public:
  explicit FalconProtocol(const FalconSettings& settings);

  /// Begins with a device that has just started, and counts as not homed.
  void begin() noexcept;
  /// Reads the answers that have come. Ok: @p hand is the newest position. DeviceLost ends the connection.
  Status read(FtdiLink& link, double timeSeconds, bool wantArmed, HandState& hand) noexcept;
  /// Sends @p force (workspace frame) through the chain. DeviceLost ends the connection.
  Status write(FtdiLink& link, double timeSeconds, const Vec3& force, int leds) noexcept;
  /// Sends commands without force until three were answered, then LEDs off.
  void shutdown(FtdiLink& link) noexcept;

  FalconState state() const noexcept { return FalconState(state_.load(std::memory_order_relaxed)); }
  FalconStatistics statistics() const noexcept { return shown_.read(); }
  FalconRaw raw() const noexcept { return raw_.read(); }
  void clearStatistics() noexcept
  {
    count_ = FalconStatistics();
    finder_ = FalconFrameFinder();
  }

private:
  bool receive(FtdiLink& link, double waitSeconds, Status& status) noexcept;
  Status take(const FalconReply& reply, double elapsed) noexcept;
  Status noAnswer(double timeSeconds) noexcept;
  void transition(FalconEvent event) noexcept;
  void noteDelay() noexcept;
  std::uint8_t usualLeds() const noexcept;

  FalconSettings settings_;
  FalconForceChain chain_;
  FalconFrameFinder finder_;
  FalconReply reply_;
  FalconCommand command_;
  FalconStatistics count_;
  LatestValue<FalconStatistics> shown_;
  LatestValue<FalconRaw> raw_;
  std::atomic<int> state_{ int(FalconState::Closed) };

  Vec3 position_; ///< Position in the device frame.
  FalconAngles angles_{};
  bool positioned_ = false; ///< position_ belongs to encoders_.
  std::array<std::int16_t, kFalconLegs> encoders_{};
  bool found_ = false; ///< True if in this tick the position was found without one before it.
  std::array<std::int16_t, kFalconLegs> strange_{}; ///< Encoders of the last bad reply.
  int jumps_ = 0;                                   ///< Bad replies in a row that agree.
  int vainWaits_ = 0;                               ///< Ticks in a row with an answer, but not the newest.
  int abandoned_ = 0;                               ///< Answers no longer waited for.
  int timeouts_ = 0;                                ///< Timeouts in a row.
  int unanswered_ = 0;     ///< Commands since begin() or the last timeout that have no answer yet.
  double lastReply_ = 0.0; ///< Servo time of the last reply.
  double lastWrite_ = 0.0;
  bool timed_ = false;    ///< True if the two times are valid.
  bool answered_ = false; ///< True if read() was Ok in this tick: a force may pass.
};

} // namespace pointhaptics
