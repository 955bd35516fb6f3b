/// @file
/// A FalconModel behind an emulated USB device: the real libusb talks to it through umockdev.
#pragma once

#include "../Unit/Devices/RealTimeFalcon.h"

#include <umockdev.h>

#include <deque>
#include <vector>

namespace pointhaptics
{
namespace trial
{

/// Answers what libusb asks of /dev/bus/usb/001/002 (usbfs): capabilities, claiming, and transfers that are
/// submitted, reaped and discarded. The test's threads and umockdev's meet at
/// one mutex.
class EmulatedFalcon : public RealTimeFalcon
{
public:
  explicit EmulatedFalcon(UMockdevTestbed* bed);
  ~EmulatedFalcon();

  void plugIn();
  /// Transfers under way end with ESHUTDOWN, later calls with ENODEV, then the system says "remove".
  void unplug();

  bool claimed();
  int pendingTransfers();
  /// Every further claim gives this errno; 0: none.
  void refuseClaims(int error);
  /// The chip sends this before what the model says.
  void garbage(const std::vector<std::uint8_t>& bytes);

private:
  struct Transfer
  {
    UMockdevIoctlData* urb = nullptr;
    UMockdevIoctlData* buffer = nullptr;
    Clock::time_point submitted;
    bool done = false;
    int status = 0;
    int length = 0;
  };

  static int onIoctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, EmulatedFalcon* self);
  void answer(UMockdevIoctlClient* client);
  void submit(UMockdevIoctlClient* client);
  void reap(UMockdevIoctlClient* client);
  void discard(UMockdevIoctlClient* client);
  void finish(Transfer& transfer);
  void control(const std::uint8_t* setup);

  UMockdevTestbed* bed_;
  UMockdevIoctlBase* handler_ = nullptr;
  std::deque<Transfer> transfers_;
  bool plugged_ = false;
  bool claimed_ = false;
  int refusal_ = 0;
};

} // namespace trial
} // namespace pointhaptics
