#include "EmulatedFalcon.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <string>
#include <thread>

#include <linux/usbdevice_fs.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace pointhaptics
{
namespace trial
{
namespace
{
constexpr const char* kNode = "/dev/bus/usb/001/002";
constexpr const char* kPath = "/sys/devices/pci0000:00/0000:00:14.0/usb1/1-1";
/// Device, configuration, interface 0, bulk IN 0x81 and OUT 0x02 of 64 bytes.
constexpr const char* kDevice = "P: /devices/pci0000:00/0000:00:14.0/usb1/1-1\n"
                                "N: bus/usb/001/002\n"
                                "E: DEVTYPE=usb_device\n"
                                "E: SUBSYSTEM=usb\n"
                                "E: BUSNUM=001\n"
                                "E: DEVNUM=002\n"
                                "E: DEVNAME=/dev/bus/usb/001/002\n"
                                "E: PRODUCT=403/cb48/400\n"
                                "A: busnum=1\\n\n"
                                "A: devnum=2\\n\n"
                                "A: speed=12\\n\n"
                                "A: bConfigurationValue=1\\n\n"
                                "A: idVendor=0403\\n\n"
                                "A: idProduct=cb48\\n\n"
                                "H: descriptors="
                                "12011001000000080304"
                                "48cb00040102"
                                "0301"
                                "0902200001010080"
                                "2d"
                                "0904000002ffffff02"
                                "07058102400000"
                                "07050202400000\n";

usbdevfs_urb& urbOf(UMockdevIoctlData* data)
{
  return *reinterpret_cast<usbdevfs_urb*>(data->data);
}
}

EmulatedFalcon::EmulatedFalcon(UMockdevTestbed* bed)
  : bed_(bed)
{
}

EmulatedFalcon::~EmulatedFalcon()
{
  if (plugged_)
  {
    unplug();
  }
  if (handler_)
  {
    umockdev_testbed_detach_ioctl(bed_, kNode, nullptr);
    g_object_unref(handler_);
  }
}

/// The first time, before the node is there, somebody begins to listen to whoever will open it. That never
/// ends by an unplugging: a user who opens the node just then has connected, but waits to be accepted. Who
/// stops to listen cuts that connection, and the next call on it, the user's first, would end the program
/// ("Error communicating with ioctl socket").
void EmulatedFalcon::plugIn()
{
  GError* error = nullptr;
  if (!handler_)
  {
    handler_ = umockdev_ioctl_base_new();
    g_signal_connect(handler_, "handle-ioctl", G_CALLBACK(&EmulatedFalcon::onIoctl), this);
    ASSERT_TRUE(umockdev_testbed_attach_ioctl(bed_, kNode, handler_, &error)) << error->message;
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    plugged_ = true;
    claimed_ = false;
    this->powerOn();
  }
  ASSERT_TRUE(umockdev_testbed_add_from_string(bed_, kDevice, &error)) << error->message;
}

void EmulatedFalcon::unplug()
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    plugged_ = false;
    claimed_ = false;
    for (Transfer& transfer : transfers_)
    {
      transfer.status = transfer.done ? transfer.status : -ESHUTDOWN;
      transfer.done = true;
    }
  }
  // The kernel keeps the node of an open device until its user has taken back what was under way.
  for (int i = 0; i < 200 && pendingTransfers() > 0; ++i)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  umockdev_testbed_uevent(bed_, kPath, "remove");
  umockdev_testbed_remove_device(bed_, kPath);
  char* const root = umockdev_testbed_get_root_dir(bed_);
  unlink((std::string(root) + kNode).c_str());
  g_free(root);
  const std::lock_guard<std::mutex> lock(mutex_);
  for (Transfer& transfer : transfers_)
  {
    g_object_unref(transfer.urb);
    g_object_unref(transfer.buffer);
  }
  transfers_.clear();
}

bool EmulatedFalcon::claimed()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return claimed_;
}

int EmulatedFalcon::pendingTransfers()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return int(transfers_.size());
}

void EmulatedFalcon::refuseClaims(int error)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  refusal_ = error;
}

void EmulatedFalcon::garbage(const std::vector<std::uint8_t>& bytes)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  model_.pending().insert(model_.pending().end(), bytes.begin(), bytes.end());
}

int EmulatedFalcon::onIoctl(UMockdevIoctlBase*, UMockdevIoctlClient* client, EmulatedFalcon* self)
{
  const std::lock_guard<std::mutex> lock(self->mutex_);
  self->answer(client);
  return TRUE;
}

