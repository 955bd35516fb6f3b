#include "Devices/PathReplay.h"

namespace pointhaptics
{
namespace
{
/// Tolerance for the rounding of (tick / rate) against the times of a file.
constexpr double kTimeTolerance = 1e-9;
}

PathReplayDevice::PathReplayDevice(HipPath path, bool holdAtEnd)
  : path_(std::move(path))
  , holdAtEnd_(holdAtEnd)
{
}

DeviceCapabilities PathReplayDevice::capabilities() const noexcept
{
  DeviceCapabilities result;
  for (const HipPathPoint& point : path_.points)
  {
    result.workspace.include(point.position);
  }
  return result;
}

Status PathReplayDevice::open()
{
  hint_ = 0;
  open_ = false;
  if (path_.points.empty())
  {
    return Status::Empty;
  }
  const Status status = path_.check();
  open_ = status == Status::Ok;
  return status;
}

Status PathReplayDevice::read(double timeSeconds, HandState& state) noexcept
{
  if (!open_)
  {
    return Status::DeviceNotOpen;
  }
  if (!holdAtEnd_ && timeSeconds > path_.duration() + kTimeTolerance)
  {
    return Status::EndOfPath;
  }
  state = path_.hand(path_.points.front().timeSeconds + timeSeconds, hint_);
  return Status::Ok;
}

Status PathReplayDevice::write(double, const Vec3&) noexcept
{
  return open_ ? Status::Ok : Status::DeviceNotOpen;
}

} // namespace pointhaptics
