#include "Devices/SpaceMouse/HidBus.h"

#include <hidapi.h>

#include <unistd.h>

namespace pointhaptics
{
namespace
{
class HidapiLink : public HidLink
{
public:
  explicit HidapiLink(hid_device* device)
    : device_(device)
  {
  }
  ~HidapiLink() override { hid_close(device_); }
  int read(std::uint8_t* bytes, int capacity, int timeoutMilliseconds) override
  {
    return hid_read_timeout(device_, bytes, std::size_t(capacity), timeoutMilliseconds);
  }
  bool write(const std::uint8_t* bytes, int count) override
  {
    return hid_write(device_, bytes, std::size_t(count)) >= 0;
  }

private:
  hid_device* device_;
};

/// hidapi's texts are wide; names of devices are plain in practice.
std::string narrow(const wchar_t* text)
{
  std::string result;
  for (; text && *text; ++text)
  {
    result += *text >= 0x20 && *text < 0x7f ? char(*text) : '?';
  }
  return result;
}

class HidapiBus : public HidBus
{
public:
  std::vector<HidFound> find() override
  {
    std::vector<HidFound> found;
    hid_device_info* const list = hid_enumerate(0, 0);
    for (const hid_device_info* info = list; info; info = info->next)
    {
      HidFound device;
      device.vendor = info->vendor_id;
      device.product = info->product_id;
      device.path = info->path ? info->path : "";
      device.name = narrow(info->product_string);
      device.usagePage = info->usage_page;
      device.usage = info->usage;
      found.push_back(std::move(device));
    }
    hid_free_enumeration(list);
    return found;
  }

  std::unique_ptr<HidLink> open(const HidFound& device, std::string& message) override
  {
    hid_device* const handle = hid_open_path(device.path.c_str());
    if (handle)
    {
      return std::make_unique<HidapiLink>(handle);
    }
    const bool refused = access(device.path.c_str(), R_OK | W_OK) != 0;
    message = "spacemouse: " + device.path +
      (refused ? ": this user may not open it; install the udev rule (see Documentation/Devices.md) and plug "
                 "it in again"
               : ": cannot be opened; unplug it and plug it in again");
    return nullptr;
  }
};
}

std::unique_ptr<HidBus> makeHidapiBus()
{
  return hid_init() == 0 ? std::make_unique<HidapiBus>() : nullptr;
}

} // namespace pointhaptics
