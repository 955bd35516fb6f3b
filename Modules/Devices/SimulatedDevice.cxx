#include "Devices/SimulatedDevice.h"

#include <algorithm>

namespace pointhaptics
{
namespace
{
constexpr double kLongestStepSeconds = 1e-4;
/// Longest time that one call accounts for: after a longer pause the hand continues from where it was.
constexpr double kLongestPauseSeconds = 0.1;
constexpr double kDefaultHalfEdge = 0.05;
constexpr double kHoldingForce = 8.0;
/// Tolerance for the rounding of (tick / rate) against the times of a file.
constexpr double kTimeTolerance = 1e-9;
constexpr int kButtons = 4;

Vec3 clamped(const Vec3& p, const Bounds& box) noexcept
{
  Vec3 result;
  for (int axis = 0; axis < 3; ++axis)
  {
    result[axis] = std::min(std::max(p[axis], box.minimum[axis]), box.maximum[axis]);
  }
  return result;
}

bool above(double value, double minimum) noexcept
{
  return value > minimum && std::isfinite(value);
}
}

SimulatedDevice::SimulatedDevice(const SimulatedHandSettings& settings)
  : settings_(settings)
{
  if (settings_.workspace.empty())
  {
    settings_.workspace = Bounds();
    settings_.workspace.include({ -kDefaultHalfEdge, -kDefaultHalfEdge, -kDefaultHalfEdge });
    settings_.workspace.include({ kDefaultHalfEdge, kDefaultHalfEdge, kDefaultHalfEdge });
  }
}

const char* SimulatedDevice::name() const noexcept
{
  return settings_.yieldsToForce || path_.points.empty() ? "simulated" : "path";
}

void SimulatedDevice::setPath(HipPath path)
{
  path_ = std::move(path);
  for (std::size_t i = 0; !settings_.yieldsToForce && i < path_.points.size(); ++i)
  {
    settings_.workspace.include(path_.points[i].position);
  }
}

DeviceCapabilities SimulatedDevice::capabilities() const noexcept
{
  DeviceCapabilities result;
  result.workspace = settings_.workspace;
  result.maximumForce = settings_.yieldsToForce ? kHoldingForce : 0.0;
  result.numberOfButtons = kButtons;
  return result;
}

HandLimits SimulatedDevice::limits() const noexcept
{
  HandLimits result;
  if (settings_.yieldsToForce)
  {
    result.damping = settings_.gripDamping;
  }
  return result;
}

Status SimulatedDevice::open()
{
  if (!above(settings_.mass, 0.0) || !above(settings_.gripStiffness, 0.0) ||
    !(settings_.gripDamping >= 0.0 && std::isfinite(settings_.gripDamping)) || !isFinite(settings_.start) ||
    !isFinite(settings_.workspace.extent()) || !(path_.points.empty() || path_.problem().empty()))
  {
    return Status::InvalidParameter;
  }
  row_ = 0;
  const Vec3& start = path_.points.empty() ? settings_.start : path_.points.front().position;
  position_ = clamped(start, settings_.workspace);
  velocity_ = {};
  force_ = {};
  lastTarget_ = position_;
  target_.write(position_);
  seenPlacings_ = placings_.load(std::memory_order_relaxed);
  timed_ = false;
  open_ = true;
  return Status::Ok;
}

void SimulatedDevice::close()
{
  force_ = {};
  open_ = false;
}

Status SimulatedDevice::read(double timeSeconds, HandState& state) noexcept
{
  if (!open_)
  {
    return Status::DeviceNotOpen;
  }
  state.isNew = false;
  if (!path_.points.empty())
  {
    if (!settings_.holdsAtEnd && timeSeconds > path_.duration() + kTimeTolerance)
    {
      return Status::EndOfPath;
    }
    const double pathTime = path_.points.front().timeSeconds + timeSeconds;
    const HandState next = path_.hand(pathTime, row_);
    lastTarget_ = clamped(next.position, settings_.workspace);
    state.isNew = next.isNew;
  }
  else
  {
    // The counter is read before the target, which is written first.
    const std::uint32_t placings = placings_.load(std::memory_order_acquire);
    // If a write is under way, the former target serves one tick more.
    state.isNew = target_.tryRead(lastTarget_) && placings != seenPlacings_;
    seenPlacings_ = state.isNew ? placings : seenPlacings_;
  }
  const double elapsed = timed_ && !state.isNew ? timeSeconds - lastTime_ : 0.0;
  velocity_ = state.isNew ? Vec3() : velocity_;
  if (!settings_.yieldsToForce || state.isNew)
  {
    position_ = lastTarget_;
  }
  else if (elapsed > 0.0)
  {
    move(std::min(elapsed, kLongestPauseSeconds));
  }
  if (std::isfinite(timeSeconds))
  {
    lastTime_ = timeSeconds;
    timed_ = true;
  }
  state.position = position_;
  state.buttons = buttons_.load(std::memory_order_relaxed);
  return Status::Ok;
}

void SimulatedDevice::move(double seconds) noexcept
{
  const int steps = int(std::ceil(seconds / kLongestStepSeconds));
  const double h = seconds / steps;
  const double k = settings_.gripStiffness / settings_.mass;
  const double c = settings_.gripDamping / settings_.mass;
  const double inverse = 1.0 / (1.0 + h * (c + h * k));
  for (int step = 0; step < steps; ++step)
  {
    const Vec3 pull = k * (lastTarget_ - position_) + (1.0 / settings_.mass) * force_;
    velocity_ = inverse * (velocity_ + h * pull);
    const Vec3 free = position_ + h * velocity_;
    position_ = clamped(free, settings_.workspace);
    for (int axis = 0; axis < 3; ++axis)
    {
      velocity_[axis] = position_[axis] == free[axis] ? velocity_[axis] : 0.0;
    }
  }
}

Status SimulatedDevice::write(double, const Vec3& force) noexcept
{
  if (!open_)
  {
    return Status::DeviceNotOpen;
  }
  force_ = isFinite(force) ? force : Vec3();
  return isFinite(force) ? Status::Ok : Status::InvalidParameter;
}

void SimulatedDevice::setTarget(const Vec3& target) noexcept
{
  if (isFinite(target))
  {
    target_.write(clamped(target, settings_.workspace));
  }
}

void SimulatedDevice::placeAt(const Vec3& target) noexcept
{
  if (isFinite(target))
  {
    this->setTarget(target);
    placings_.fetch_add(1, std::memory_order_release);
  }
}

} // namespace pointhaptics