void EmulatedFalcon::answer(UMockdevIoctlClient* client)
{
  const unsigned long request = umockdev_ioctl_client_get_request(client);
  if (!plugged_ && request != USBDEVFS_REAPURB && request != USBDEVFS_REAPURBNDELAY)
  {
    umockdev_ioctl_client_complete(client, -1, ENODEV);
    return;
  }
  switch (request)
  {
    case USBDEVFS_GET_CAPABILITIES:
    {
      std::uint32_t capabilities =
        USBDEVFS_CAP_BULK_CONTINUATION | USBDEVFS_CAP_NO_PACKET_SIZE_LIM | USBDEVFS_CAP_REAP_AFTER_DISCONNECT;
      UMockdevIoctlData* const data =
        umockdev_ioctl_data_resolve(umockdev_ioctl_client_get_arg(client), 0, sizeof(capabilities), nullptr);
      umockdev_ioctl_data_update(
        data, 0, reinterpret_cast<std::uint8_t*>(&capabilities), int(sizeof(capabilities)));
      g_object_unref(data);
      umockdev_ioctl_client_complete(client, 0, 0);
      return;
    }
    case USBDEVFS_CLAIMINTERFACE:
    case USBDEVFS_DISCONNECT_CLAIM:
      claimed_ = refusal_ == 0;
      umockdev_ioctl_client_complete(client, claimed_ ? 0 : -1, refusal_);
      return;
    case USBDEVFS_RELEASEINTERFACE:
      claimed_ = false;
      umockdev_ioctl_client_complete(client, 0, 0);
      return;
    case USBDEVFS_SUBMITURB:
      submit(client);
      return;
    case USBDEVFS_REAPURB:
    case USBDEVFS_REAPURBNDELAY:
      reap(client);
      return;
    case USBDEVFS_DISCARDURB:
      discard(client);
      return;
    default: // No kernel driver is bound.
      umockdev_ioctl_client_complete(client, -1, ENODATA);
  }
}

void EmulatedFalcon::submit(UMockdevIoctlClient* client)
{
  Transfer transfer;
  transfer.urb =
    umockdev_ioctl_data_resolve(umockdev_ioctl_client_get_arg(client), 0, sizeof(usbdevfs_urb), nullptr);
  transfer.buffer = umockdev_ioctl_data_resolve(
    transfer.urb, offsetof(usbdevfs_urb, buffer), std::size_t(urbOf(transfer.urb).buffer_length), nullptr);
  transfer.submitted = Clock::now();
  const usbdevfs_urb& urb = urbOf(transfer.urb);
  this->catchUp();
  if (urb.type == USBDEVFS_URB_TYPE_CONTROL)
  {
    control(transfer.buffer->data);
    transfer.done = true;
  }
  else if ((urb.endpoint & 0x80) == 0)
  {
    model_.write(transfer.buffer->data, std::size_t(urb.buffer_length));
    transfer.length = urb.buffer_length;
    transfer.done = true;
  }
  transfers_.push_back(transfer);
  umockdev_ioctl_client_complete(client, 0, 0);
}

void EmulatedFalcon::control(const std::uint8_t* setup)
{
  EXPECT_EQ(setup[0], 0x40) << "vendor request to the device";
  EXPECT_EQ(setup[4] | setup[5], 0) << "index";
  model_.control(setup[1], std::uint16_t(setup[2] | (setup[3] << 8)));
}

void EmulatedFalcon::finish(Transfer& transfer)
{
  if (transfer.done)
  {
    return;
  }
  std::vector<std::uint8_t> bytes =
    this->packet(std::size_t(urbOf(transfer.urb).buffer_length), transfer.submitted);
  transfer.done = !bytes.empty();
  if (transfer.done)
  {
    transfer.length = int(bytes.size());
    umockdev_ioctl_data_update(transfer.buffer, 0, bytes.data(), transfer.length);
  }
}

void EmulatedFalcon::reap(UMockdevIoctlClient* client)
{
  this->catchUp();
  for (auto transfer = transfers_.begin(); transfer != transfers_.end(); ++transfer)
  {
    finish(*transfer);
    if (!transfer->done)
    {
      continue;
    }
    usbdevfs_urb urb = urbOf(transfer->urb);
    urb.status = transfer->status;
    urb.actual_length = transfer->length;
    umockdev_ioctl_data_update(transfer->urb, 0, reinterpret_cast<std::uint8_t*>(&urb), int(sizeof(urb)));
    UMockdevIoctlData* const where =
      umockdev_ioctl_data_resolve(umockdev_ioctl_client_get_arg(client), 0, sizeof(void*), nullptr);
    umockdev_ioctl_data_set_ptr(where, 0, transfer->urb);
    g_object_unref(where);
    umockdev_ioctl_client_complete(client, 0, 0);
    g_object_unref(transfer->urb);
    g_object_unref(transfer->buffer);
    transfers_.erase(transfer);
    return;
  }
  umockdev_ioctl_client_complete(client, -1, plugged_ ? EAGAIN : ENODEV);
}

void EmulatedFalcon::discard(UMockdevIoctlClient* client)
{
  unsigned long address = 0;
  std::memcpy(&address, umockdev_ioctl_client_get_arg(client)->data, sizeof(address));
  for (Transfer& transfer : transfers_)
  {
    if (transfer.urb->client_addr == address && !transfer.done)
    {
      transfer.done = true;
      transfer.status = -ENOENT;
      umockdev_ioctl_client_complete(client, 0, 0);
      return;
    }
  }
  umockdev_ioctl_client_complete(client, -1, EINVAL);
}

} // namespace trial
} // namespace pointhaptics
