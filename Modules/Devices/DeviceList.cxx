#include "Devices/DeviceList.h"

#include "Devices/Falcon/FalconDevice.h"
#include "Devices/Falcon/UsbFtdi.h"
#include "Devices/SpaceMouse/HidBus.h"
#include "Devices/SpaceMouse/SpaceMouseReport.h"

namespace pointhaptics
{

std::vector<ListedDevice> listDevices(std::vector<std::string>& notes)
{
  std::vector<ListedDevice> result;
  for (const UsbFalcon& falcon : findUsbFalcons())
  {
    result.push_back({ "falcon", "Novint Falcon", falcon.place, falcon.problem });
  }
  if (!makeUsbFtdiBus())
  {
    notes.emplace_back(
      "built without libusb: no Falcon can be used; install libusb-1.0-0-dev and build again");
  }
  if (const std::unique_ptr<HidBus> bus = makeHidapiBus())
  {
    for (const HidFound& device : bus->find())
    {
      if (isSpaceMouse(device.vendor, device.product) && device.mayHaveSixAxes())
      {
        std::string problem;
        static_cast<void>(bus->open(device, problem));
        result.push_back({ "spacemouse", device.name, device.path, problem });
      }
    }
  }
  else
  {
    notes.emplace_back(
      "built without hidapi: no SpaceMouse can be used; install libhidapi-dev and build again");
  }
  result.push_back({ "simulated", "Simulated hand", "", "" });
  return result;
}

} // namespace pointhaptics
