#include "CountedCalls.h"

#include "../Unit/Devices/FalconWire.h"

#include "Devices/Falcon/FalconDevice.h"
#include "Devices/SimulatedDevice.h"
#include "Haptics/Proxy.h"
#include "Haptics/ServoLoop.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <mutex>
#include <thread>

using namespace pointhaptics;

namespace
{
constexpr double kRadius = 0.025;
constexpr double kTick = 1e-3;

/// A sphere of @p count points on a Fibonacci spiral, turned and enlarged by @p scale.
std::shared_ptr<const HapticScene> sphere(int count, double scale)
{
  HapticSceneInput input;
  const double golden = 3.14159265358979323846 * (3.0 - std::sqrt(5.0));
  for (int i = 0; i < count; ++i)
  {
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const double ring = std::sqrt(1.0 - z * z);
    input.points.push_back(
      scale * kRadius * Vec3(ring * std::cos(golden * i), ring * std::sin(golden * i), z));
  }
  input.cellSize = 0.0005;
  input.modelToWorkspace = AffineTransform::scaling({ scale, scale, scale });
  Status status = Status::Ok;
  return HapticScene::create(std::move(input), status);
}

/// Presses, slides, taps, crosses the whole sphere, jumps, and now and then is no number.
Vec3 wildHand(int tick)
{
  const double t = tick * kTick;
  if (tick % 5003 == 5002)
  {
    return { std::nan(""), 0.0, 0.0 };
  }
  if (tick % 7001 > 6990)
  {
    return { 0.04 * std::sin(double(tick)), 0.04 * std::cos(double(tick)), 0.0 };
  }
  const double depth = kRadius + 0.003 * std::sin(3.0 * t) - (tick % 20000 > 19000 ? 2.0 * kRadius : 0.0);
  return { depth * std::cos(t) * std::cos(0.3 * t), depth * std::sin(t) * std::cos(0.3 * t),
    depth * std::sin(0.3 * t) };
}

struct Outcome
{
  long calls = 0;
  int contacts = 0;
  const char* function = nullptr;
};

/// Steps in a thread of its own, whose counters are fresh; nothing but proxy calls is under the watch.
Outcome stepProxy(ProxyMethod method, int steps)
{
  const std::shared_ptr<const HapticScene> first = sphere(20000, 1.0);
  Status moving = Status::Empty;
  const std::shared_ptr<const HapticScene> scenes[3] = { first, sphere(20000, 1.1),
    first->moved(AffineTransform::rotation(20.0, { 1, 2, 3 }), moving) };
  EXPECT_EQ(moving, Status::Ok);
  HapticParameters parameters;
  parameters.method = method;
  parameters.contact.staticFriction = 0.4;
  parameters.contact.dynamicFriction = 0.3;
  Proxy proxy(parameters);
  Outcome outcome;
  std::thread servo(
    [&]
    {
      const countedcalls::Watch watch;
      for (int tick = 0; tick < steps; ++tick)
      {
        if (tick % 2500 == 0)
        {
          proxy.setScene(scenes[(tick / 2500) % 3].get());
          parameters.contact.stiffness = 500.0 + tick % 1000;
          proxy.setParameters(parameters);
        }
        outcome.contacts += proxy.step(wildHand(tick), kTick).contact ? 1 : 0;
        if (tick % 4 == 0)
        {
          proxy.prefetch();
        }
      }
      outcome.calls = countedcalls::count();
      outcome.function = countedcalls::firstFunction();
    });
  servo.join();
  return outcome;
}

/// Watches the servo thread from its first tick to its last.
class WatchingPort : public HapticPort
{
public:
  WatchingPort(HapticPort& port, int ticks)
    : port_(port)
    , left_(ticks)
  {
  }
  Status read(double timeSeconds, HandState& state) noexcept override
  {
    if (!watch_)
    {
      watch_ = new (memory_) countedcalls::Watch();
    }
    if (left_-- == 0)
    {
      watch_->~Watch();
      calls = countedcalls::count();
      function = countedcalls::firstFunction();
      return Status::EndOfPath;
    }
    return port_.read(timeSeconds, state);
  }
  Status write(double timeSeconds, const Vec3& force) noexcept override
  {
    pushed = pushed || norm(force) > 0.0;
    return port_.write(timeSeconds, force);
  }
  std::atomic<long> calls{ -1 };
  std::atomic<const char*> function{ nullptr };
  std::atomic<bool> pushed{ false };

private:
  HapticPort& port_;
  int left_;
  countedcalls::Watch* watch_ = nullptr;
  alignas(countedcalls::Watch) unsigned char memory_[sizeof(countedcalls::Watch)];
};
}

