/// @file
/// A SpaceMouse of the kernel that runs the test, made by uhid.
#pragma once

#include <cstdint>
#include <vector>

namespace pointhaptics
{
namespace trial
{

/// The kernel's HID layer parses its descriptor and gives it a hidraw node, as with one that is plugged in.
/// Needs root and the modules uhid and hid-generic. One thread.
class UhidCap
{
public:
  UhidCap() = default;
  ~UhidCap() { unplug(); }
  UhidCap(const UhidCap&) = delete;
  UhidCap& operator=(const UhidCap&) = delete;

  /// False: the kernel does not take it.
  bool plugIn();
  void unplug();
  /// One report, its number first.
  void say(const std::vector<std::uint8_t>& report);
  /// State of the LED that the host last set; -1: none since it was plugged in.
  int led();

private:
  int uhid_ = -1;
  int led_ = -1;
};

} // namespace trial
} // namespace pointhaptics
