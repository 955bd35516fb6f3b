// No force exceeds the least of the three limits, whatever parameters, scenes, hands and devices do.
#include "FuzzRuns.h"

#include "Devices/SimulatedDevice.h"
#include "Haptics/Servo/ForceLimit.h"
#include "Haptics/Servo/ServoStep.h"
#include "Shapes/Shapes.h"
#include "Unit/Haptics/ServoLoopFixtures.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

using namespace pointhaptics;

namespace
{

/// Random choices of one run.
class Draw
{
public:
  explicit Draw(std::uint64_t seed)
    : engine_(seed * 0x9E3779B97F4A7C15u + 5)
  {
  }
  bool oneIn(int n) { return std::uniform_int_distribution<int>(1, n)(engine_) == 1; }
  int below(int n) { return std::uniform_int_distribution<int>(0, n - 1)(engine_); }
  double between(double a, double b) { return std::uniform_real_distribution<double>(a, b)(engine_); }
  /// Evenly on a logarithmic scale.
  double scale(double a, double b) { return std::exp(this->between(std::log(a), std::log(b))); }
  Vec3 place(double reach)
  {
    return { this->between(-reach, reach), this->between(-reach, reach), this->between(-reach, reach) };
  }

  /// Any that HapticParameters::check() takes.
  HapticParameters parameters()
  {
    HapticParameters drawn;
    drawn.method = ProxyMethod(this->below(3));
    ContactParameters& contact = drawn.contact;
    contact.stiffness = this->oneIn(20) ? 0.0 : this->scale(1.0, 1e5);
    contact.damping = this->oneIn(2) ? 0.0 : this->scale(1e-3, 1e3);
    contact.staticFriction = this->oneIn(2) ? 0.0 : this->scale(1e-2, 10.0);
    contact.dynamicFriction = contact.staticFriction * this->between(0.0, 1.0);
    contact.settleRate = this->oneIn(4) ? INFINITY : this->scale(1e-2, 1e6);
    contact.forceLimit = this->oneIn(5) ? INFINITY : this->scale(0.05, 1e3);
    GradientStepsParameters& gains = drawn.gradientSteps;
    gains.freeGain = this->between(0.0, 1.0);
    gains.normalGain = this->scale(1e-3, 10.0);
    gains.tangentGain = this->scale(1e-7, 1.0);
    gains.sinkTolerance = this->between(0.0, 1.0);
    gains.maximumStepsPerTick = 1 + this->below(200);
    gains.normalizedByDensity = this->oneIn(2);
    return drawn;
  }

