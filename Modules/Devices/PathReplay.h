/// @file
/// Devices made of paths: one replays a HIP path, one records another device's motion.
#pragma once

#include "Devices/HapticDevice.h"
#include "Devices/HipPath.h"

#include <cstdint>

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

/// Passes everything through to another device and keeps the positions read, up to a capacity fixed at
/// construction (the servo thread does not allocate). Later ones, those that are not finite and those whose
/// time does not ascend (a servo loop started again begins at 0) are counted and lost, so that what is
/// recorded is always a valid path.
class RecordingDevice : public HapticDevice
{
public:
  /// @p device must outlive this one.
  RecordingDevice(HapticDevice& device, std::size_t capacity);

  const char* name() const noexcept override { return device_.name(); }
  DeviceCapabilities capabilities() const noexcept override { return device_.capabilities(); }
  HandLimits limits() const noexcept override { return device_.limits(); }
  std::string message() const override { return device_.message(); }
  Status open() override { return device_.open(); }
  void close() override { device_.close(); }
  Status read(double timeSeconds, HandState& state) noexcept override;
  Status write(double timeSeconds, const Vec3& force) noexcept override;

  /// The recorded path. Call it only while the servo loop is stopped.
  const HipPath& recorded() const noexcept { return path_; }
  std::uint64_t lostSamples() const noexcept { return lost_; }

private:
  HapticDevice& device_;
  HipPath path_;
  std::uint64_t lost_ = 0;
};

} // namespace pointhaptics
