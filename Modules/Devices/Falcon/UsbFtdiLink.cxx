#include "Devices/DeviceList.h"
#include "Devices/Falcon/FalconDevice.h"
#include "Devices/Falcon/FtdiLink.h"

#include <libusb.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstring>

namespace pointhaptics
{
namespace
{
constexpr std::uint16_t kFalconVendor = 0x0403;
constexpr std::uint16_t kFalconProduct = 0xcb48;
constexpr int kInterface = 0;
constexpr unsigned char kOut = 0x02;
constexpr unsigned char kIn = 0x81;
constexpr std::uint8_t kVendorRequest = 0x40;
constexpr unsigned kControlMilliseconds = 500;
constexpr int kPacket = 64;
constexpr int kStatusBytes = 2;
constexpr int kLongestCommand = 16;
constexpr int kStored = 4 * kFtdiPacket;
/// A cancelled transfer that has not come back after this many seconds counts as lost.
constexpr double kReapSeconds = 1.0;

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) noexcept
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

Status statusOf(int error) noexcept
{
  switch (error)
  {
    case LIBUSB_SUCCESS:
      return Status::Ok;
    case LIBUSB_ERROR_TIMEOUT:
      return Status::DeviceSilent;
    case LIBUSB_ERROR_ACCESS:
      return Status::DeviceNotPermitted;
    default:
      return Status::DeviceLost;
  }
}

class UsbFtdiLink : public FtdiLink
{
public:
  /// Takes over both arguments.
  UsbFtdiLink(libusb_context* context, libusb_device_handle* handle)
    : context_(context)
    , handle_(handle)
    , in_(libusb_alloc_transfer(0))
    , out_(libusb_alloc_transfer(0))
  {
  }

  ~UsbFtdiLink() override
  {
    reap();
    // A transfer that never came back still belongs to libusb.
    if (!inBusy_ && !outBusy_)
    {
      libusb_free_transfer(in_);
      libusb_free_transfer(out_);
    }
    libusb_release_interface(handle_, kInterface);
    libusb_close(handle_);
    libusb_exit(context_);
  }

  bool complete() const { return in_ && out_; }

  Status control(std::uint8_t request, std::uint16_t value) override
  {
    const int result =
      libusb_control_transfer(handle_, kVendorRequest, request, value, 0, nullptr, 0, kControlMilliseconds);
    return statusOf(std::min(result, 0));
  }

  Status send(const std::uint8_t* bytes, int count, int timeoutMilliseconds) override
  {
    // libusb wants writable memory, though it only reads it when sending.
    std::array<unsigned char, kPacket> copy;
    for (int sent = 0; sent < count;)
    {
      const int part = std::min(count - sent, int(copy.size()));
      std::copy(bytes + sent, bytes + sent + part, copy.begin());
      int done = 0;
      const int error =
        libusb_bulk_transfer(handle_, kOut, copy.data(), part, &done, unsigned(timeoutMilliseconds));
      if (error != LIBUSB_SUCCESS)
      {
        return statusOf(error);
      }
      sent += done;
    }
    return Status::Ok;
  }

  Status receive(std::uint8_t* bytes, int& count, int timeoutMilliseconds) override
  {
    count = 0;
    const Clock::time_point start = Clock::now();
    do
    {
      std::array<unsigned char, kPacket> packet;
      int done = 0;
      const int error = libusb_bulk_transfer(
        handle_, kIn, packet.data(), kPacket, &done, unsigned(std::max(1, timeoutMilliseconds)));
      if (error != LIBUSB_SUCCESS && error != LIBUSB_ERROR_TIMEOUT)
      {
        return statusOf(error);
      }
      if (done > kStatusBytes)
      {
        count = done - kStatusBytes;
        std::copy(packet.begin() + kStatusBytes, packet.begin() + done, bytes);
      }
    } while (count == 0 && secondsSince(start) < 1e-3 * timeoutMilliseconds);
    return Status::Ok;
  }

