/// @file
/// Brings a Falcon from power-on to running: serial settings, boot loader, firmware, run mode.
#pragma once

#include "Devices/Falcon/FtdiLink.h"

#include "Core/Base/Status.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <utility>
#include <vector>

namespace pointhaptics
{

/// Waiting times and numbers of tries; the defaults are for hardware.
struct FalconBootSettings
{
  int replyMilliseconds = 50;  ///< For one answer of the boot loader.
  int blockMilliseconds = 500; ///< For the echo of one block of 62 bytes.
  int probeMilliseconds = 100; ///< For the firmware's answer, where it runs already.
  int greetings = 100;         ///< Tries to raise the boot loader.
  int loads = 10;              ///< Tries to load the firmware: often the first ones fail.
};

/// Starts a Falcon. One thread; its calls wait. Ends early with Aborted when @p cancelled becomes true.
class FalconBoot
{
public:
  FalconBoot(FtdiLink& link, const FalconBootSettings& settings, const std::atomic<bool>& cancelled);

  /// Switches the chip to run mode and sends a command without force. Ok: the firmware answers, so that it
  /// need not be loaded. DeviceSilent: it does not. DeviceLost.
  Status probe();
  /// Raises the boot loader. DeviceSilent: no answer in all tries.
  Status greet();
  /// Sends @p firmware block by block, each echoed and compared, and switches to run mode.
  /// FirmwareNotTaken: an echo was missing or wrong; DeviceLost.
  Status load(const std::vector<std::uint8_t>& firmware);

private:
  using ControlRequest = std::pair<std::uint8_t, std::uint16_t>;
  /// Ends with the first that fails.
  Status control(std::initializer_list<ControlRequest> requests);
  Status serialForBoot();
  Status serialForRun();
  Status expect(const std::uint8_t* bytes, int count, int timeoutMilliseconds, bool& found);

  FtdiLink& link_;
  FalconBootSettings settings_;
  const std::atomic<bool>& cancelled_;
};

/// Probes the device, and where no firmware answers, greets and loads as often as the settings say. @p
/// firmware may be empty: FirmwareMissing where it is needed. @p onLoading is called when the loading begins.
/// DeviceSilent: twice in a row no greeting was answered (10 s with the default settings).
Status bootFalcon(FtdiLink& link, const FalconBootSettings& settings,
  const std::vector<std::uint8_t>& firmware, const std::atomic<bool>& cancelled,
  const std::function<void()>& onLoading);

} // namespace pointhaptics
