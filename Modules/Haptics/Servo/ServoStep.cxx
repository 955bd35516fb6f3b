#include "Haptics/Servo/ServoStep.h"

#include <algorithm>

namespace pointhaptics
{
namespace
{
/// A device whose reads failed for longer than this may have moved anywhere: its hand is taken as new.
constexpr double kNewHandAfterSeconds = 0.1;
/// A machine that stood still for less leaves the hand where it was: on its side of the surface.
constexpr double kNewHandAfterStallSeconds = 1.0;
}

ServoStep::ServoStep(const ServoStepSettings& settings, const HapticParameters& parameters)
  : settings_(settings)
  , proxy_(parameters)
  , guard_(settings.limits)
  , gate_(settings.rampDownSeconds, settings.rampUpSeconds)
  , clutch_(settings.clutchDownSeconds, settings.clutchUpSeconds)
{
  this->limitGuard();
}

void ServoStep::setParameters(const HapticParameters& parameters) noexcept
{
  proxy_.setParameters(parameters);
  this->limitGuard();
}

void ServoStep::limitGuard() noexcept
{
  guard_.setMaximumForce(std::min(settings_.limits.maximumForce, proxy_.parameters().contact.forceLimit));
}

void ServoStep::restart(std::uint64_t number) noexcept
{
  proxy_.restart();
  proxy_.setScene(scene_);
  guard_.reset();
  gate_ = ForceGate(settings_.rampDownSeconds, settings_.rampUpSeconds);
  clutch_ = ForceGate(settings_.clutchDownSeconds, settings_.clutchUpSeconds);
  lastSteppedTick_ = number > 0 ? number - 1 : 0;
  firstFailedTick_ = 0;
  touches_ = false;
  pending_ = kTickBegins;
}

bool ServoStep::isAtRest() const noexcept
{
  return !touches_ && firstFailedTick_ == 0 && gate_.fraction() == 1.0 && clutch_.fraction() == 1.0;
}

/// Steps the proxy; fills the sample's state. @return the proxy's force.
Vec3 ServoStep::answer(const TickInput& input, ServoSample& sample) noexcept
{
  const double elapsed = double(input.number - lastSteppedTick_) / settings_.rateHz;
  const double failed =
    firstFailedTick_ != 0 ? double(input.number - firstFailedTick_) / settings_.rateHz : 0.0;
  const bool stoodStill = input.number - lastSteppedTick_ > 1 && elapsed > kNewHandAfterStallSeconds;
  const bool wasLost = lastSteppedTick_ != 0 && (stoodStill || failed > kNewHandAfterSeconds);
  const bool isNew = input.hand.isNew || wasLost;
  sample.tickFlags |= isNew ? std::uint32_t(kTickNewHand) : 0u;
  if (lastSteppedTick_ != 0 && isNew)
  {
    proxy_.reset();
  }
  firstFailedTick_ = 0;
  lastSteppedTick_ = input.number;
  sample.state = proxy_.step(input.hand.position, elapsed);
  return sample.state.force;
}

void ServoStep::step(const TickInput& input, ServoSample& sample) noexcept
{
  sample.tick = input.number;
  sample.timeSeconds = double(input.number - 1) / settings_.rateHz;
  const double dt = 1.0 / settings_.rateHz;
  const double opening = gate_.step(input.gateIsOpen, dt) * clutch_.step(!input.holdsModel, dt);
  const bool isRead = input.reading == Status::Ok;
  firstFailedTick_ = isRead || firstFailedTick_ != 0 ? firstFailedTick_ : input.number;
  sample.tickFlags = pending_ | (input.holdsModel ? kTickClutched : 0u) |
    (input.gateIsOpen ? 0u : kTickGateClosed) | (isRead ? kTickStepped : 0u);
  pending_ = 0;
  if (isRead)
  {
    sample.tickFlags |= isFinite(input.hand.position) ? 0u : std::uint32_t(kTickNonFinite);
    sample.buttons = input.hand.buttons;
    // One period even after deadline misses: a force that the hand did not feel grow must not arrive all at
    // once.
    sample.state.force = guard_.limit(opening * answer(input, sample), dt);
  }
}

void ServoStep::finish(const TickInput& input, Status writing, ServoSample& sample) noexcept
{
  sample.device = input.reading == Status::Ok ? writing : input.reading;
  if (sample.device != Status::Ok)
  {
    sample.state.force = {};
    guard_.reset();
  }
  touches_ = sample.state.contact || sample.state.force != Vec3();
}

} // namespace pointhaptics