  Status submit(const std::uint8_t* bytes, int count) noexcept override
  {
    if (lost_ || count > kLongestCommand)
    {
      return Status::DeviceLost;
    }
    handleEvents(0.0);
    if (outBusy_)
    {
      return lost_ ? Status::DeviceLost : Status::DeviceNotReady;
    }
    std::memcpy(outBytes_.data(), bytes, std::size_t(count));
    libusb_fill_bulk_transfer(out_, handle_, kOut, outBytes_.data(), count, &UsbFtdiLink::onSent, this, 0);
    outBusy_ = libusb_submit_transfer(out_) == LIBUSB_SUCCESS;
    lost_ = lost_ || !outBusy_;
    return lost_ ? Status::DeviceLost : Status::Ok;
  }

  Status poll(std::uint8_t* bytes, int capacity, int& count, double waitSeconds) noexcept override
  {
    count = 0;
    if (!inBusy_ && !lost_)
    {
      request();
    }
    handleEvents(0.0);
    const Clock::time_point start = waitSeconds > 0.0 ? Clock::now() : Clock::time_point();
    while (stored_ == 0 && !lost_ && waitSeconds > 0.0)
    {
      const double left = waitSeconds - secondsSince(start);
      if (left <= 0.0)
      {
        break;
      }
      handleEvents(left);
    }
    count = std::min(stored_, capacity);
    std::copy(store_.begin(), store_.begin() + count, bytes);
    std::copy(store_.begin() + count, store_.begin() + stored_, store_.begin());
    stored_ -= count;
    return lost_ ? Status::DeviceLost : Status::Ok;
  }

private:
  void handleEvents(double seconds) noexcept
  {
    timeval time{};
    time.tv_usec = long(1e6 * seconds);
    libusb_handle_events_timeout_completed(context_, &time, nullptr);
  }

  void request() noexcept
  {
    libusb_fill_bulk_transfer(in_, handle_, kIn, inBytes_.data(), kPacket, &UsbFtdiLink::onReceived, this, 0);
    inBusy_ = libusb_submit_transfer(in_) == LIBUSB_SUCCESS;
    lost_ = lost_ || !inBusy_;
  }

  static void LIBUSB_CALL onSent(libusb_transfer* transfer)
  {
    auto* self = static_cast<UsbFtdiLink*>(transfer->user_data);
    self->outBusy_ = false;
    self->lost_ = self->lost_ || transfer->status != LIBUSB_TRANSFER_COMPLETED;
  }

  static void LIBUSB_CALL onReceived(libusb_transfer* transfer)
  {
    auto* self = static_cast<UsbFtdiLink*>(transfer->user_data);
    self->inBusy_ = false;
    if (transfer->status != LIBUSB_TRANSFER_COMPLETED)
    {
      self->lost_ = true;
      return;
    }
    const int payload = transfer->actual_length - kStatusBytes;
    if (payload > 0)
    {
      // A reader that waited for so long wants the newest bytes: older ones are dropped.
      self->stored_ = self->stored_ + payload > kStored ? 0 : self->stored_;
      std::copy(transfer->buffer + kStatusBytes, transfer->buffer + transfer->actual_length,
        self->store_.begin() + self->stored_);
      self->stored_ += payload;
    }
    if (!self->closing_)
    {
      self->request();
    }
  }

  /// Cancels and awaits both transfers.
  void reap() noexcept
  {
    closing_ = true;
    if (inBusy_)
    {
      libusb_cancel_transfer(in_);
    }
    if (outBusy_)
    {
      libusb_cancel_transfer(out_);
    }
    const Clock::time_point start = Clock::now();
    while ((inBusy_ || outBusy_) && secondsSince(start) < kReapSeconds)
    {
      handleEvents(0.01);
    }
  }

