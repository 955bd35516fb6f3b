#include "Devices/Falcon/FalconDevice.h"

#include "Devices/DriverThread.h"
#include "Devices/Falcon/FalconFirmware.h"
#include "Devices/Falcon/FalconProtocol.h"

#include <chrono>
#include <thread>

namespace pointhaptics
{
namespace
{
constexpr double kHalfWorkspace = 0.05;
constexpr double kRateHz = 1000.0;
constexpr int kButtons = 4;
// Least damping (N s/m) and friction (N) of the drive and the hand in it. Assumed, to be confirmed on
// hardware: at 1 kHz they allow 1667 N/m, in the middle of what other programs use (800 to 3000).
constexpr double kLeastDamping = 2.5;
constexpr double kLeastFriction = 0.1;
/// Within the 4 cm ball about the centre a count moves the grip by at most this (FalconKinematicsTest).
constexpr double kLargestCountStep = 60e-6;
/// Age of a position in ticks: it is that of the last answer, and the command goes out at the end of the
/// tick.
constexpr double kDelayTicks = 1.0;
constexpr double kRampDownSeconds = 0.06;
constexpr auto kBetweenQuestions = std::chrono::milliseconds(5);
}

struct FalconDevice::Implementation
{
  enum Owner : int
  {
    kSupervisor,
    kServo,
  };

  explicit Implementation(const FalconSettings& s)
    : settings(s)
    , protocol(s)
  {
  }

  const FalconSettings settings;
  FtdiBus bus;
  std::unique_ptr<FtdiLink> link; ///< Belongs to the owner.
  FalconProtocol protocol;        ///< Belongs to the owner.
  std::atomic<int> owner{ kSupervisor };
  std::atomic<int> state{ int(FalconState::Closed) }; ///< State while the supervisor owns the link.
  std::atomic<bool> armed{ true };
  std::atomic<int> leds{ -1 };
  bool everRan = false;    ///< The device has run since open(). The supervisor's.
  DriverThread supervisor; ///< Its status is that of the last start; the servo thread asks nothing of it.

