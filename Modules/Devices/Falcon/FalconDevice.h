/// @file
/// The Novint Falcon as a haptic device: found, started, homed, served, and found again after it was
/// unplugged.
#pragma once

#include "Devices/Falcon/FalconBoot.h"
#include "Devices/Falcon/FalconForceChain.h"
#include "Devices/Falcon/FalconState.h"
#include "Devices/Falcon/FtdiLink.h"
#include "Devices/HapticDevice.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace pointhaptics
{

/// Start and limits of a FalconDevice.
struct FalconSettings
{
  std::string firmwareFile; ///< File of the firmware; empty: the one that kFirmwareVariable names, if any.
  FalconForceLimits limits;
  FalconBootSettings boot;
  /// Ends the start with Aborted when it returns true. open() asks again and again, in its thread. Empty:
  /// never.
  std::function<bool()> cancelled;
  double retrySeconds = 0.5;      ///< Between two looks for a device that is gone.
  double replyWaitSeconds = 3e-4; ///< Longest time that read() waits for an answer that is late.
  /// After so long without an answer there is no force, and the command is sent anew.
  double answerTimeoutSeconds = 0.02;
};

/// Counters since open(). Each may be read by any thread.
struct FalconStatistics
{
  std::uint64_t replies = 0;
  std::uint64_t lateReplies = 0;     ///< Reads without a new answer; the position before was used again.
  std::uint64_t timeouts = 0;        ///< Waits of answerTimeoutSeconds in vain.
  std::uint64_t badReplies = 0;      ///< Answers whose position cannot be: out of reach, or too far away.
  std::uint64_t droppedBytes = 0;    ///< Bytes outside whole frames.
  std::uint64_t skippedCommands = 0; ///< Commands not sent since the one before was still on its way.
  std::uint64_t connections = 0;     ///< Times the device came to run.
  /// Largest number of commands without an answer when a position was taken. 0: all positions are of the tick
  /// before, as limits() promises; n: some were n ticks older.
  std::uint64_t largestUnanswered = 0;
};

/// The device's last reply, unprocessed, for diagnosis.
struct FalconRaw
{
  FalconReply reply;
  FalconCommand command;
  FalconState state = FalconState::Closed;
};

/// Threads: a supervisor thread of its own finds, starts and loads the device, and looks for it again after a
/// fault; the connection then belongs to the servo thread, which reads and writes without waiting for
/// anybody. An atomic word names the owner. state(), statistics(), raw(), message() and setArmed() are for
/// any thread. The step itself does not allocate, lock, log or throw; libusb, below it, allocates some tens
/// of bytes for each transfer and takes locks that nobody else holds.
///
/// A tick: read() takes the answer to the command of the tick before (one tick of delay, no waiting for the
/// wire) and gives the position; write() sends the force through FalconForceChain. LEDs: red: start or
/// fault, blue: pull the grip out and push it in (homing), green: forces pass, blue and green: homed, no
/// force.
///
/// read() gives DeviceNotReady until the device is homed, DeviceSilent and DeviceBadReply for a moment,
/// DeviceLost after it was unplugged: in all of them no force passes, and the ramp begins anew.
class FalconDevice : public HapticDevice
{
public:
  /// Uses the libusb of this machine.
  explicit FalconDevice(const FalconSettings& settings = {});
  /// Uses another bus, for tests.
  FalconDevice(const FalconSettings& settings, FtdiBus bus);
  ~FalconDevice() override; ///< Closes.
  FalconDevice(const FalconDevice&) = delete;
  FalconDevice& operator=(const FalconDevice&) = delete;

  const char* name() const noexcept override { return "falcon"; }
  DeviceCapabilities capabilities() const noexcept override;
  HandLimits limits() const noexcept override;

  /// Waits for the first start: 0.1 s where the firmware runs, some seconds where it must be loaded, 10 s
  /// where nothing answers. DeviceNotFound, DeviceNotPermitted, FirmwareMissing, FirmwareNotTaken,
  /// DeviceSilent, DeviceLost, Aborted (FalconSettings::cancelled), InvalidParameter; message() then has what
  /// and cure.
  Status open() override;
  /// Sends commands without force until three were answered, LEDs off, releases. The servo loop must be
  /// stopped; 0.1 s at most where the device answers.
  void close() override;
  Status read(double timeSeconds, HandState& state) noexcept override;
  Status write(double timeSeconds, const Vec3& force) noexcept override;
  std::string message() const override;

  /// Lets forces pass, as at first, or not; they begin with the ramp.
  void setArmed(bool armed) noexcept;
  FalconState state() const noexcept;
  FalconStatistics statistics() const noexcept;
  /// The newest exchange, for diagnosis.
  FalconRaw raw() const noexcept;
  /// Shows these LEDs in place of the usual ones, for diagnosis (FalconLed bits; -1: the usual ones).
  void showLeds(int leds) noexcept;

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// The libusb bus; null where the package was built without libusb.
FtdiBus makeUsbFtdiBus();

} // namespace pointhaptics
