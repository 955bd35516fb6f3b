/// @file
/// Falcons on this machine's USB. Private to the module.
#pragma once

#include "Devices/DeviceList.h"

namespace pointhaptics
{

/// Any thread; opens and closes each device. Empty where the package was built without libusb, and where the
/// USB system cannot be used: @p problem then says why, with the cure.
std::vector<ListedDevice> findUsbFalcons(std::string& problem);

} // namespace pointhaptics
