#include "UnderUmockdev.h"

#include "../Unit/Eventually.h"

#include "Devices/DeviceList.h"
#include "Devices/SpaceMouse/SpaceMouse.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <deque>
#include <initializer_list>
#include <linux/hidraw.h>
#include <memory>
#include <mutex>
#include <string>
#include <sys/ioctl.h>
#include <unistd.h>
#include <vector>

using namespace pointhaptics;
using namespace pointhaptics::trial;

namespace
{
constexpr const char* kPorts = "/sys/devices/pci0000:00/0000:00:14.0/usb1";
constexpr const char* kHidPath = "/sys/devices/pci0000:00/0000:00:14.0/usb1/1-3/1-3:1.0/0003:256F:C635.0007";

/// A multi-axis controller on the generic desktop page; nothing else of it matters here.
const std::vector<std::uint8_t> kDescriptor = { 0x05, 0x01, 0x09, 0x08, 0xa1, 0x01, 0xc0 };

/// A SpaceMouse behind /dev/hidraw0: the real hidapi reads its reports and sets its LED.
class EmulatedCap
{
public:
  explicit EmulatedCap(UMockdevTestbed* bed)
    : bed_(bed)
  {
  }
  /// Whatever searches for devices has ended by now.
  ~EmulatedCap()
  {
    if (plugged_)
    {
      unplug();
    }
    for (const std::unique_ptr<Node>& node : nodes_)
    {
      umockdev_testbed_detach_ioctl(bed_, node->path.c_str(), nullptr);
      g_object_unref(node->handler);
    }
  }

  void plugIn()
  {
    GError* error = nullptr;
    // A new number each time, as the kernel gives while somebody holds the old one.
    const std::string name = "hidraw" + std::to_string(nodes_.size());
    nodes_.push_back(std::make_unique<Node>());
    Node& node = *nodes_.back();
    node.cap = this;
    node.path = "/dev/" + name;
    rawPath_ = kHidPath + ("/hidraw/" + name);
    node.handler = umockdev_ioctl_base_new();
    g_signal_connect(node.handler, "handle-ioctl", G_CALLBACK(&EmulatedCap::onIoctl), &node);
    g_signal_connect(node.handler, "handle-read", G_CALLBACK(&EmulatedCap::onRead), &node);
    g_signal_connect(node.handler, "handle-write", G_CALLBACK(&EmulatedCap::onWrite), &node);
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      plugged_ = &node;
      led_ = -1;
    }
    ASSERT_TRUE(umockdev_testbed_attach_ioctl(bed_, node.path.c_str(), node.handler, &error))
      << error->message;
    for (const std::string& device :
      std::initializer_list<std::string>{
        "P: /devices/pci0000:00/0000:00:14.0/usb1/1-3\nE: DEVTYPE=usb_device\nE: SUBSYSTEM=usb\n"
        "A: idVendor=256f\\n\nA: idProduct=c635\\n\nA: manufacturer=3Dconnexion\\n\n"
        "A: product=SpaceMouse Compact\\n\nA: bcdDevice=0437\\n\nA: serial=1\\n\n",
        "P: /devices/pci0000:00/0000:00:14.0/usb1/1-3/1-3:1.0\nE: DEVTYPE=usb_interface\nE: SUBSYSTEM=usb\n"
        "A: bInterfaceNumber=00\\n\n",
        "P: /devices/pci0000:00/0000:00:14.0/usb1/1-3/1-3:1.0/0003:256F:C635.0007\nE: SUBSYSTEM=hid\n"
        "E: HID_ID=0003:0000256F:0000C635\nE: HID_NAME=3Dconnexion SpaceMouse Compact\nE: HID_UNIQ=\n"
        "A: uevent=HID_ID=0003:0000256F:0000C635\\nHID_NAME=3Dconnexion SpaceMouse Compact\\nHID_UNIQ=\\n\n"
        "H: report_descriptor=05010908a101c0\n",
        "P: " + rawPath_.substr(4) + "\nN: " + name + "\nE: SUBSYSTEM=hidraw\nE: DEVNAME=" + node.path +
          "\nL: device=../../../0003:256F:C635.0007\n" })
    {
      ASSERT_TRUE(umockdev_testbed_add_from_string(bed_, device.c_str(), &error)) << error->message;
    }
    // The node is a terminal: with a byte in it poll() always says that there is something to read.
    const int terminal = umockdev_testbed_get_dev_fd(bed_, node.path.c_str());
    ASSERT_EQ(write(terminal, "\n", 1), 1);
  }

  /// Answers of the old node stay attached to the end, and are errors: a search that has it open, or is
  /// about to, would be ended by umockdev, with the program, if nobody answered.
  void unplug()
  {
    std::string path;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      path = plugged_->path;
      plugged_ = nullptr;
      reports_.clear();
    }
    umockdev_testbed_uevent(bed_, rawPath_.c_str(), "remove");
    for (std::string device = rawPath_; device != kPorts; device.resize(device.rfind('/')))
    {
      if (device.compare(device.rfind('/'), std::string::npos, "/hidraw") != 0)
      {
        umockdev_testbed_remove_device(bed_, device.c_str());
      }
    }
    char* const root = umockdev_testbed_get_root_dir(bed_);
    unlink((root + path).c_str());
    g_free(root);
  }

  void say(const std::vector<std::uint8_t>& report)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    reports_.push_back(report);
  }
  int led()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return led_;
  }

