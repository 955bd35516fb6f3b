// Replaces UsbFtdiLink.cxx where libusb is not installed.
#include "Devices/DeviceList.h"
#include "Devices/Falcon/FalconDevice.h"

namespace pointhaptics
{

FtdiBus makeUsbFtdiBus()
{
  return nullptr;
}

std::vector<ListedDevice> findUsbFalcons(std::string&)
{
  return {};
}

} // namespace pointhaptics
