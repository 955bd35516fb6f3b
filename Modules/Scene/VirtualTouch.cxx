#include "VirtualTouch.h"

#include <algorithm>
#include <chrono>

namespace pointhaptics
{

std::array<double, kFeltColumns.size()> feltRow(
  double timeSeconds, const ProxyState& state, double microseconds)
{
  return { timeSeconds, state.hip.x, state.hip.y, state.hip.z, state.proxy.x, state.proxy.y, state.proxy.z,
    state.normal.x, state.normal.y, state.normal.z, state.force.x, state.force.y, state.force.z, state.radius,
    state.contact ? 1.0 : 0.0, microseconds };
}

VirtualTouch::VirtualTouch(const HapticParameters& parameters, FeelScenes& scenes, double rateHz)
  : proxy_(parameters)
  , scenes_(scenes)
  , period_(1.0 / rateHz)
{
}

const ProxyState& VirtualTouch::step(const Vec3& hip, double& microseconds)
{
  const HapticScene* scene = scenes_.at(hip, state_.contact ? state_.proxy : hip);
  if (scene != scene_)
  {
    proxy_.setScene(scene_ = scene);
  }
  const auto before = std::chrono::steady_clock::now();
  state_ = proxy_.step(hip, period_);
  const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - before;
  microseconds = took.count();
  return state_;
}

void feelPath(const HapticParameters& parameters, FeelScenes& scenes, const HipPath& path, double rateHz,
  std::int64_t ticks, const OnTick& onTick)
{
  VirtualTouch touch(parameters, scenes, rateHz);
  const double start = path.points.front().timeSeconds;
  const double end = path.points.back().timeSeconds;
  std::size_t hint = 0;
  for (std::int64_t tick = 0; tick < ticks; ++tick)
  {
    const double time = std::min(start + double(tick) / rateHz, end);
    double microseconds = 0.0;
    const ProxyState& state = touch.step(path.position(time, hint), microseconds);
    if (!onTick(time, state, microseconds))
    {
      return;
    }
  }
}

} // namespace pointhaptics
