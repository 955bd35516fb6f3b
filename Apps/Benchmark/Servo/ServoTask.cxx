/// Step time, jitter and deadline misses of the servo loop.
#include "Benchmark/Render/Turntable.h"
#include "Benchmark/Render/WholeProcess.h"
#include "Benchmark/Servo/EmptyLoop.h"
#include "Benchmark/Tasks.h"
#include "Options/OptionParsing.h"
#include "Unit/Devices/FalconWire.h"
#include "ViewDisplay.h"

#include "Devices/Falcon/FalconDevice.h"
#include "Devices/SimulatedDevice.h"
#include "Haptics/ServoLoop.h"
#include "Shapes/Shapes.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <thread>

namespace pointhaptics::bench::servo
{
namespace
{

using namespace app;

constexpr std::int64_t kMostPoints = 100000000;
constexpr double kLongestRun = 86400.0; ///< Seconds.
constexpr double kLargestError = 0.08;  ///< N; 2 mm at 800 N/m are 1.6 N.
constexpr double kLeastContact = 0.3;   ///< Fraction of the ticks.

enum class Hand
{
  Simulated, ///< A mass on a spring, pulled along the path.
  Falcon,    ///< The Falcon's driver on a wire in memory: codec, kinematics, force chain; no USB.
};

enum class Load
{
  Idle,
  Busy,      ///< A thread per core that never rests.
  Rendering, ///< The calling thread draws, 30 times a second or as often as it can.
};

struct Setting
{
  Hand hand = Hand::Simulated;
  Load load = Load::Idle;
  double rateHz = 1000.0;
  double seconds = 10.0;
  std::function<void()> draw; ///< One frame; needed where the load is Rendering.
};

struct Outcome
{
  ServoStatistics statistics;
  double contactFraction = 0.0; ///< Part of the traced ticks.
  double largestError = 0.0;    ///< Error of the force against that of the ideal sphere, N.
  double framesPerSecond = 0.0;
  /// Figures of an empty loop beside this one, at the same time; where the machine was idle otherwise and a
  /// core was left for it.
  struct Empty
  {
    std::uint64_t deadlineMisses = 0;
    double largestJitter = 0.0; ///< Seconds.
  };
  std::optional<Empty> empty;
};

struct Options
{
  std::int64_t points = 0;
  double seconds = 0.0;
  std::vector<std::string> hands{ "simulated", "falcon" };
  std::vector<std::string> loads{ "idle", "busy", "drawing" };
  std::vector<std::string> rates{ "1000", "10000" };
};

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
    auto wire = std::make_shared<trial::FalconOnAWire>();
    wire->model.runs = true;
    wire->onCommand = [time = 0.0](trial::FalconModel& moved) mutable
    {
      time += 1e-3;
      moved.hand.position = handAt(time) + falcon::kCenter;
    };
    return std::make_unique<FalconDevice>(FalconSettings(),
      [wire, open = trial::wiredBus(*wire)](Status& status, std::string& message)
      { return open(status, message); });
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

const char* name(Hand hand)
{
  return hand == Hand::Falcon ? "Falcon's driver" : "simulated hand";
}

const char* name(Load load)
{
  return load == Load::Idle ? "idle" : load == Load::Busy ? "a busy thread per core" : "drawing the cloud";
}

/// A sphere of 25 mm radius, @p count points at random.
std::shared_ptr<const HapticScene> sphereScene(int count)
{
  HapticSceneInput input;
  static_cast<void>(generateShape(Shape::Sphere, count, 1, 0.0, input.points));
  Status status = Status::Ok;
  return HapticScene::create(std::move(input), status);
}

/// The hand presses up to 2 mm into the sphere and slides over it at 50 mm/s.
Outcome runLoop(const Setting& setting, const std::shared_ptr<const HapticScene>& scene)
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

bool has(const std::vector<std::string>& words, const char* word)
{
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// The viewer's picture of the cloud of @p points, turned by a degree a call. Empty: there is none, and rows
/// with drawing are left out.
std::function<void()> makeDrawing(std::int64_t points)
{
  std::string folder = (std::filesystem::temp_directory_path() / "pointhaptics-servo-XXXXXX").string();
  if (!::mkdtemp(folder.data()))
  {
    return {};
  }
  const std::string file = folder + "/sphere.ply";
  const render::ProcessRun made = render::runProcess(
    { render::viewerProgram(), "generate", "sphere", "-n", std::to_string(points), "-o", file });
  auto table = std::make_shared<render::Turntable>();
  std::string message;
  const bool isOpen = made.exitCode == 0 && table->open(file, 1280, 720, message);
  std::error_code ignored;
  std::filesystem::remove_all(folder, ignored);
  if (!isOpen)
  {
    return {};
  }
  table->setDetail(true);
  return [table] { table->turn(1.0); };
}

Json toJson(const LatencyHistogram::Summary& s)
{
  return { { "p50", s.p50 }, { "p99", s.p99 }, { "p999", s.p999 }, { "max", s.maximum } };
}

void addRow(Run& run, const Setting& setting, const Outcome& outcome)
{
  const ServoStatistics& s = outcome.statistics;
  const bool right = outcome.contactFraction > kLeastContact && outcome.largestError < kLargestError;
  Json empty;
  if (outcome.empty)
  {
    empty = { { "deadline_misses", outcome.empty->deadlineMisses },
      { "largest_jitter_seconds", outcome.empty->largestJitter } };
  }
  run.add("loop",
    { { "hand", name(setting.hand) }, { "load", name(setting.load) }, { "rate_hz", setting.rateHz },
      { "step_seconds", toJson(s.update) }, { "jitter_seconds", toJson(s.jitter) }, { "ticks", s.ticks },
      { "deadline_misses", s.deadlineMisses }, { "empty_loop", empty }, { "achieved_hz", s.rateHz },
      { "real_time_priority", s.realtime }, { "memory_locked", s.memoryRefusal == 0 },
      { "cores_awake", s.awakeRefusal == 0 }, { "frames_per_second", outcome.framesPerSecond },
      { "largest_force_error_n", outcome.largestError }, { "right", right } });
  if (!right)
  {
    run.fault("a force of the servo loop is wrong; look for rows that are not right");
  }
}

std::vector<Setting> settingsOf(const Options& options, double seconds, const std::function<void()>& draw)
{
  const std::pair<const char*, Load> loads[] = { { "idle", Load::Idle }, { "busy", Load::Busy },
    { "drawing", Load::Rendering } };
  std::vector<Setting> settings;
  for (const Hand hand : { Hand::Simulated, Hand::Falcon })
  {
    for (const auto& [word, load] : loads)
    {
      for (const double rate : { 1000.0, 10000.0 })
      {
        const bool can = !(rate > 1000.0 && hand == Hand::Falcon) && (load != Load::Rendering || draw);
        if (can && has(options.hands, hand == Hand::Falcon ? "falcon" : "simulated") &&
          has(options.loads, word) && has(options.rates, rate > 1000.0 ? "10000" : "1000"))
        {
          settings.push_back({ hand, load, rate, seconds, draw });
        }
      }
    }
  }
  return settings;
}

void measure(const Options& options, Run& run)
{
  const std::int64_t points = run.chosen<std::int64_t>(options.points, 543652, 30000);
  const double seconds = run.chosen(options.seconds, 10.0, 0.4);
  std::function<void()> draw;
  if (std::string whyNot; !run.quick && has(options.loads, "drawing") && displayIsAvailable(whyNot))
  {
    run.say("making the viewer's picture");
    draw = makeDrawing(points);
  }
  const std::vector<Setting> settings = settingsOf(options, seconds, draw);
  if (settings.empty())
  {
    run.fault("nothing was measured: the falcon runs at 1000 Hz only, and drawing needs a display; choose "
              "other --hands, --loads or --rates");
    return;
  }
  const auto scene = sphereScene(int(points));
  for (const Setting& setting : settings)
  {
    run.say(fmt::format("{}, {}, {:g} Hz", name(setting.hand), name(setting.load), setting.rateHz));
    addRow(run, setting, runLoop(setting, scene));
  }
  if (!draw)
  {
    run.remark("loop", "The rows with drawing were left out: they need a display and more than a quick run.");
  }
}

TaskRun addOptions(CLI::App& command)
{
  auto options = std::make_shared<Options>();
  addInteger(command, "--points", options->points, 1000, kMostPoints, "Points of the cloud; default 543652");
  addNumber(command, "--seconds", options->seconds, { 0.0, kLongestRun, true }, "S",
    "Length of each run; default 10");
  const Options all;
  addWords(command, "--hands", options->hands, all.hands, false, "Whose hand to run; default all");
  addWords(command, "--loads", options->loads, all.loads, false,
    "What the machine does meanwhile; default all, drawing where there is a display");
  addWords(command, "--rates", options->rates, all.rates, false,
    "Ticks a second; default all, the Falcon's at 1000 only");
  return [options](Run& run) { measure(*options, run); };
}

} // namespace
} // namespace pointhaptics::bench::servo

namespace pointhaptics::bench
{

Task servoTask()
{
  return { "servo", "Time the servo loop: step time, jitter, deadline misses; idle, loaded, drawing", 0, 0,
    false, { "loop" }, {}, servo::addOptions };
}

} // namespace pointhaptics::bench
