#include "Commands/FalconDiagnosis.h"

#include "Terminal/Messages.h"
#include "Terminal/StopSignals.h"

#include "Haptics/Servo/LatestValue.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <functional>
#include <thread>

#include <poll.h>
#include <unistd.h>

namespace pointhaptics::app
{
namespace
{

constexpr double kRateHz = 1000.0;
constexpr double kTinyForce = 0.5; // N
/// Duration of a push; the ramp takes one second of it.
constexpr double kPushSeconds = 1.5;
constexpr double kShortestPush = 0.5;
/// Time until a pushed hand is back, seconds.
constexpr double kBackSeconds = 0.3;
constexpr double kLedSeconds = 0.3;
constexpr double kRateSeconds = 5.0;
/// Part of the time that is enough where no person sees and feels it.
constexpr double kPartWithoutAPerson = 0.2;
constexpr double kLongestHoming = 120.0;
/// Part of a movement that must be in the requested direction.
constexpr double kDirection = 0.9;
constexpr int kQuestionMilliseconds = 100;

/// A virtual finger: no scene, a force of its own. It gives the diagnosis the servo thread.
class PushPort : public HapticPort
{
public:
  explicit PushPort(FalconDevice& device)
    : device_(device)
  {
  }
  Status read(double timeSeconds, HandState& state) noexcept override
  {
    return device_.read(timeSeconds, state);
  }
  Status write(double timeSeconds, const Vec3&) noexcept override
  {
    static_cast<void>(force_.tryRead(newest_)); // else the one before, for this tick
    return device_.write(timeSeconds, newest_);
  }
  HandLimits limits() const noexcept override { return device_.limits(); }
  void push(const Vec3& force) noexcept { force_.write(force); }

private:
  FalconDevice& device_;
  LatestValue<Vec3> force_;
  Vec3 newest_; ///< The servo thread's.
};

/// A push that ends with its scope, however that is left.
class Push
{
public:
  Push(FalconDevice& device, PushPort& port, const Vec3& force)
    : device_(device)
    , port_(port)
  {
    port_.push(force);
    device_.setArmed(true);
  }
  ~Push()
  {
    device_.setArmed(false);
    port_.push(Vec3());
  }
  Push(const Push&) = delete;
  Push& operator=(const Push&) = delete;

private:
  FalconDevice& device_;
  PushPort& port_;
};

class Diagnosis
{
public:
  Diagnosis(const FalconOptions& options, bool yes, std::ostream& report)
    : settings_(options.settings())
    , yes_(yes)
    , report_(report)
  {
    settings_.armWhenHomed = false;
    settings_.limits.maximumForce = std::min(settings_.limits.maximumForce, kTinyForce);
  }

  bool run(std::string& message);
  int problems() const noexcept { return problems_; }

private:
  void note(const std::string& line)
  {
    printNow(stdout, line + "\n");
    report_ << line << std::endl; // what was found stays, whatever comes next
  }
  /// Prints @p result and if it is right, on one line.
  void judge(const std::string& result, bool isRight)
  {
    note(result + (isRight ? "as expected" : "NOT as expected"));
    problems_ += isRight ? 0 : 1;
  }
  void ask(const std::string& question);
  bool waitFor(const std::function<bool()>& condition, double seconds);
  void wait(double seconds)
  {
    waitFor([] { return false; }, seconds);
  }
  double patience(double seconds) const { return yes_ ? kPartWithoutAPerson * seconds : seconds; }
  void checkLeds(FalconDevice& device);
  bool checkHoming(FalconDevice& device);
  void checkEncoders(FalconDevice& device);
  void checkRate(const FalconDevice& device, const ServoLoop& loop);
  void checkMotors(FalconDevice& device, PushPort& port);

