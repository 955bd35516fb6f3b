#include "Devices/DeviceList.h"

#include "Devices/Falcon/FalconDevice.h"
#include "Devices/SpaceMouse/HidBus.h"
#include "Devices/SpaceMouse/SpaceMouseReport.h"

namespace pointhaptics
{
namespace
{

// These messages are about cables: a device that is plugged in but may not be opened is listed with its own
// cure.
constexpr const char* kNoFalcon =
  "no Falcon was found: plug in its power supply, then its USB cable, and see whether `lsusb -d 0403:cb48` "
  "shows it; one that only lacks its udev rule would be listed";
constexpr const char* kNoSpaceMouse =
  "no SpaceMouse was found: plug in its cable or its receiver, and switch it on; one that only lacks its "
  "udev rule would be listed";

void listSpaceMice(std::vector<ListedDevice>& devices, std::vector<std::string>& notes)
{
  const std::unique_ptr<HidBus> bus = makeHidapiBus();
  if (!bus)
  {
    notes.emplace_back(
      "built without hidapi: no SpaceMouse can be used; install libhidapi-dev and build again");
    return;
  }
  bool found = false;
  for (const HidFound& device : bus->find())
  {
    if (isSpaceMouse(device.vendor, device.product) && device.mayHaveSixAxes())
    {
      std::string problem;
      static_cast<void>(bus->open(device, problem));
      devices.push_back({ "spacemouse", device.name, device.path, problem });
      found = true;
    }
  }
  if (!found)
  {
    notes.emplace_back(kNoSpaceMouse);
  }
}

} // namespace

void listFalcons(std::vector<ListedDevice>& devices, std::vector<std::string>& notes)
{
  if (!makeUsbFtdiBus())
  {
    notes.emplace_back(
      "built without libusb: no Falcon can be used; install libusb-1.0-0-dev and build again");
    return;
  }
  std::string problem;
  const std::vector<ListedDevice> falcons = findUsbFalcons(problem);
  devices.insert(devices.end(), falcons.begin(), falcons.end());
  if (falcons.empty())
  {
    notes.push_back(problem.empty() ? kNoFalcon : "no Falcon can be found: " + problem);
  }
}

std::vector<ListedDevice> listDevices(std::vector<std::string>& notes)
{
  std::vector<ListedDevice> result;
  listFalcons(result, notes);
  listSpaceMice(result, notes);
  result.push_back({ "simulated", "Simulated hand", "", "" });
  return result;
}

} // namespace pointhaptics
