#include "Benchmark/Servo/ServoRun.h"

#include "Benchmark/Servo/EmptyLoop.h"
#include "Unit/Devices/MemoryLink.h"

#include "Devices/Falcon/FalconDevice.h"
#include "Devices/SimulatedDevice.h"
#include "Shapes/Shapes.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <thread>

namespace pointhaptics
{
namespace bench
{
namespace servo
{
namespace
{

constexpr double kRadius = 0.025;
constexpr double kStiffness = 800.0;
constexpr double kPathStep = 5e-3;
constexpr double kSpeed = 0.05;
constexpr double kFramesPerSecond = 30.0;

/// From 3 mm outside to 1 to 2 mm inside, then along a waving course.
Vec3 handAt(double time)
{
  const double slide = std::max(0.0, time - 0.3);
  const double angle = slide * kSpeed / kRadius;
  const double tilt = 0.9 + 0.4 * std::sin(1.7 * angle);
  const Vec3 direction(std::sin(tilt) * std::cos(angle), std::sin(tilt) * std::sin(angle), std::cos(tilt));
  const double depth = time < 0.3 ? -0.003 + 0.015 * time : 0.0015 + 0.0005 * std::sin(20.0 * slide);
  return (kRadius - depth) * direction;
}

std::unique_ptr<HapticDevice> makeDevice(const Setting& setting)
{
  if (setting.hand == Hand::Falcon)
  {
    auto model = std::make_shared<trial::FalconModel>();
    model->runs = true;
    const auto onCommand = [time = 0.0](trial::FalconModel& moved) mutable
    {
      time += 1e-3;
      moved.hand.position = handAt(time) + falcon::kCenter;
    };
    return std::make_unique<FalconDevice>(
      FalconSettings(), std::make_unique<trial::MemoryBus<>>(std::move(model), onCommand));
  }
  auto hand = std::make_unique<SimulatedDevice>();
  HipPath path;
  for (double time = 0.0; time < setting.seconds + 60.0; time += kPathStep)
  {
    path.points.push_back({ time, handAt(time) });
  }
  hand->setPath(std::move(path));
  return hand;
}

/// Draws until @p shouldContinue says no. @return frames a second.
double render(const std::function<void()>& draw, const std::function<bool()>& shouldContinue)
{
  draw(); // the first one uploads
  const auto begin = std::chrono::steady_clock::now();
  int frames = 0;
  while (shouldContinue())
  {
    draw();
    ++frames;
    std::this_thread::sleep_until(begin + std::chrono::duration<double>(frames / kFramesPerSecond));
  }
  return frames / std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Threads that never rest, one per core, while it lives.
class BusyThreads
{
public:
  explicit BusyThreads(unsigned count)
  {
    for (unsigned i = 0; i < count; ++i)
    {
      threads_.emplace_back(
        [this]
        {
          volatile double x = 1.0;
          while (!done_.load(std::memory_order_relaxed))
          {
            x = x * 1.0000001;
          }
        });
    }
  }
  ~BusyThreads()
  {
    done_ = true;
    for (std::thread& thread : threads_)
    {
      thread.join();
    }
  }

private:
  std::atomic<bool> done_{ false };
  std::vector<std::thread> threads_;
};

Vec3 idealForce(const Vec3& hip)
{
  const double depth = kRadius - norm(hip);
  return depth > 0.0 ? kStiffness * depth * normalized(hip) : Vec3();
}

void look(const std::vector<ServoSample>& samples, std::size_t& traced, std::size_t& touched, double& error)
{
  for (const ServoSample& sample : samples)
  {
    if (sample.device != Status::Ok)
    {
      continue;
    }
    ++traced;
    touched += sample.state.contact ? 1 : 0;
    error = std::max(error, norm(sample.state.force - idealForce(sample.state.hip)));
  }
}

} // namespace

const char* name(Hand hand)
{
  return hand == Hand::Falcon ? "Falcon's driver" : "simulated hand";
}

const char* name(Load load)
{
  return load == Load::Idle ? "idle" : load == Load::Busy ? "a busy thread per core" : "drawing the cloud";
}

std::shared_ptr<const HapticScene> sphereScene(int count)
{
  HapticSceneInput input;
  static_cast<void>(generateShape(Shape::Sphere, count, 1, 0.0, input.points));
  Status status = Status::Ok;
  return HapticScene::create(std::move(input), status);
}

Outcome run(const Setting& setting, const std::shared_ptr<const HapticScene>& scene)
{
  Outcome outcome;
  const std::unique_ptr<HapticDevice> device = makeDevice(setting);
  ServoLoop loop; // after the device: stops before it goes
  loop.publishScene(scene);
  ServoSettings settings;
  settings.rateHz = setting.rateHz;
  settings.lockMemory = true;
  settings.keepCoresAwake = true;
  HapticParameters parameters;
  parameters.contact.stiffness = kStiffness;
  const bool comparesEmpty = setting.load == Load::Idle && std::thread::hardware_concurrency() > 1;
  std::optional<LastCoreApart> apart;
  if (comparesEmpty)
  {
    apart.emplace();
  }
  if (device->open() != Status::Ok || loop.start(*device, parameters, settings) != Status::Ok)
  {
    return outcome;
  }
  const BusyThreads busy(setting.load == Load::Busy ? std::max(1u, std::thread::hardware_concurrency()) : 0);
  std::optional<EmptyLoop> empty;
  if (comparesEmpty)
  {
    empty.emplace(setting.rateHz, settings.wakeEarlySeconds);
  }
  std::size_t traced = 0;
  std::size_t touched = 0;
  std::vector<ServoSample> samples;
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(setting.seconds);
  const auto shouldContinue = [&]
  {
    samples.clear();
    loop.takeTrace(samples);
    look(samples, traced, touched, outcome.largestError);
    return std::chrono::steady_clock::now() < end;
  };
  if (setting.load == Load::Rendering)
  {
    outcome.framesPerSecond = render(setting.draw, shouldContinue);
  }
  while (shouldContinue())
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  outcome.statistics = loop.statistics();
  if (empty)
  {
    empty->stop();
    outcome.empty = Outcome::Empty{ empty->deadlineMisses(), empty->largestJitter() };
  }
  loop.stop();
  device->close();
  outcome.contactFraction = traced > 0 ? double(touched) / double(traced) : 0.0;
  return outcome;
}

} // namespace servo
} // namespace bench
} // namespace pointhaptics
