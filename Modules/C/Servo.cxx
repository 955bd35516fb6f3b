#include "C/Handles.h"

#include "VirtualTouch.h"

#include "Core/Base/StoppableThread.h"
#include "Devices/SimulatedDevice.h"
#include "Haptics/ServoLoop.h"

#include <algorithm>
#include <vector>

using namespace pointhaptics;
using namespace pointhaptics::c;

namespace
{

/// The simulated hand, with the caller between it and the loop.
class HandWithCallback : public SimulatedDevice
{
public:
  HandWithCallback(const SimulatedHandSettings& settings, ph_servo_tick onTick, void* user)
    : SimulatedDevice(settings)
    , onTick_(onTick)
    , user_(user)
  {
  }

  bool mayIdle() const noexcept override { return !onTick_ && SimulatedDevice::mayIdle(); }

  Status read(double timeSeconds, HandState& state) noexcept override
  {
    const Status status = isEnded_ ? Status::EndOfPath : SimulatedDevice::read(timeSeconds, state);
    position_ = state.position;
    return status;
  }

  Status write(double timeSeconds, const Vec3& force) noexcept override
  {
    double felt[3] = { force.x, force.y, force.z };
    const double hand[3] = { position_.x, position_.y, position_.z };
    if (onTick_ && !isEnded_ && onTick_(user_, timeSeconds, hand, felt) != 0)
    {
      isEnded_ = true;
    }
    return SimulatedDevice::write(timeSeconds, isEnded_ ? Vec3() : Vec3(felt[0], felt[1], felt[2]));
  }

private:
  ph_servo_tick onTick_;
  void* user_;
  Vec3 position_;
  bool isEnded_ = false;
};

SimulatedHandSettings handOf(const ph_servo_options& options, const HipPath& path)
{
  SimulatedHandSettings settings;
  const auto take = [](double given, double& value) { value = given != 0.0 ? given : value; };
  take(options.mass, settings.mass);
  take(options.grip_stiffness, settings.gripStiffness);
  take(options.grip_damping, settings.gripDamping);
  settings.start = { options.start[0], options.start[1], options.start[2] };
  const double* w = options.workspace;
  if (std::any_of(w, w + 6, [](double number) { return number != 0.0; }))
  {
    settings.workspace.include({ w[0], w[2], w[4] });
    settings.workspace.include({ w[1], w[3], w[5] });
    return settings;
  }
  constexpr double kHalf = 0.05;
  settings.workspace.include(settings.start - Vec3(kHalf, kHalf, kHalf));
  settings.workspace.include(settings.start + Vec3(kHalf, kHalf, kHalf));
  for (const HipPathPoint& point : path.points)
  {
    settings.workspace.include(point.position);
  }
  return settings;
}

} // namespace

struct ph_servo
{
  ph_servo(const FeelScenes& shared, const ph_servo_options& options, const HipPath& path)
    : scenes(shared)
    , hand(handOf(options, path), options.on_tick, options.user)
  {
    hand.setPath(path);
  }
  ~ph_servo() { stop(); }

  void stop()
  {
    sceneThread.stop();
    loop.stop();
    hand.close();
  }

  FeelScenes scenes;
  HandWithCallback hand;
  ServoLoop loop; ///< After the hand: stops before that is gone.
  std::vector<ServoSample> samples;
  std::size_t taken = 0; ///< Number of samples that were taken.
  StoppableThread sceneThread;
};

int ph_servo_start(
  const ph_scene* scene, const ph_proxy_options* proxy, const ph_servo_options* given, ph_servo** out)
{
  return guardedWith({ scene, out }, proxy,
    [&](const HapticParameters& parameters)
    {
      const ph_servo_options options = optionsOf(given);
      HipPath path;
      if (options.path_count > 0 && !readPath(options.path, options.path_count, path))
      {
        return int(PH_INVALID_PARAMETER);
      }
      auto servo = std::make_unique<ph_servo>(*scene->scenes, options, path);
      if (const Status status = servo->hand.open(); status != Status::Ok)
      {
        return fail(status);
      }
      ServoSettings settings;
      settings.rateHz = options.rate != 0.0 ? options.rate : settings.rateHz;
      settings.traceCapacity = options.trace != 0 ? options.trace : settings.traceCapacity;
      servo->loop.publishScene(servo->scenes.whole());
      std::string problem;
      if (const Status status = servo->loop.start(servo->hand, parameters, settings, &problem);
          status != Status::Ok)
      {
        return fail(status, problem);
      }
      servo->scenes.publishNearHand(servo->loop, servo->sceneThread);
      *out = servo.release();
      return int(PH_OK);
    });
}

int ph_servo_target(ph_servo* servo, const double target[3])
{
  if (hasNull({ servo, target }))
  {
    return PH_INVALID_PARAMETER;
  }
  servo->hand.setTarget({ target[0], target[1], target[2] });
  return PH_OK;
}

int ph_servo_set_options(ph_servo* servo, const ph_proxy_options* options)
{
  return guardedWith({ servo }, options,
    [&](const HapticParameters& parameters)
    {
      std::string problem;
      const Status status = servo->loop.setParameters(parameters, &problem);
      return fail(status, problem);
    });
}

int ph_servo_running(const ph_servo* servo)
{
  return servo && servo->loop.running();
}

int ph_servo_trace(ph_servo* servo, double* rows, size_t most, size_t* count)
{
  return guarded({ servo, count, most > 0 ? rows : static_cast<const void*>(count) },
    [&]
    {
      if (servo->taken == servo->samples.size())
      {
        servo->samples.clear();
        servo->taken = 0;
        servo->loop.takeTrace(servo->samples);
      }
      *count = std::min(most, servo->samples.size() - servo->taken);
      for (std::size_t i = 0; i < *count; ++i)
      {
        const ServoSample& sample = servo->samples[servo->taken++];
        const auto row = feltRow(sample.timeSeconds, sample);
        std::copy(row.begin(), row.end(), rows + PH_COLUMNS * i);
      }
      return PH_OK;
    });
}

int ph_servo_statistics_of(const ph_servo* servo, ph_servo_statistics* out)
{
  return guarded({ servo, out },
    [&]
    {
      const ServoStatistics s = servo->loop.statistics();
      const ph_servo_statistics all = { out->struct_size, s.rateHz, s.jitter.p50, s.jitter.p99,
        s.jitter.maximum, s.update.p50, s.update.p99, s.update.maximum, s.ticks, s.deadlineMisses,
        s.lostTraceSamples, s.realtime };
      std::memcpy(out, &all, std::min(out->struct_size, sizeof all));
      return PH_OK;
    });
}

void ph_servo_stop(ph_servo* servo)
{
  static_cast<void>(guarded(
    [&]
    {
      if (servo)
      {
        servo->stop();
      }
      return PH_OK;
    }));
}

void ph_servo_destroy(ph_servo* servo)
{
  static_cast<void>(guarded(
    [&]
    {
      delete servo;
      return PH_OK;
    }));
}
