#include "VirtualTouch.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace pointhaptics
{

std::array<double, kFeltColumns.size()> feltRow(
  double timeSeconds, const ProxyState& state, double microseconds)
{
  return { timeSeconds, state.hip.x, state.hip.y, state.hip.z, state.proxy.x, state.proxy.y, state.proxy.z,
    state.normal.x, state.normal.y, state.normal.z, state.force.x, state.force.y, state.force.z, state.radius,
    state.contact ? 1.0 : 0.0, microseconds };
}

ServoStepSettings VirtualTouch::settings(double rateHz)
{
  ServoStepSettings settings;
  settings.rateHz = rateHz;
  settings.limits.maximumForce = INFINITY;
  settings.limits.maximumSlewRate = INFINITY;
  return settings;
}

VirtualTouch::VirtualTouch(const HapticParameters& parameters, FeelScenes& scenes, double rateHz)
  : scenes_(scenes)
  , step_(settings(rateHz), parameters)
{
  sample_.parameters = 1;
}

const ServoSample& VirtualTouch::step(const HandState& hand)
{
  const HapticScene* scene =
    scenes_.at(hand.position, sample_.state.contact && !hand.isNew ? sample_.state.proxy : hand.position);
  if (scene != scene_)
  {
    scene_ = scene;
    sample_.scene = scene ? scene->number() : 0;
    ++sample_.scenes;
    step_.setScene(scene);
  }
  TickInput input;
  input.number = sample_.tick + 1;
  input.hand = hand;
  const auto before = std::chrono::steady_clock::now();
  step_.step(input, sample_);
  step_.finish(input, Status::Ok, sample_);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - before;
  sample_.updateSeconds = took.count();
  return sample_;
}

bool countTicks(const HipPath& path, const std::string& fileName, double rateHz, double most,
  std::int64_t& ticks, std::string& message, const UnitNames& units)
{
  // The last point counts even if rounding puts it just before its tick.
  const double count = std::floor(path.duration() * rateHz + 1e-6) + 1.0;
  if (!(count <= most))
  {
    message =
      fmt::format("{}: {} s at {} Hz are more than {} ticks; check that t is in seconds, or cut the path",
        fileName, path.duration(), rateHz, most);
    const std::string odd = unlikelyUnits(path, Bounds(), units);
    message += odd.empty() ? "" : "; " + odd;
    return false;
  }
  ticks = static_cast<std::int64_t>(count);
  return true;
}

void feelPath(const HapticParameters& parameters, FeelScenes& scenes, const HipPath& path, double rateHz,
  std::int64_t ticks, const OnTick& onTick)
{
  VirtualTouch touch(parameters, scenes, rateHz);
  const double start = path.points.front().timeSeconds;
  const double end = path.points.back().timeSeconds;
  std::size_t row = 0;
  for (std::int64_t tick = 0; tick < ticks; ++tick)
  {
    const double time = std::min(start + double(tick) / rateHz, end);
    touch.step(path.hand(time, row));
    if (!onTick(time, touch))
    {
      return;
    }
  }
}

} // namespace pointhaptics
