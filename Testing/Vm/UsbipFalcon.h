/// @file
/// A FalconModel as a USB device of the kernel that runs the test: vhci-hcd takes it from a socket.
#pragma once

#include "../Unit/Devices/RealTimeFalcon.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <deque>
#include <thread>
#include <vector>

namespace pointhaptics
{
namespace trial
{

/// Speaks the device's side of USB/IP over a socket pair whose other end the kernel's virtual host controller
/// holds: the kernel enumerates it, binds its own drivers and lets programs open it, as it does with a cable.
/// Needs root and the module vhci-hcd.
class UsbipFalcon : public RealTimeFalcon
{
public:
  UsbipFalcon() = default;
  ~UsbipFalcon() { unplug(); }

  /// Power and cable. True once the kernel has given it an address and a configuration.
  bool plugIn();
  /// The wire breaks at once, with whatever is under way; returns when the kernel has let the port go.
  void unplug();

private:
  /// A header of USB/IP, in the byte order of this machine.
  using Header = std::array<std::uint32_t, 12>;
  struct Request
  {
    Header header{};
    Clock::time_point come;
  };

  void serve();
  bool takeOne();
  void submit(const Request& request, const std::vector<std::uint8_t>& data);
  void unlink(const Header& header);
  bool control(const Request& request, std::vector<std::uint8_t>& answer);
  void answerWaiting();
  void reply(const Header& to, int status, const std::vector<std::uint8_t>& data, std::uint32_t length);

  std::thread thread_;
  int socket_ = -1;
  std::atomic<bool> configured_{ false };
  std::deque<Request> waiting_; ///< Bulk IN, oldest first; the thread's.
};

} // namespace trial
} // namespace pointhaptics
