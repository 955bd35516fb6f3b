/// @file
/// A bus of one FalconModel, in process: plugged in and out, and distorting what the model says. Every
/// command is answered at once, in the thread that sends it.
#pragma once

#include "FalconModel.h"

#include "Devices/Falcon/FtdiLink.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

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
  std::function<void(std::vector<std::uint8_t>&)> distort; ///< Changes the answers of a tick; may be empty.
  std::function<void(FalconModel&)> onCommand;             ///< Moves the hand before each command of a tick.
  bool receivesSlowly = false;                             ///< While booting, 10 ms for no answer.
  bool busy = false; ///< Commands are refused as if the one before were still under way.
};

struct NoGuard
{
};

/// @tparam Guard lives while a tick uses the model, which is not the driver's work.
template <typename Guard = NoGuard>
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
    [[maybe_unused]] const Guard guard{};
    const std::lock_guard<std::mutex> lock(wire_.mutex);
    if (wire_.busy)
    {
      return Status::DeviceNotReady;
    }
    if (wire_.onCommand)
    {
      wire_.onCommand(wire_.model);
    }
    wire_.model.write(bytes, std::size_t(count));
    return here();
  }
  Status poll(std::uint8_t* bytes, int capacity, int& count, double) noexcept override
  {
    [[maybe_unused]] const Guard guard{};
    const std::lock_guard<std::mutex> lock(wire_.mutex);
    if (!wire_.distort)
    {
      count = int(wire_.model.read(bytes, std::size_t(capacity)));
      return here();
    }
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

/// @p wire outlives the bus.
template <typename Guard = NoGuard>
FtdiBus wiredBus(FalconOnAWire& wire)
{
  return [&wire](Status& status, std::string& message) -> std::unique_ptr<FtdiLink>
  {
    const std::lock_guard<std::mutex> lock(wire.mutex);
    status = wire.plugged ? wire.openStatus : Status::DeviceNotFound;
    message = status == Status::Ok ? "" : "the test's bus refuses";
    return status == Status::Ok ? std::make_unique<WiredLink<Guard>>(wire) : nullptr;
  };
}

} // namespace trial
} // namespace pointhaptics
