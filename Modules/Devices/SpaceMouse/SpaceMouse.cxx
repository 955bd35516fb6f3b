#include "Devices/SpaceMouse/SpaceMouse.h"

#include "Devices/DriverThread.h"
#include "Haptics/Servo/LatestValue.h"

#include <chrono>

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
  LatestValue<Cap> newest;
  DriverThread thread;

  bool run();
  std::unique_ptr<HidLink> find();
  void serve(HidLink& link);
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
      thread.report(Status::Ok, found.name);
      return link;
    }
  }
  thread.report(Status::DeviceNotFound, text);
  return nullptr;
}

void SpaceMouse::Implementation::serve(HidLink& link)
{
  Cap cap{ SpaceMouseDecoder(settings), true };
  newest.write(cap);
  setLed(link, true);
  while (!thread.stopping())
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
  if (thread.stopping())
  {
    setLed(link, false);
  }
  newest.write(Cap());
}

/// Looks for the device and serves it until it is gone.
bool SpaceMouse::Implementation::run()
{
  if (const std::unique_ptr<HidLink> link = find())
  {
    serve(*link);
    if (!thread.stopping())
    {
      thread.report(
        Status::DeviceLost, "spacemouse: it was unplugged; plug it in again, it starts by itself");
    }
  }
  return true;
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

SpaceMouse::~SpaceMouse() = default;

Status SpaceMouse::start()
{
  Implementation& self = *implementation_;
  if (!self.bus)
  {
    self.thread.report(Status::DeviceNotFound,
      "spacemouse: built without hidapi; install libhidapi-dev and configure the build again");
    return Status::DeviceNotFound;
  }
  self.thread.start(self.settings.retrySeconds, [&self] { return self.run(); });
  return Status::Ok;
}

void SpaceMouse::stop()
{
  implementation_->thread.stop();
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
  return implementation_->thread.message();
}

} // namespace pointhaptics
