/// @file
/// The work of a tick between reading the device and writing it: in the servo thread, and in a replay.
#pragma once

#include "Haptics/HapticPort.h"
#include "Haptics/Servo/ForceGate.h"
#include "Haptics/Servo/ForceGuard.h"
#include "Haptics/Servo/ServoSample.h"

#include <cstdint>

namespace pointhaptics
{

/// Settings that stay from tick to tick.
struct ServoStepSettings
{
  double rateHz = 1000.0;
  ForceLimits limits;
  double rampDownSeconds = 0.0; ///< Duration over which the force goes where the gate closes.
  double rampUpSeconds = 0.0;
  double clutchDownSeconds = 0.0; ///< Durations as rampDownSeconds and rampUpSeconds, for the clutch.
  double clutchUpSeconds = 0.0;
};

/// Input of one tick.
struct TickInput
{
  std::uint64_t number = 0; ///< Number of the tick; higher than that of the tick before.
  Status reading = Status::Ok;
  HandState hand; ///< Where reading is Ok.
  bool gateIsOpen = true;
  bool holdsModel = false;
};

/// Proxy, gates and guard. Its results depend on the sequence of calls only, so that who repeats the calls of
/// a servo thread gets its forces, bit for bit. One thread; no call but the constructor allocates.
class ServoStep
{
public:
  explicit ServoStep(const ServoStepSettings& settings = {}, const HapticParameters& parameters = {});

  void setScene(const HapticScene* scene) noexcept { proxy_.setScene(scene_ = scene); }
  void setParameters(const HapticParameters& parameters) noexcept;
  /// Before tick @p number: as a new object that got scene and parameters, of which the tick before was the
  /// last that did not count.
  void restart(std::uint64_t number) noexcept;
  /// True if restart() would change nothing that the hand feels: it touches nothing, and no gate moves.
  bool isAtRest() const noexcept;

  /// Between reading and writing. Fills tick, time, state, buttons and flags of @p sample, which is that of
  /// the tick before. The force to write is in its state where reading was Ok.
  void step(const TickInput& input, ServoSample& sample) noexcept;
  /// After writing, with the status of that.
  void finish(const TickInput& input, Status writing, ServoSample& sample) noexcept;

  void prefetch() noexcept { proxy_.prefetch(); }
  /// Fraction of the force that the gate lets through, 0 to 1.
  double openFraction() const noexcept { return gate_.fraction(); }

private:
  /// The guard's limit is the proxy's, at most that of the settings.
  void limitGuard() noexcept;
  Vec3 answer(const TickInput& input, ServoSample& sample) noexcept;

  ServoStepSettings settings_;
  Proxy proxy_;
  const HapticScene* scene_ = nullptr;
  ForceGuard guard_;
  ForceGate gate_;
  ForceGate clutch_;
  std::uint64_t lastSteppedTick_ = 0;
  std::uint64_t firstFailedTick_ = 0; ///< First tick of the failed reads in a row; 0: the last read
                                      ///< succeeded.
  std::uint32_t pending_ = kTickBegins;
  bool touches_ = false;
};

} // namespace pointhaptics
