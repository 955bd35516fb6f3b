/// @file
/// A connection to the Falcon's FTDI serial chip: the driver's interface to USB, which a test can replace.
#pragma once

#include "Core/Base/Status.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace pointhaptics
{

/// Bytes of payload in one packet from the chip: 64 less its two status bytes.
constexpr int kFtdiPacket = 62;

/// One open, claimed device. One thread at a time; it may change hands between calls. Its destructor cancels
/// and awaits transfers, releases and closes.
class FtdiLink
{
public:
  virtual ~FtdiLink() = default;

  // While booting: these wait.

  /// A vendor request without data, index 0. Ok, DeviceLost or DeviceSilent.
  virtual Status control(std::uint8_t request, std::uint16_t value) = 0;
  virtual Status send(const std::uint8_t* bytes, int count, int timeoutMilliseconds) = 0;
  /// Reads the payload of the next packet, at most kFtdiPacket bytes, without the chip's status bytes.
  /// Packets without payload are skipped until the timeout: @p count is then 0 with Ok.
  virtual Status receive(std::uint8_t* bytes, int& count, int timeoutMilliseconds) = 0;

  // While running: these do not wait longer than asked, and do not allocate or throw themselves.

  /// Queues @p bytes (at most 16). DeviceNotReady: the ones before are still on their way, nothing is sent.
  virtual Status submit(const std::uint8_t* bytes, int count) noexcept = 0;
  /// Keeps a packet request queued; moves the payload of the packets that came since to @p bytes, at most
  /// @p capacity (2 * kFtdiPacket or more). Waits up to @p waitSeconds for the first one with payload.
  virtual Status poll(std::uint8_t* bytes, int capacity, int& count, double waitSeconds) noexcept = 0;
};

/// Opens the first Falcon that can be opened. Null with DeviceNotFound, DeviceNotPermitted, DeviceLost; @p
/// message then says what happened and the cure.
using FtdiBus = std::function<std::unique_ptr<FtdiLink>(Status& status, std::string& message)>;

} // namespace pointhaptics
