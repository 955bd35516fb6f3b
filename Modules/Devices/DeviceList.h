/// @file
/// List of the devices that are plugged in.
#pragma once

#include <string>
#include <vector>

namespace pointhaptics
{

/// An entry in a list of devices.
struct ListedDevice
{
  std::string kind;    ///< Kind: "falcon", "spacemouse" or "simulated".
  std::string name;    ///< For people.
  std::string place;   ///< "bus 1 device 7", "/dev/hidraw3"; empty for one without hardware.
  std::string problem; ///< Reason why it cannot be used, with the cure; empty: it can.
};

/// Falcons, SpaceMice, then the simulated hand, which is always there. Opens and closes each device it finds;
/// not beside a driver that uses one. @p notes gets a sentence, with the cure, for each kind that was not
/// found and for each that this build cannot use.
std::vector<ListedDevice> listDevices(std::vector<std::string>& notes);

/// The Falcons alone; where none is found @p notes gets a sentence.
void listFalcons(std::vector<ListedDevice>& devices, std::vector<std::string>& notes);

/// Falcons on this machine's USB; any thread. Empty where the package was built without libusb, and where the
/// USB system cannot be used: @p problem then says why, with the cure.
std::vector<ListedDevice> findUsbFalcons(std::string& problem);

} // namespace pointhaptics