  libusb_context* context_;
  libusb_device_handle* handle_;
  libusb_transfer* in_;
  libusb_transfer* out_;
  std::array<unsigned char, kPacket> inBytes_{};
  std::array<unsigned char, kLongestCommand> outBytes_{};
  std::array<std::uint8_t, kStored> store_{};
  int stored_ = 0;
  bool inBusy_ = false;
  bool outBusy_ = false;
  bool lost_ = false;
  bool closing_ = false;
};

/// Calls @p visit with each Falcon on the USB.
template <typename Visit>
void forEachFalcon(libusb_context* context, Visit&& visit)
{
  libusb_device** devices = nullptr;
  const ssize_t count = libusb_get_device_list(context, &devices);
  for (ssize_t i = 0; i < count; ++i)
  {
    libusb_device_descriptor descriptor{};
    if (libusb_get_device_descriptor(devices[i], &descriptor) == LIBUSB_SUCCESS &&
      descriptor.idVendor == kFalconVendor && descriptor.idProduct == kFalconProduct)
    {
      visit(devices[i]);
    }
  }
  if (count >= 0)
  {
    libusb_free_device_list(devices, 1);
  }
}

std::string place(libusb_device* device)
{
  return "bus " + std::to_string(libusb_get_bus_number(device)) + " device " +
    std::to_string(libusb_get_device_address(device));
}

std::string systemProblem(int error)
{
  return std::string("the USB system cannot be used (") + libusb_strerror(error) +
    "); is /dev/bus/usb there?";
}

std::string refusal(const std::string& where, int error)
{
  const std::string what = "falcon: found on " + where + ", but ";
  switch (error)
  {
    case LIBUSB_ERROR_ACCESS:
      return what +
        "this user may not open it; install the udev rule (see Documentation/Devices.md) and plug "
        "it in again";
    case LIBUSB_ERROR_BUSY:
      return what + "another program uses it; end that one";
    default:
      return what + "it cannot be opened (" + libusb_strerror(error) + "); unplug it and plug it in again";
  }
}

libusb_device_handle* claim(libusb_device* device, Status& status, std::string& message)
{
  libusb_device_handle* handle = nullptr;
  int error = libusb_open(device, &handle);
  if (error == LIBUSB_SUCCESS)
  {
    // The call fails where the system knows no drivers to detach; claiming then reports it.
    static_cast<void>(libusb_set_auto_detach_kernel_driver(handle, 1));
    error = libusb_claim_interface(handle, kInterface);
  }
  if (error == LIBUSB_SUCCESS)
  {
    status = Status::Ok;
    message.clear();
    return handle;
  }
  if (handle)
  {
    libusb_close(handle);
  }
  status = error == LIBUSB_ERROR_ACCESS ? Status::DeviceNotPermitted : Status::DeviceLost;
  message = refusal(place(device), error);
  return nullptr;
}

std::unique_ptr<FtdiLink> openFalcon(Status& status, std::string& message)
{
  libusb_context* context = nullptr;
  if (const int error = libusb_init(&context); error != LIBUSB_SUCCESS)
  {
    status = Status::DeviceNotFound;
    message = "falcon: " + systemProblem(error);
    return nullptr;
  }
  status = Status::DeviceNotFound;
  message = "falcon: none is plugged in (USB 0403:cb48); check the cable and its power supply";
  libusb_device_handle* handle = nullptr;
  forEachFalcon(
    context, [&](libusb_device* device) { handle = handle ? handle : claim(device, status, message); });
  if (!handle)
  {
    libusb_exit(context);
    return nullptr;
  }
  auto link = std::make_unique<UsbFtdiLink>(context, handle);
  if (!link->complete())
  {
    status = Status::DeviceLost;
    message = "falcon: not enough memory for its transfers; close other programs";
    return nullptr;
  }
  return link;
}

}

FtdiBus makeUsbFtdiBus()
{
  return openFalcon;
}

std::vector<ListedDevice> findUsbFalcons(std::string& problem)
{
  std::vector<ListedDevice> found;
  libusb_context* context = nullptr;
  if (const int error = libusb_init(&context); error != LIBUSB_SUCCESS)
  {
    problem = systemProblem(error);
    return found;
  }
  forEachFalcon(context,
    [&](libusb_device* device)
    {
      libusb_device_handle* handle = nullptr;
      int error = libusb_open(device, &handle);
      if (handle)
      {
        // Only a failed claim tells that another program has the device; a system's own driver gives way
        // later.
        error = libusb_kernel_driver_active(handle, kInterface) == 1
          ? error
          : libusb_claim_interface(handle, kInterface);
        libusb_close(handle); // releases
      }
      found.push_back({ "falcon", "Novint Falcon", place(device),
        error == LIBUSB_SUCCESS ? "" : refusal(place(device), error) });
    });
  libusb_exit(context);
  return found;
}

} // namespace pointhaptics
