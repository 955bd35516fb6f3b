/// @file
/// A bus of one FalconModel, in process: plugged in and out, and distorting what the model says.
#pragma once

#include "FalconModel.h"

#include "../Eventually.h"

#include "Devices/Falcon/FalconDevice.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <functional>
#include <mutex>
#include <random>
#include <string>
#include <thread>

namespace pointhaptics
{
namespace trial
{

/// The model and its cable. The mutex stands for the wire: both the driver's threads and the test use it.
struct FalconOnAWire
{
  std::mutex mutex;
  FalconModel model;
  bool plugged = true;
  Status openStatus = Status::Ok; ///< Answer of the bus in place of opening.
  std::atomic<int> openLinks{ 0 };
  std::function<void(std::vector<std::uint8_t>&)> distort = [](std::vector<std::uint8_t>&) {};
  bool receivesSlowly = false; ///< While booting, 10 ms for no answer.
  bool busy = false;           ///< Commands are refused as if the one before were still under way.
};

class WiredLink : public FtdiLink
{
public:
  explicit WiredLink(FalconOnAWire& wire)
    : wire_(wire)
  {
    ++wire_.openLinks;
  }
  ~WiredLink() override { --wire_.openLinks; }

  Status control(std::uint8_t request, std::uint16_t value) override
  {
    const std::lock_guard<std::mutex> lock(wire_.mutex);
    wire_.model.control(request, value);
    return here();
  }
  Status send(const std::uint8_t* bytes, int count, int) override
  {
    const std::lock_guard<std::mutex> lock(wire_.mutex);
    wire_.model.write(bytes, std::size_t(count));
    return here();
  }
  Status receive(std::uint8_t* bytes, int& count, int) override
  {
    const std::lock_guard<std::mutex> lock(wire_.mutex);
    count = int(wire_.model.read(bytes, kFtdiPacket));
    if (count == 0 && wire_.receivesSlowly)
    {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return here();
  }
  Status submit(const std::uint8_t* bytes, int count) noexcept override
  {
    const std::lock_guard<std::mutex> lock(wire_.mutex);
    if (wire_.busy)
    {
      return Status::DeviceNotReady;
    }
    wire_.model.write(bytes, std::size_t(count));
    return here();
  }
  Status poll(std::uint8_t* bytes, int capacity, int& count, double) noexcept override
  {
    const std::lock_guard<std::mutex> lock(wire_.mutex);
    std::vector<std::uint8_t> all(std::size_t(capacity), 0);
    all.resize(wire_.model.read(all.data(), all.size()));
    wire_.distort(all);
    count = int(std::min(all.size(), std::size_t(capacity)));
    std::copy(all.begin(), all.begin() + count, bytes);
    return here();
  }

private:
  Status here() const { return wire_.plugged ? Status::Ok : Status::DeviceLost; }
  FalconOnAWire& wire_;
};

class WiredBus : public FtdiBus
{
public:
  explicit WiredBus(FalconOnAWire& wire)
    : wire_(wire)
  {
  }
  std::unique_ptr<FtdiLink> open(Status& status, std::string& message) override
  {
    const std::lock_guard<std::mutex> lock(wire_.mutex);
    status = wire_.plugged ? wire_.openStatus : Status::DeviceNotFound;
    message = status == Status::Ok ? "" : "the test's bus refuses";
    return status == Status::Ok ? std::make_unique<WiredLink>(wire_) : nullptr;
  }

private:
  FalconOnAWire& wire_;
};

/// Random bytes, as nobody's firmware.
inline std::vector<std::uint8_t> madeUpFirmware(std::size_t size = 8492)
{
  std::mt19937_64 random(7);
  std::vector<std::uint8_t> bytes(size);
  for (std::uint8_t& byte : bytes)
  {
    byte = std::uint8_t(random());
  }
  return bytes;
}

/// A file that goes when the test ends.
class FirmwareFile
{
public:
  explicit FirmwareFile(const std::vector<std::uint8_t>& bytes, const std::string& name = "firmware")
    : path_(::testing::TempDir() + "pointhaptics-" + name + "-" +
        std::to_string(std::chrono::steady_clock::now().time_since_epoch().count()))
  {
    std::ofstream file(path_, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
  }
  ~FirmwareFile() { std::remove(path_.c_str()); }
  const std::string& path() const { return path_; }

private:
  std::string path_;
};

/// Device, wire and firmware in one place, and ticks of a millisecond.
class FalconBench
{
public:
  explicit FalconBench(FalconSettings settings = {})
    : file(madeUpFirmware())
  {
    wire.model.expectedFirmware = madeUpFirmware();
    settings.firmwareFile = settings.firmwareFile.empty() ? file.path() : settings.firmwareFile;
    settings.retrySeconds = 0.002;
    device = std::make_unique<FalconDevice>(settings, std::make_unique<WiredBus>(wire));
  }

  /// One tick: read, @p force of the last position, write, a millisecond of the hand's life. The force is
  /// asked for whatever read() said: keeping it back is the driver's work.
  Status tick(const std::function<Vec3(const Vec3&)>& force = [](const Vec3&) { return Vec3(); })
  {
    const Status status = device->read(time, hand);
    const Status written = device->write(time, force(hand.position));
    const std::lock_guard<std::mutex> lock(wire.mutex);
    wire.model.move(1e-3);
    time += 1e-3;
    return status != Status::Ok ? status : written;
  }

  /// Ticks until the ramp is over. @return true where the device is armed then.
  bool arm(const std::function<Vec3(const Vec3&)>& force = [](const Vec3&) { return Vec3(); })
  {
    for (int i = 0; i < 1100; ++i)
    {
      static_cast<void>(tick(force));
    }
    return device->state() == FalconState::Armed;
  }

  FirmwareFile file;
  FalconOnAWire wire;
  std::unique_ptr<FalconDevice> device;
  HandState hand;
  double time = 0.0;
};

} // namespace trial
} // namespace pointhaptics