private:
  /// Names of the device while it was plugged in once.
  struct Node
  {
    EmulatedCap* cap = nullptr;
    std::string path;
    UMockdevIoctlBase* handler = nullptr;
  };

  static int onIoctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, Node*)
  {
    UMockdevIoctlData* const argument = umockdev_ioctl_client_get_arg(client);
    const unsigned long request = umockdev_ioctl_client_get_request(client);
    if (request != HIDIOCGRDESCSIZE && request != HIDIOCGRDESC)
    {
      umockdev_ioctl_client_complete(client, -1, EINVAL);
      return TRUE;
    }
    hidraw_report_descriptor descriptor{};
    descriptor.size = std::uint32_t(kDescriptor.size());
    std::copy(kDescriptor.begin(), kDescriptor.end(), descriptor.value);
    const std::size_t size = request == HIDIOCGRDESC ? sizeof(descriptor) : sizeof(descriptor.size);
    UMockdevIoctlData* const data = umockdev_ioctl_data_resolve(argument, 0, size, nullptr);
    umockdev_ioctl_data_update(data, 0, reinterpret_cast<std::uint8_t*>(&descriptor), int(size));
    g_object_unref(data);
    umockdev_ioctl_client_complete(client, 0, 0);
    return TRUE;
  }

  /// One report for each read, as the kernel does it.
  static int onRead(UMockdevIoctlBase*, UMockdevIoctlClient* client, Node* node)
  {
    EmulatedCap& self = *node->cap;
    const std::lock_guard<std::mutex> lock(self.mutex_);
    if (self.plugged_ != node || self.reports_.empty())
    {
      umockdev_ioctl_client_complete(client, -1, self.plugged_ == node ? EAGAIN : EIO);
      return TRUE;
    }
    std::vector<std::uint8_t> report = self.reports_.front();
    self.reports_.pop_front();
    umockdev_ioctl_data_update(umockdev_ioctl_client_get_arg(client), 0, report.data(), int(report.size()));
    umockdev_ioctl_client_complete(client, long(report.size()), 0);
    return TRUE;
  }

  static int onWrite(UMockdevIoctlBase*, UMockdevIoctlClient* client, Node* node)
  {
    EmulatedCap& self = *node->cap;
    const std::lock_guard<std::mutex> lock(self.mutex_);
    if (self.plugged_ != node)
    {
      umockdev_ioctl_client_complete(client, -1, EIO);
      return TRUE;
    }
    UMockdevIoctlData* const data = umockdev_ioctl_client_get_arg(client);
    if (data->data_len == 2 && data->data[0] == 4)
    {
      self.led_ = data->data[1];
    }
    umockdev_ioctl_client_complete(client, data->data_len, 0);
    return TRUE;
  }

  UMockdevTestbed* bed_;
  std::vector<std::unique_ptr<Node>> nodes_;
  std::string rawPath_;
  std::mutex mutex_;
  /// Null while it is unplugged.
  Node* plugged_ = nullptr;
  int led_ = -1;
  std::deque<std::vector<std::uint8_t>> reports_;
};

using EmulatedHid = UnderUmockdev;
}

TEST_F(EmulatedHid, IsListedByItsName)
{
  EmulatedCap cap(bed());
  cap.plugIn();
  std::vector<std::string> notes;
  const std::vector<ListedDevice> list = listDevices(notes);
  ASSERT_EQ(list.size(), 2u);
  EXPECT_EQ(list[0].kind, "spacemouse");
  EXPECT_EQ(list[0].place, "/dev/hidraw0");
  EXPECT_NE(list[0].name.find("SpaceMouse"), std::string::npos) << list[0].name;
  EXPECT_TRUE(list[0].problem.empty()) << list[0].problem;
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("no Falcon was found"), std::string::npos) << notes[0];
}

TEST_F(EmulatedHid, MovesIsUnpluggedAndComesBack)
{
  EmulatedCap cap(bed());
  cap.plugIn();
  SpaceMouseSettings settings;
  settings.deadZone = 0.0;
  settings.staleSeconds = 100.0;
  settings.retrySeconds = 0.02;
  SpaceMouse mouse(settings);
  ASSERT_EQ(mouse.start(), Status::Ok) << mouse.message();
  for (int round = 0; round < 3; ++round)
  {
    ASSERT_TRUE(eventually([&] { return mouse.motion().connected && cap.led() == 1; }))
      << round << " " << mouse.message();
    cap.say({ 1, 35, 0, 70, 0, 0x5e, 0x01 }); // 35, 70, 350
    cap.say({ 2, 0x5e, 0x01, 0, 0, 0, 0 });   // 350
    cap.say({ 3, 2, 0 });
    EXPECT_TRUE(eventually([&] { return mouse.motion().buttons == 2; }));
    EXPECT_DOUBLE_EQ(mouse.motion().shift.x, 0.1);
    EXPECT_DOUBLE_EQ(mouse.motion().shift.y, -1.0);
    EXPECT_DOUBLE_EQ(mouse.motion().shift.z, 0.2);
    EXPECT_DOUBLE_EQ(mouse.motion().turn.x, 1.0);
    cap.say({ 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0x5e, 0x01 }); // the long layout
    EXPECT_TRUE(eventually([&] { return mouse.motion().turn.y == -1.0; }));
    EXPECT_EQ(mouse.motion().shift, Vec3());
    cap.unplug();
    EXPECT_TRUE(eventually([&] { return !mouse.motion().connected; }));
    EXPECT_TRUE(mouse.motion().resting());
    cap.plugIn();
  }
  ASSERT_TRUE(eventually([&] { return mouse.motion().connected && cap.led() == 1; }));
  mouse.stop();
  EXPECT_EQ(cap.led(), 0);
}