  void transition(FalconEvent event) { state = int(next(FalconState(state.load()), event)); }
  bool supervise();
  Status start(std::string& text);
  /// Works on the connection if it is the servo thread's, and gives it up where it is lost. Servo thread.
  template <typename Work>
  Status serve(Work&& work) noexcept
  {
    if (owner.load(std::memory_order_acquire) != kServo)
    {
      return FalconState(state.load(std::memory_order_relaxed)) == FalconState::Closed
        ? Status::DeviceNotOpen
        : Status::DeviceNotReady;
    }
    const Status status = work();
    if (status == Status::DeviceLost)
    {
      state.store(int(FalconState::Fault), std::memory_order_relaxed);
      owner.store(kSupervisor, std::memory_order_release);
    }
    return status;
  }
};

/// Finds and starts the device. Ok: the link is ready for the servo thread.
Status FalconDevice::Implementation::start(std::string& text)
{
  Status status = Status::Ok;
  link = bus(status, text);
  if (!link)
  {
    return status;
  }
  transition(FalconEvent::Connected);
  FalconFirmware firmware;
  const Status read = readFalconFirmware(falconFirmwareFile(settings.firmwareFile), firmware, text);
  if (read != Status::Ok && !settings.firmwareFile.empty())
  {
    return read;
  }
  status = bootFalcon(*link, settings.boot, firmware.bytes, supervisor.stopping(),
    [this] { transition(FalconEvent::BootDone); });
  if (status != Status::FirmwareMissing)
  {
    text = status == Status::Ok ? firmware.note : std::string("falcon: ") + pointhaptics::message(status);
  }
  return status;
}

/// Starts a device that is not in use. False: the first start failed, and is not tried again.
bool FalconDevice::Implementation::supervise()
{
  if (owner.load(std::memory_order_acquire) != kSupervisor)
  {
    return true;
  }
  link.reset();
  transition(FalconState(state.load()) == FalconState::Closed ? FalconEvent::Open : FalconEvent::Retry);
  std::string text;
  const Status status = start(text);
  if (status == Status::Ok)
  {
    transition(FalconEvent::Running);
    protocol.begin();
    owner.store(kServo, std::memory_order_release);
  }
  else
  {
    link.reset();
    transition(FalconEvent::Failed);
  }
  everRan = everRan || status == Status::Ok;
  supervisor.report(status, text);
  return everRan;
}

FalconDevice::FalconDevice(const FalconSettings& settings)
  : FalconDevice(settings, makeUsbFtdiBus())
{
}

FalconDevice::FalconDevice(const FalconSettings& settings, FtdiBus bus)
  : implementation_(std::make_unique<Implementation>(settings))
{
  implementation_->bus = std::move(bus);
}

FalconDevice::~FalconDevice()
{
  close();
}

HandLimits FalconDevice::limits() const noexcept
{
  HandLimits result;
  result.damping = kLeastDamping;
  result.friction = kLeastFriction;
  result.positionStep = kLargestCountStep;
  result.delayTicks = kDelayTicks;
  result.maximumRateHz = kRateHz;
  result.rampDownSeconds = kRampDownSeconds;
  result.rampUpSeconds = implementation_->settings.limits.rampSeconds;
  return result;
}

DeviceCapabilities FalconDevice::capabilities() const noexcept
{
  DeviceCapabilities result;
  result.workspace.include({ -kHalfWorkspace, -kHalfWorkspace, -kHalfWorkspace });
  result.workspace.include({ kHalfWorkspace, kHalfWorkspace, kHalfWorkspace });
  result.maximumForce = implementation_->settings.limits.maximumForce;
  result.maximumRateHz = kRateHz;
  result.numberOfButtons = kButtons;
  result.pushes = true;
  return result;
}

Status FalconDevice::open()
{
  close();
  Implementation& self = *implementation_;
  if (self.settings.limits.check() != Status::Ok || !(self.settings.retrySeconds >= 0.0))
  {
    self.supervisor.report(Status::InvalidParameter,
      "falcon: a limit is out of its range: at most 8 N and 0.4096 N m, and a ramp of 1 s or more");
    return Status::InvalidParameter;
  }
  if (!self.bus)
  {
    self.supervisor.report(Status::DeviceNotFound,
      "falcon: built without libusb; install libusb-1.0-0-dev and configure the build again");
    return Status::DeviceNotFound;
  }
  self.everRan = false;
  self.protocol.clearStatistics();
  self.supervisor.report(Status::DeviceNotReady, {});
  self.supervisor.start(self.settings.retrySeconds, [&self] { return self.supervise(); });
  Status status = Status::DeviceNotReady;
  std::string text;
  while (status == Status::DeviceNotReady)
  {
    std::this_thread::sleep_for(kBetweenQuestions);
    const bool isCancelled = self.settings.cancelled && self.settings.cancelled();
    status = isCancelled ? Status::Aborted : self.supervisor.status();
    text = isCancelled ? "falcon: not started: ended on request" : message();
  }
  if (status != Status::Ok)
  {
    close();
    self.supervisor.report(status, text);
  }
  return status;
}

void FalconDevice::close()
{
  Implementation& self = *implementation_;
  self.supervisor.stop();
  if (self.link && self.owner.load(std::memory_order_acquire) == Implementation::kServo)
  {
    self.protocol.shutdown(*self.link);
  }
  self.link.reset();
  self.owner = Implementation::kSupervisor;
  self.transition(FalconEvent::Close);
}

Status FalconDevice::read(double timeSeconds, HandState& state) noexcept
{
  Implementation& self = *implementation_;
  return self.serve(
    [&] {
      return self.protocol.read(*self.link, timeSeconds, self.armed.load(std::memory_order_relaxed), state);
    });
}

Status FalconDevice::write(double timeSeconds, const Vec3& force) noexcept
{
  Implementation& self = *implementation_;
  return self.serve(
    [&] {
      return self.protocol.write(*self.link, timeSeconds, force, self.leds.load(std::memory_order_relaxed));
    });
}

std::string FalconDevice::message() const
{
  return implementation_->supervisor.message();
}

void FalconDevice::setArmed(bool armed) noexcept
{
  implementation_->armed.store(armed, std::memory_order_relaxed);
}

FalconState FalconDevice::state() const noexcept
{
  const Implementation& self = *implementation_;
  return self.owner.load(std::memory_order_acquire) == Implementation::kServo
    ? self.protocol.state()
    : FalconState(self.state.load(std::memory_order_relaxed));
}

FalconStatistics FalconDevice::statistics() const noexcept
{
  return implementation_->protocol.statistics();
}

FalconRaw FalconDevice::raw() const noexcept
{
  return implementation_->protocol.raw();
}

void FalconDevice::showLeds(int leds) noexcept
{
  implementation_->leds.store(leds, std::memory_order_relaxed);
}

} // namespace pointhaptics
