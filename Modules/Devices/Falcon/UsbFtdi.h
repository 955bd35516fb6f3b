/// @file
/// Falcons on this machine's USB. Private to the module.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pointhaptics
{

constexpr std::uint16_t kFalconVendor = 0x0403;
constexpr std::uint16_t kFalconProduct = 0xcb48;

struct UsbFalcon
{
  std::string place;   ///< "bus 1 device 7".
  std::string problem; ///< Empty, or why it cannot be opened, with the cure.
};

/// Any thread; opens and closes each device. Empty where the package was built without libusb, and where the
/// USB system cannot be used: @p problem then says why, with the cure.
std::vector<UsbFalcon> findUsbFalcons(std::string& problem);

} // namespace pointhaptics