  /// A shape of up to 4000 points, or a crowd of them without a surface.
  std::shared_ptr<const HapticScene> scene()
  {
    HapticSceneInput input;
    const int count = 50 + this->below(4000);
    if (this->oneIn(4))
    {
      for (int i = 0; i < count; ++i)
      {
        input.points.push_back(this->place(0.02));
      }
    }
    else
    {
      EXPECT_EQ(
        generateShape(Shape(this->below(4)), count, engine_(), this->oneIn(2) ? 0.0 : 2e-4, input.points),
        Status::Ok);
    }
    input.cellSize = this->scale(3e-4, 5e-3);
    Status status = Status::Ok;
    return HapticScene::create(std::move(input), status);
  }

private:
  std::mt19937_64 engine_;
};

/// A hand that wanders, leaps, rests, and now and then is nowhere.
class Hand
{
public:
  explicit Hand(Draw& draw)
    : draw_(draw)
    , step_(draw.scale(1e-5, 5e-3))
    , place_(draw.place(0.03))
  {
  }
  Vec3 next()
  {
    if (draw_.oneIn(500))
    {
      place_ = draw_.place(0.05);
    }
    const Vec3 home = -0.02 * place_;
    place_ = place_ + home * draw_.between(0.0, 1.0) + draw_.place(step_);
    return draw_.oneIn(1000) ? Vec3{ NAN, 0.0, INFINITY } : place_;
  }

private:
  Draw& draw_;
  double step_;
  Vec3 place_;
};

/// The greatest part of its limit that a run's forces had.
double expectWithin(double limit, const Vec3& force, double most)
{
  const double length = std::hypot(force.x, force.y, force.z); // of the last digit, too
  EXPECT_TRUE(length <= limit) << length << " N, and the limit is " << limit << " N";
  return std::max(most, length / limit);
}

/// Ticks in virtual time; parameters, limits and scenes change between them. @return see expectWithin().
double stepAlong(Draw& draw, int ticks)
{
  HandLimits device;
  device.maximumForce = draw.oneIn(8) ? INFINITY : draw.scale(0.5, 20.0);
  ForceLimits program;
  program.maximumForce = draw.oneIn(2) ? 1e9 : draw.scale(0.1, 20.0);
  program.maximumSlewRate = draw.oneIn(2) ? INFINITY : draw.scale(10.0, 1e6);
  HapticParameters parameters = draw.parameters();
  ForceLimit limit = servoForceLimit(device, parameters.contact, program);
  ServoStepSettings settings;
  settings.rateHz = draw.scale(100.0, 1e4);
  settings.limits = { servoForceLimit(device, ContactParameters(), program).newtons(),
    program.maximumSlewRate };
  settings.rampUpSeconds = settings.clutchDownSeconds = draw.oneIn(2) ? 0.0 : draw.scale(1e-3, 1.0);
  ServoStep step(settings, parameters);
  std::shared_ptr<const HapticScene> scene = draw.scene();
  step.setScene(scene.get());
  Hand hand(draw);
  TickInput input;
  ServoSample sample;
  double most = 0.0;
  for (int i = 0; i < ticks && !testing::Test::HasFailure(); ++i)
  {
    if (draw.oneIn(50))
    {
      parameters = draw.parameters();
      limit = servoForceLimit(device, parameters.contact, program);
      parameters.contact.forceLimit = limit.newtons();
      step.setParameters(parameters);
    }
    if (draw.oneIn(300))
    {
      Status status = Status::Ok;
      auto moved =
        scene->moved(AffineTransform::scaling(Vec3{ 1.0, 1.0, 1.0 } * draw.scale(0.8, 1.25)), status);
      step.setScene(moved.get());
      scene = moved ? moved : scene;
    }
    input.number += draw.oneIn(100) ? 1 + draw.below(2000) : 1;
    input.hand.position = hand.next();
    input.hand.isNew = draw.oneIn(2000);
    input.reading = draw.oneIn(400) ? Status::DeviceSilent : Status::Ok;
    input.gateIsOpen = !draw.oneIn(200);
    input.holdsModel = draw.oneIn(200);
    step.step(input, sample);
    const Vec3 written = input.reading == Status::Ok ? sample.state.force : Vec3();
    most = expectWithin(limit.newtons(), written, most);
    step.finish(input, draw.oneIn(300) ? Status::DeviceLost : Status::Ok, sample);
    most = expectWithin(limit.newtons(), sample.state.force, most);
  }
  return most;
}

/// A servo loop in real time, over each kind of device. @return see expectWithin().
double loopAlong(Draw& draw, double seconds)
{
  const double declared = draw.oneIn(4) ? 1e9 : draw.scale(0.5, 20.0);
  pointhaptics::trial::ScriptedPort port;
  port.declared = declared;
  Hand hand(draw);
  HipPath path;
  for (double time = 0.0; time < seconds + 1.0; time += 0.002)
  {
    const Vec3 place = hand.next();
    path.points.push_back({ time, isFinite(place) ? place : Vec3() });
  }
  port.path = [&path](double time)
  { return path.points[std::min(path.points.size() - 1, std::size_t(time / 0.002))].position; };
  SimulatedDevice simulated;
  simulated.setPath(path);
  SimulatedHandSettings stiff;
  stiff.yieldsToForce = false;
  stiff.holdsAtEnd = true;
  SimulatedDevice replayed(stiff);
  replayed.setPath(path);
  const int kind = draw.below(3);
  HapticPort* const devices[] = { &port, &simulated, &replayed };
  HapticPort& device = *devices[kind];
  EXPECT_EQ(simulated.open(), Status::Ok);
  EXPECT_EQ(replayed.open(), Status::Ok);
  ServoSettings settings = pointhaptics::trial::plainSettings();
  settings.rateHz = draw.oneIn(2) ? 1000.0 : 4000.0;
  settings.limits = { draw.oneIn(2) ? 1e9 : draw.scale(0.1, 20.0), INFINITY };
  ServoLoop loop;
  loop.publishScene(draw.scene());
  // A real hand can bear some springs only: others are refused, which pushes nobody.
  HapticParameters parameters = draw.parameters();
  parameters.contact.stiffness = kind == 1 ? 300.0 : parameters.contact.stiffness;
  parameters.contact.damping = kind == 1 ? 0.0 : parameters.contact.damping;
  EXPECT_EQ(loop.start(device, parameters, settings), Status::Ok);
  const double fixed = std::min(
    { kMostServoForce, settings.limits.maximumForce, device.maximumForce(), device.limits().maximumForce });
  double most = 0.0;
  std::vector<ServoSample> samples;
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (std::chrono::steady_clock::now() < end && !testing::Test::HasFailure())
  {
    parameters = draw.parameters();
    static_cast<void>(loop.setParameters(parameters));
    loop.setClutched(draw.oneIn(6));
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    loop.takeTrace(samples);
    for (const ServoSample& sample : samples)
    {
      most = expectWithin(fixed, sample.state.force, most);
    }
    EXPECT_LE(loop.forceLimit().newtons(), fixed);
  }
  loop.stop();
  return most;
}

} // namespace

/// POINTHAPTICS_FUZZ_SECONDS=<n> goes on for so long; the seeds then follow each other from the first one on.
TEST(ForceLimitFuzz, NothingExceedsTheLeastLimit)
{
  const ::trial::FuzzRuns runs(40);
  const std::uint64_t seconds = ::trial::FuzzRuns::number("POINTHAPTICS_FUZZ_SECONDS", 0);
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(seconds);
  constexpr int kTicks = 3000;
  std::uint64_t seed = runs.first;
  double most = 0.0;
  int touched = 0;
  for (; (seconds > 0 ? std::chrono::steady_clock::now() < end : seed < runs.first + runs.count) &&
       !HasFailure();
       ++seed)
  {
    SCOPED_TRACE(
      testing::Message() << "repeat with POINTHAPTICS_FUZZ_SEED=" << seed << " POINTHAPTICS_FUZZ_RUNS=1");
    Draw draw(seed);
    const double part = seed % 10 == 0 ? loopAlong(draw, 0.2) : stepAlong(draw, kTicks);
    most = std::max(most, part);
    touched += part > 0.0;
  }
  const std::uint64_t number = seed - runs.first;
  RecordProperty("runs", int(number));
  std::printf("%llu runs, %d of them with a force, the greatest %.17g of its limit\n",
    static_cast<unsigned long long>(number), touched, most);
  EXPECT_GT(touched, int(number) / 2);
  EXPECT_GT(most, 0.999) << "no limit was reached";
}
