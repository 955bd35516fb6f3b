/// @file
/// A SpaceMouse that moves the model: found, read, and found again after it was unplugged.
#pragma once

#include "Devices/SpaceMouse/HidBus.h"
#include "Devices/SpaceMouse/SpaceMouseReport.h"

#include "Core/Base/Lifetime.h"
#include "Core/Base/Status.h"

#include <memory>
#include <string>

namespace pointhaptics
{

/// A thread of its own waits for reports, 20 ms at a time, and looks for the device while there is none, so
/// that it may be plugged in at any time. Its LED is on while it is in use.
/// Thread safety: start() and stop() from one thread; motion() and message() from any, without
/// waiting for the device.
class SpaceMouse
{
public:
  /// Uses the hidapi of this machine.
  explicit SpaceMouse(const SpaceMouseSettings& settings = {});
  /// Uses another bus, for tests.
  SpaceMouse(const SpaceMouseSettings& settings, std::unique_ptr<HidBus> bus);
  ~SpaceMouse(); ///< Stops.
  SpaceMouse(const SpaceMouse&) = delete;
  SpaceMouse& operator=(const SpaceMouse&) = delete;

  /// DeviceNotFound where the package was built without hidapi. Ok does not mean that one is plugged in.
  Status start();
  /// LED off, closes; 0.1 s at most.
  void stop();

  /// The puck's present motion; at rest where no report came for staleSeconds or none is plugged in.
  SpaceMouseMotion motion() const noexcept;
  /// Name of the device in use, or a message to the user: one sentence with its cure.
  std::string message() const;
  /// Text of message() while none is plugged in.
  static constexpr const char* kNonePluggedIn = "spacemouse: none is plugged in";
  /// Lifetime for those who point to it without owning it.
  const Lifetime& lifetime() const noexcept { return lifetime_; }

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
  Lifetime lifetime_;
};

} // namespace pointhaptics
