/// @file
/// A Falcon on its wire, with the driver and a made-up firmware.
#pragma once

#include "FalconWire.h"

#include "../Eventually.h"

#include "Devices/Falcon/FalconDevice.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <functional>
#include <random>
#include <string>

namespace pointhaptics
{
namespace trial
{

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
    device = std::make_unique<FalconDevice>(settings, wiredBus(wire));
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
