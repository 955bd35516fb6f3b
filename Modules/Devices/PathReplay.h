/// @file
/// A device that replays a HIP path.
#pragma once

#include "Devices/HapticDevice.h"
#include "Devices/HipPath.h"

namespace pointhaptics
{

/// Moves the hand along the path in servo time, whatever the force: time 0 is the path's first point,
/// whatever its own time. After its end it holds the last position, or answers EndOfPath.
class PathReplayDevice : public HapticDevice
{
public:
  /// @param holdAtEnd false: read() returns EndOfPath past the last point, which itself is still given.
  explicit PathReplayDevice(HipPath path, bool holdAtEnd = false);

  const char* name() const noexcept override { return "path"; }
  DeviceCapabilities capabilities() const noexcept override;
  /// Goes back to the start. Empty: the path has no point; InvalidParameter: it is no path
  /// (HipPath::check()).
  Status open() override;
  void close() override { open_ = false; }
  Status read(double timeSeconds, HandState& state) noexcept override;
  Status write(double timeSeconds, const Vec3& force) noexcept override;
  const HipPath& path() const noexcept { return path_; }

private:
  HipPath path_;
  std::size_t hint_ = 0;
  bool holdAtEnd_ = false;
  bool open_ = false;
};

} // namespace pointhaptics
