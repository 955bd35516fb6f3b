#include "UhidCap.h"

#include <algorithm>

#include <fcntl.h>
#include <linux/input.h>
#include <linux/uhid.h>
#include <unistd.h>

namespace pointhaptics
{
namespace trial
{
namespace
{
constexpr std::uint32_t kVendor = 0x256f;
constexpr std::uint32_t kProduct = 0xc635;
constexpr std::uint8_t kLedReport = 4;

/// A multi-axis controller: reports 1 and 2 with three axes of 16 bits each, 3 with two buttons, and 4, to
/// the device, with its LED.
const std::vector<std::uint8_t> kDescriptor = { 0x05, 0x01, 0x09, 0x08, 0xa1,
  0x01,                                                             // generic desktop, multi-axis controller
  0xa1, 0x00, 0x85, 0x01, 0x16, 0xa2, 0xfe, 0x26, 0x5e, 0x01,       // report 1, -350 to 350
  0x09, 0x30, 0x09, 0x31, 0x09, 0x32, 0x75, 0x10, 0x95, 0x03, 0x81, // X Y Z
  0x06, 0xc0,                                                       // relative
  0xa1, 0x00, 0x85, 0x02,                                           // report 2
  0x09, 0x33, 0x09, 0x34, 0x09, 0x35, 0x75, 0x10, 0x95, 0x03, 0x81, // Rx Ry Rz
  0x06, 0xc0,                                                       //
  0xa1, 0x02, 0x85, 0x03, 0x05, 0x09, 0x19, 0x01, 0x29, 0x02, 0x15, // report 3, buttons 1 and 2
  0x00, 0x25, 0x01, 0x75, 0x01, 0x95, 0x02, 0x81, 0x02, 0x95, 0x0e, //
  0x81, 0x03, 0xc0,                                                 // filled up to 16 bits
  0xa1, 0x02, 0x85, 0x04, 0x05, 0x08, 0x09, 0x4b, 0x15, 0x00, 0x25, // report 4, an LED
  0x01, 0x75, 0x01, 0x95, 0x01, 0x91, 0x02, 0x95, 0x07, 0x91, 0x03, //
  0xc0, 0xc0 };

bool tell(int uhid, const uhid_event& event)
{
  return write(uhid, &event, sizeof(event)) == ssize_t(sizeof(event));
}
}

bool UhidCap::plugIn()
{
  uhid_ = open("/dev/uhid", O_RDWR | O_CLOEXEC | O_NONBLOCK);
  led_ = -1;
  uhid_event event{};
  event.type = UHID_CREATE2;
  uhid_create2_req& request = event.u.create2;
  std::strcpy(reinterpret_cast<char*>(request.name), "3Dconnexion SpaceMouse Compact");
  request.bus = BUS_USB;
  request.vendor = kVendor;
  request.product = kProduct;
  request.rd_size = std::uint16_t(kDescriptor.size());
  std::copy(kDescriptor.begin(), kDescriptor.end(), request.rd_data);
  return uhid_ >= 0 && tell(uhid_, event);
}

void UhidCap::unplug()
{
  if (uhid_ >= 0)
  {
    close(uhid_); // which takes the device away
    uhid_ = -1;
  }
}

void UhidCap::say(const std::vector<std::uint8_t>& report)
{
  uhid_event event{};
  event.type = UHID_INPUT2;
  event.u.input2.size = std::uint16_t(report.size());
  std::copy(report.begin(), report.end(), event.u.input2.data);
  static_cast<void>(tell(uhid_, event));
}

int UhidCap::led()
{
  uhid_event event{};
  while (uhid_ >= 0 && read(uhid_, &event, sizeof(event)) > 0)
  {
    if (event.type == UHID_OUTPUT && event.u.output.size == 2 && event.u.output.data[0] == kLedReport)
    {
      led_ = event.u.output.data[1];
    }
  }
  return led_;
}

} // namespace trial
} // namespace pointhaptics
