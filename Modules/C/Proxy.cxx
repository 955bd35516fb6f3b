#include "C/Handles.h"

#include "VirtualTouch.h"

#include "Haptics/Proxy.h"
#include "Haptics/Servo/ForceGuard.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>

using namespace pointhaptics;
using namespace pointhaptics::c;

static_assert(kFeltColumns.size() == PH_COLUMNS, "the columns are those of OUT.csv");

/// A servo step, see VirtualTouch, whose period may change from step to step.
struct ph_proxy
{
  explicit ph_proxy(const HapticParameters& parameters)
    : proxy(parameters)
  {
    limit();
  }

  void limit() { guard.setMaximumForce(proxy.parameters().contact.forceLimit); }

  /// Seconds from the first step to this one: as many times @p dt as there were steps with it, so that a
  /// constant period adds no rounding errors up.
  void advance(double dt)
  {
    if (steps == 0 || dt != period)
    {
      begin = time;
      stepsOfPeriod = 0;
      period = dt;
    }
    stepsOfPeriod += steps > 0;
    time = begin + double(stepsOfPeriod) / (1.0 / dt);
    ++steps;
  }

  void step(const Vec3& hip, double dt)
  {
    const HapticScene* next = scenes ? scenes->at(hip, state.contact ? state.proxy : hip) : nullptr;
    if (next != scene)
    {
      proxy.setScene(scene = next);
    }
    const auto before = std::chrono::steady_clock::now();
    state = proxy.step(hip, dt);
    state.force = guard.limit(state.force, dt);
    microseconds =
      std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - before).count();
    advance(dt);
  }

  std::optional<FeelScenes> scenes;
  Proxy proxy;
  ForceGuard guard{ ForceLimits{ INFINITY, INFINITY } };
  const HapticScene* scene = nullptr;
  ProxyState state;
  double microseconds = 0.0;
  double time = 0.0;
  double begin = 0.0;
  double period = 0.0;
  std::int64_t steps = 0;
  std::int64_t stepsOfPeriod = 0;
};

namespace
{

int stepOf(ph_proxy* proxy, const double hip[3], double dt)
{
  if (hasNull({ proxy, hip }))
  {
    return PH_INVALID_PARAMETER;
  }
  if (!(dt > 0.0) || !std::isfinite(dt))
  {
    char text[80];
    std::snprintf(text, sizeof text, "dt: %g s; give a finite number above 0", dt);
    return fail(PH_INVALID_PARAMETER, text);
  }
  // Without the interpreter's lock being given up: a step is shorter than that.
  try
  {
    proxy->step({ hip[0], hip[1], hip[2] }, dt);
    return PH_OK;
  }
  catch (const std::exception& error)
  {
    return isOutOfMemory(error) ? fail(Status::OutOfMemory) : fail(PH_INVALID_PARAMETER, error.what());
  }
}

void copy(const Vec3& from, double to[3])
{
  to[0] = from.x;
  to[1] = from.y;
  to[2] = from.z;
}

} // namespace

int ph_proxy_create(const ph_proxy_options* options, ph_proxy** out)
{
  return guardedWith({ out }, options,
    [&](const HapticParameters& parameters)
    {
      *out = new ph_proxy(parameters);
      return int(PH_OK);
    });
}

int ph_proxy_set_scene(ph_proxy* proxy, const ph_scene* scene)
{
  return guarded({ proxy },
    [&]
    {
      // Null first: the proxy lets go of the scene before that is freed.
      proxy->proxy.setScene(proxy->scene = nullptr);
      proxy->scenes.reset();
      if (scene)
      {
        proxy->scenes.emplace(*scene->scenes);
      }
      return PH_OK;
    });
}

int ph_proxy_set_options(ph_proxy* proxy, const ph_proxy_options* options)
{
  return guardedWith({ proxy }, options,
    [&](const HapticParameters& parameters)
    {
      proxy->proxy.setParameters(parameters);
      proxy->limit();
      return int(PH_OK);
    });
}

int ph_proxy_step(ph_proxy* proxy, const double hip[3], double dt, ph_state* out)
{
  const int status = hasNull({ out }) ? int(PH_INVALID_PARAMETER) : stepOf(proxy, hip, dt);
  if (status == PH_OK)
  {
    const ProxyState& felt = proxy->state;
    ph_state state{};
    state.struct_size = out->struct_size;
    copy(felt.proxy, state.proxy);
    copy(felt.normal, state.normal);
    copy(felt.force, state.force);
    state.radius = felt.radius;
    state.contact = felt.contact;
    state.status = felt.status;
    std::memcpy(out, &state, std::min(state.struct_size, sizeof state));
  }
  return status;
}

int ph_proxy_step_row(ph_proxy* proxy, const double hip[3], double dt, double row[PH_COLUMNS])
{
  const int status = hasNull({ row }) ? int(PH_INVALID_PARAMETER) : stepOf(proxy, hip, dt);
  if (status == PH_OK)
  {
    const auto numbers = feltRow(proxy->time, proxy->state, proxy->microseconds);
    std::copy(numbers.begin(), numbers.end(), row);
  }
  return status;
}

void ph_proxy_destroy(ph_proxy* proxy)
{
  delete proxy;
}
