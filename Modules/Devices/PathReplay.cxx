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

RecordingDevice::RecordingDevice(HapticDevice& device, std::size_t capacity)
  : device_(device)
{
  path_.points.reserve(capacity);
}

Status RecordingDevice::read(double timeSeconds, HandState& state) noexcept
{
  const Status status = device_.read(timeSeconds, state);
  if (status != Status::Ok)
  {
    return status;
  }
  std::vector<HipPathPoint>& points = path_.points;
  const bool later = points.empty() || timeSeconds > points.back().timeSeconds;
  if (points.size() < points.capacity() && later && std::isfinite(timeSeconds) && isFinite(state.position))
  {
    points.push_back({ timeSeconds, state.position, state.isNew });
  }
  else
  {
    ++lost_;
  }
  return status;
}

Status RecordingDevice::write(double timeSeconds, const Vec3& force) noexcept
{
  return device_.write(timeSeconds, force);
}

} // namespace pointhaptics