  FalconSettings settings_;
  bool yes_;
  ServoLoop* loop_ = nullptr;
  std::ostream& report_;
  int problems_ = 0;
};

/// Reads a line from the terminal, without its end; a part of it where the program is asked to stop.
std::string answerOfPerson()
{
  std::string answer;
  while (!stopIsRequested())
  {
    pollfd input{ STDIN_FILENO, POLLIN, 0 };
    if (poll(&input, 1, kQuestionMilliseconds) <= 0)
    {
      continue;
    }
    char byte = 0;
    if (read(STDIN_FILENO, &byte, 1) != 1 || byte == '\n')
    {
      break;
    }
    answer += byte;
  }
  return answer;
}

/// Asks a question and writes the answer into the report. The loop runs meanwhile.
void Diagnosis::ask(const std::string& question)
{
  printNow(stdout, question + " ");
  std::string answer;
  if (yes_)
  {
    printNow(stdout, "\n");
  }
  else
  {
    answer = answerOfPerson();
  }
  report_ << question << " " << answer << std::endl;
}

bool Diagnosis::waitFor(const std::function<bool()>& condition, double seconds)
{
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (!condition())
  {
    if (stopIsRequested() || std::chrono::steady_clock::now() > end)
    {
      return false;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

void Diagnosis::checkLeds(FalconDevice& device)
{
  note("\n1. LEDs");
  const std::pair<int, const char*> leds[] = { { kFalconLedGreen, "green" }, { kFalconLedBlue, "blue" },
    { kFalconLedRed, "red" } };
  for (const auto& [bit, name] : leds)
  {
    device.showLeds(bit);
    wait(patience(kLedSeconds));
    ask(fmt::format("   Bit {} should be {}. Which LED is on? [{}]", bit, name, name));
  }
  device.showLeds(-1);
}

bool Diagnosis::checkHoming(FalconDevice& device)
{
  note("\n2. Homing");
  printNow(stdout,
    "   Pull the grip all the way out, then push it all the way in; do it again if nothing happens.\n");
  int last = -1;
  const bool homed = waitFor(
    [&]
    {
      const int bits = device.raw().reply.homed;
      if (bits != last)
      {
        note(fmt::format("   homing bits {}{}{}", bits & 1, (bits >> 1) & 1, (bits >> 2) & 1));
        last = bits;
      }
      return device.state() == FalconState::Homed;
    },
    patience(kLongestHoming));
  problems_ += homed ? 0 : 1;
  note(homed ? "   homed" : "   NOT homed: does the LED change while you move? Is bit 1 the homing bit?");
  return homed;
}

void Diagnosis::checkEncoders(FalconDevice& device)
{
  note("\n3. Encoders: positions should grow to the right (x), up (y) and towards you (z)");
  if (yes_)
  {
    note("   not checked: nobody is asked to move the grip");
    return;
  }
  const char* const directions[] = { "to the right", "up", "towards you" };
  for (int axis = 0; axis < 3 && !stopIsRequested(); ++axis)
  {
    ask("   Hold the grip in the middle, then press Enter.");
    const Vec3 from = loop_->latest().state.hip;
    const std::array<std::int16_t, 3> countsFrom = device.raw().reply.encoders;
    ask(fmt::format("   Move it {} by about 2 cm, hold, press Enter.", directions[axis]));
    const Vec3 moved = loop_->latest().state.hip - from;
    const std::array<std::int16_t, 3> counts = device.raw().reply.encoders;
    if (stopIsRequested())
    {
      return;
    }
    judge(fmt::format("   moved {} by ({:.1f}, {:.1f}, {:.1f}) mm, counts ({}, {}, {}): ", directions[axis],
            1e3 * moved.x, 1e3 * moved.y, 1e3 * moved.z, counts[0] - countsFrom[0], counts[1] - countsFrom[1],
            counts[2] - countsFrom[2]),
      moved[axis] > kDirection * norm(moved) && norm(moved) > 5e-3);
  }
}

void Diagnosis::checkRate(const FalconDevice& device, const ServoLoop& loop)
{
  note("\n4. Rate");
  const FalconStatistics before = device.statistics();
  const ServoStatistics servoBefore = loop.statistics();
  wait(patience(kRateSeconds));
  const FalconStatistics after = device.statistics();
  const ServoStatistics servo = loop.statistics();
  note(fmt::format(
    "   {} ticks, {} answers, {} late, {} timeouts, {} bad, {} bytes dropped, {} commands skipped",
    servo.ticks - servoBefore.ticks, after.replies - before.replies, after.lateReplies - before.lateReplies,
    after.timeouts - before.timeouts, after.badReplies - before.badReplies,
    after.droppedBytes - before.droppedBytes, after.skippedCommands - before.skippedCommands));
  note(
    fmt::format("   at most {} answers outstanding when a position was taken (0 is what the stiffness limit "
                "counts on)",
      after.largestUnanswered));
  note(fmt::format(
    "   servo {:.0f} Hz, {} deadline misses; step time p50 {:.0f} p99 {:.0f} max {:.0f} us; jitter p50 "
    "{:.0f} p99 {:.0f} max {:.0f} us; real-time priority {}",
    servo.rateHz, servo.deadlineMisses, 1e6 * servo.update.p50, 1e6 * servo.update.p99,
    1e6 * servo.update.maximum, 1e6 * servo.jitter.p50, 1e6 * servo.jitter.p99, 1e6 * servo.jitter.maximum,
    servo.realtime ? "yes" : "no"));
}

void Diagnosis::checkMotors(FalconDevice& device, PushPort& port)
{
  note(fmt::format("\n5. Motors, at most {} N", settings_.limits.maximumForce));
  ask("   Hold the grip loosely in the middle, then press Enter.");
  const char* const directions[] = { "to the right", "up", "towards you" };
  for (int axis = 0; axis < 3 && !stopIsRequested(); ++axis)
  {
    wait(kBackSeconds);
    const Vec3 from = loop_->latest().state.hip;
    Vec3 force;
    force[axis] = settings_.limits.maximumForce;
    Vec3 moved;
    std::array<std::int16_t, 3> motors{};
    {
      const Push push(device, port, force);
      wait(std::max(patience(kPushSeconds), kShortestPush));
      moved = loop_->latest().state.hip - from;
      motors = device.raw().command.motors;
    }
    if (stopIsRequested())
    {
      return;
    }
    judge(fmt::format("   pushed {}: motors ({}, {}, {}), moved by ({:.1f}, {:.1f}, {:.1f}) mm: ",
            directions[axis], motors[0], motors[1], motors[2], 1e3 * moved.x, 1e3 * moved.y, 1e3 * moved.z),
      moved[axis] > kDirection * norm(moved) && norm(moved) > 5e-4);
    ask(fmt::format("   Did it push {}, gently? [yes]", directions[axis]));
  }
}

bool Diagnosis::run(std::string& message)
{
  note(
    "Novint Falcon, checks with its owner. Nothing pushes with more than 0.5 N; Ctrl+C ends it at any time.");
  FalconDevice device(settings_);
  printNow(stdout, "Starting the Falcon; loading its firmware takes some seconds.\n");
  const Status status = device.open();
  if (status != Status::Ok)
  {
    message = openProblem(device, status, kFirmwareOption);
    note("NOT started: " + message);
    return false;
  }
  note("started" + (device.message().empty() ? "" : "; " + device.message()));
  PushPort port(device);
  ServoLoop loop;
  loop_ = &loop;
  if (loop.start(port, HapticParameters(), ServoSettings(), &message) != Status::Ok)
  {
    return false;
  }
  checkLeds(device);
  const bool homed = checkHoming(device);
  if (homed && !stopIsRequested())
  {
    checkEncoders(device);
  }
  if (homed && !stopIsRequested())
  {
    checkMotors(device, port);
  }
  if (!stopIsRequested())
  {
    checkRate(device, loop);
  }
  loop.stop();
  if (const std::string refusals = describeRefusals(loop.statistics()); !refusals.empty())
  {
    note(refusals);
  }
  device.close();
  if (stopIsRequested())
  {
    note("stopped on request: not all was checked");
  }
  return true;
}

} // namespace

bool diagnoseFalcon(
  const FalconOptions& options, const std::string& reportFile, bool yes, std::string& message)
{
  // The report is opened before anything moves: one that cannot be written is no use.
  std::ofstream file(reportFile);
  if (!file)
  {
    message = reportFile + ": cannot be written; name another file with --report";
    return false;
  }
  rememberStopSignals();
  Diagnosis diagnosis(options, yes, file);
  const bool done = diagnosis.run(message);
  file.close();
  if (!file)
  {
    message = reportFile + ": not all of it could be written; check the space left";
    return false;
  }
  printNow(stdout, fmt::format("\nreport: {}\n", reportFile));
  if (done && stopIsRequested())
  {
    message = "stopped on request; what was checked is in " + reportFile;
    return false;
  }
  if (done && diagnosis.problems() > 0)
  {
    message = fmt::format("{} checks found something wrong: see NOT in {}", diagnosis.problems(), reportFile);
    return false;
  }
  return done;
}

} // namespace pointhaptics::app