TEST(CountedCalls, SeesAllocationsAndLocksOfItsOwnThread)
{
  std::thread thread(
    []
    {
      std::mutex mutex;
      std::unique_ptr<std::vector<double>> made;
      const long before = countedcalls::count();
      {
        const countedcalls::Watch watch;
        made = std::make_unique<std::vector<double>>(100);
        EXPECT_EQ(countedcalls::count() - before, 2);
        const std::lock_guard<std::mutex> lock(mutex);
        EXPECT_EQ(countedcalls::count() - before, 3);
        made.reset();
        EXPECT_EQ(countedcalls::count() - before, 5);
      }
      made = std::make_unique<std::vector<double>>(100);
      EXPECT_EQ(countedcalls::count() - before, 5);
      EXPECT_STREQ(countedcalls::firstFunction(), "malloc");
    });
  thread.join();
}

TEST(NoAllocation, InAHundredThousandSurfaceFitSteps)
{
  const Outcome outcome = stepProxy(ProxyMethod::SurfaceFit, 100000);
  EXPECT_EQ(outcome.calls, 0) << outcome.function;
  EXPECT_GT(outcome.contacts, 10000) << "the steps must do the work they are watched at";
}

TEST(NoAllocation, InAHundredThousandGradientSteps)
{
  const Outcome outcome = stepProxy(ProxyMethod::GradientSteps, 100000);
  EXPECT_EQ(outcome.calls, 0) << outcome.function;
  EXPECT_GT(outcome.contacts, 10000) << "the steps must do the work they are watched at";
}

TEST(NoAllocation, InTheServoLoopWhileScenesAndParametersChange)
{
  SimulatedHandSettings settings;
  settings.start = { 0.0, 0.0, 0.03 };
  SimulatedDevice hand(settings);
  ASSERT_EQ(hand.open(), Status::Ok);
  hand.setTarget({ 0.0, 0.0, 0.02 });
  WatchingPort port(hand, 3000);
  ServoSettings servo;
  servo.rateHz = 2000.0;
  servo.traceCapacity = 500;
  ServoLoop loop;
  loop.publishScene(sphere(20000, 1.0));
  ASSERT_EQ(loop.start(port, HapticParameters(), servo), Status::Ok);
  for (int round = 0; loop.running(); ++round)
  {
    HapticParameters parameters;
    parameters.contact.stiffness = 600.0 + 100.0 * (round % 5);
    EXPECT_EQ(loop.setParameters(parameters), Status::Ok);
    // The size changes only once the hand touches it: a surface that grows past a free hand has it inside.
    loop.publishScene(sphere(5000, port.pushed ? 1.0 + 0.001 * (round % 3) : 1.0));
    if (round % 3 == 0)
    {
      std::vector<ServoSample> samples;
      loop.takeTrace(samples);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  loop.stop();
  EXPECT_EQ(port.calls, 0) << port.function.load();
  EXPECT_TRUE(port.pushed);
}

TEST(NoAllocation, InAHundredThousandTicksOfTheFalconsDriver)
{
  trial::FalconOnAWire wire;
  trial::FalconModel& model = wire.model;
  model.runs = true;
  wire.onCommand = [](trial::FalconModel& m) { m.move(kTick); };
  FalconDevice device(FalconSettings(), trial::wiredBus<countedcalls::Pause>(wire));
  ASSERT_EQ(device.open(), Status::Ok) << device.message();
  long calls = -1;
  const char* function = nullptr;
  int answered = 0;
  std::thread servo(
    [&]
    {
      const countedcalls::Watch watch;
      for (int tick = 0; tick < 100000; ++tick)
      {
        const double time = tick * kTick;
        HandState hand;
        const bool ok = device.read(time, hand) == Status::Ok;
        answered += ok ? 1 : 0;
        // A wall, and now and then what is no number or beyond all limits.
        const double push = tick % 997 == 0 ? std::nan("") : tick % 991 == 0 ? 1e9 : -800.0 * hand.position.z;
        static_cast<void>(device.write(time, { 0.0, 0.0, push }));
        // Silence and a jump: faults are part of the job.
        model.silent = tick % 10007 > 9900;
        if (tick % 5003 == 5002)
        {
          model.hand.position.x = model.hand.position.x > 0.0 ? -0.02 : 0.02;
        }
      }
      calls = countedcalls::count();
      function = countedcalls::firstFunction();
    });
  servo.join();
  device.close();
  EXPECT_EQ(calls, 0) << function;
  EXPECT_GT(answered, 90000);
  EXPECT_GT(device.statistics().timeouts, 5u);
}
