#include "Devices/SpaceMouse/SpaceMouse.h"

#include "Haptics/Servo/LatestValue.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

namespace pointhaptics
{
namespace
{
constexpr int kReadMilliseconds = 20;
constexpr int kLongestReport = 64;
constexpr std::uint8_t kLedReport = 0x04;

double now() noexcept
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void setLed(HidLink& link, bool on)
{
  const std::uint8_t report[] = { kLedReport, std::uint8_t(on ? 1 : 0) };
  // A device without an LED refuses; nothing depends on it.
  static_cast<void>(link.write(report, int(sizeof(report))));
}

/// State of the device for other threads, one value: a puck that is gone is at rest in the very same read.
struct Cap
{
  /// Holds all times, so that each reader sees which values are stale at that moment.
  SpaceMouseDecoder decoder;
  bool connected = false;
};
}

struct SpaceMouse::Implementation
{
  SpaceMouseSettings settings;
  std::unique_ptr<HidBus> bus;
  std::thread thread;
  std::atomic<bool> quit{ false };
  LatestValue<Cap> newest;
  mutable std::mutex mutex;
  std::condition_variable changed;
  std::string message;

  void run();
  std::unique_ptr<HidLink> find();
  void serve(HidLink& link);
  void say(const std::string& text)
  {
    const std::lock_guard<std::mutex> lock(mutex);
    message = text;
  }
};

std::unique_ptr<HidLink> SpaceMouse::Implementation::find()
{
  std::string text = kNonePluggedIn;
  for (const HidFound& found : bus->find())
  {
    if (!isSpaceMouse(found.vendor, found.product) || !found.mayHaveSixAxes())
    {
      continue;
    }
    if (std::unique_ptr<HidLink> link = bus->open(found, text))
    {
      say(found.name);
      return link;
    }
  }
  say(text);
  return nullptr;
}

void SpaceMouse::Implementation::serve(HidLink& link)
{
  Cap cap{ SpaceMouseDecoder(settings), true };
  newest.write(cap);
  setLed(link, true);
  while (!quit)
  {
    std::uint8_t bytes[kLongestReport];
    const int count = link.read(bytes, kLongestReport, kReadMilliseconds);
    if (count < 0)
    {
      break;
    }
    if (count > 0 && cap.decoder.take(bytes, count, now()))
    {
      newest.write(cap);
    }
  }
  if (quit)
  {
    setLed(link, false);
  }
  newest.write(Cap());
}

void SpaceMouse::Implementation::run()
{
  const auto pause = std::chrono::duration_cast<std::chrono::nanoseconds>(
    std::chrono::duration<double>(settings.retrySeconds));
  while (!quit)
  {
    if (const std::unique_ptr<HidLink> link = find())
    {
      serve(*link);
      if (!quit)
      {
        say("spacemouse: it was unplugged; plug it in again, it starts by itself");
      }
    }
    std::unique_lock<std::mutex> lock(mutex);
    changed.wait_for(lock, pause, [this] { return quit.load(); });
  }
}

SpaceMouse::SpaceMouse(const SpaceMouseSettings& settings)
  : SpaceMouse(settings, makeHidapiBus())
{
}

SpaceMouse::SpaceMouse(const SpaceMouseSettings& settings, std::unique_ptr<HidBus> bus)
  : implementation_(std::make_unique<Implementation>())
{
  implementation_->settings = settings;
  implementation_->bus = std::move(bus);
}

SpaceMouse::~SpaceMouse()
{
  stop();
}

Status SpaceMouse::start()
{
  stop();
  Implementation& self = *implementation_;
  if (!self.bus)
  {
    self.say("spacemouse: built without hidapi; install libhidapi-dev and configure the build again");
    return Status::DeviceNotFound;
  }
  self.quit = false;
  self.thread = std::thread([&self] { self.run(); });
  return Status::Ok;
}

void SpaceMouse::stop()
{
  Implementation& self = *implementation_;
  {
    const std::lock_guard<std::mutex> lock(self.mutex);
    self.quit = true;
    self.changed.notify_all();
  }
  if (self.thread.joinable())
  {
    self.thread.join();
  }
}

SpaceMouseMotion SpaceMouse::motion() const noexcept
{
  const Cap cap = implementation_->newest.read();
  SpaceMouseMotion result = cap.decoder.motion(now());
  result.connected = cap.connected;
  return result;
}

std::string SpaceMouse::message() const
{
  const std::lock_guard<std::mutex> lock(implementation_->mutex);
  return implementation_->message;
}

} // namespace pointhaptics
