#include "Commands/FalconDiagnosis.h"

#include "Options/SharedOptions.h"
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

class Diagnosis
{
public:
  /// With little force, and none before it is homed.
  Diagnosis(const FalconSettings& settings, bool yes, std::ostream& report)
    : settings_(gentle(settings))
    , yes_(yes)
    , report_(report)
  {
  }

  void run();
  int problems() const noexcept { return problems_; }

private:
  static FalconSettings gentle(FalconSettings settings)
  {
    settings.limits.maximumForce = std::min(settings.limits.maximumForce, kTinyForce);
    return settings;
  }
  void note(const std::string& line)
  {
    printNow(stdout, line + "\n");
    report_ << line << std::endl; // what was found stays, whatever comes next
  }
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
  void checkLeds();
  bool checkHoming();
  void checkEncoders();
  void checkRate();
  void checkMotors();

  FalconSettings settings_;
  FalconDevice device_{ settings_ };
  PushPort port_{ device_ };
  bool yes_;
  std::ostream& report_;
  int problems_ = 0;
  ServoLoop loop_; // last: it uses the port
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
  printNow(stdout, question + (yes_ ? " \n" : " "));
  const std::string answer = yes_ ? std::string() : answerOfPerson();
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

void Diagnosis::checkLeds()
{
  note("\n1. LEDs");
  const std::pair<int, const char*> leds[] = { { kFalconLedGreen, "green" }, { kFalconLedBlue, "blue" },
    { kFalconLedRed, "red" } };
  for (const auto& [bit, name] : leds)
  {
    device_.showLeds(bit);
    wait(patience(kLedSeconds));
    ask(fmt::format("   Bit {} should be {}. Which LED is on? [{}]", bit, name, name));
  }
  device_.showLeds(-1);
}

bool Diagnosis::checkHoming()
{
  note("\n2. Homing");
  printNow(stdout,
    "   Pull the grip all the way out, then push it all the way in; do it again if nothing happens.\n");
  int last = -1;
  const bool homed = waitFor(
    [&]
    {
      const int bits = device_.raw().reply.homed;
      if (bits != last)
      {
        note(fmt::format("   homing bits {}{}{}", bits & 1, (bits >> 1) & 1, (bits >> 2) & 1));
        last = bits;
      }
      return device_.state() == FalconState::Homed;
    },
    patience(kLongestHoming));
  problems_ += homed ? 0 : 1;
  note(homed ? "   homed" : "   NOT homed: does the LED change while you move? Is bit 1 the homing bit?");
  return homed;
}

void Diagnosis::checkEncoders()
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
    const Vec3 from = loop_.latest().state.hip;
    const std::array<std::int16_t, 3> countsFrom = device_.raw().reply.encoders;
    ask(fmt::format("   Move it {} by about 2 cm, hold, press Enter.", directions[axis]));
    const Vec3 moved = loop_.latest().state.hip - from;
    const std::array<std::int16_t, 3> counts = device_.raw().reply.encoders;
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

void Diagnosis::checkRate()
{
  note("\n4. Rate");
  const FalconStatistics before = device_.statistics();
  const ServoStatistics servoBefore = loop_.statistics();
  wait(patience(kRateSeconds));
  const FalconStatistics after = device_.statistics();
  const ServoStatistics servo = loop_.statistics();
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

void Diagnosis::checkMotors()
{
  note(fmt::format("\n5. Motors, at most {} N", settings_.limits.maximumForce));
  ask("   Hold the grip loosely in the middle, then press Enter.");
  const char* const directions[] = { "to the right", "up", "towards you" };
  for (int axis = 0; axis < 3 && !stopIsRequested(); ++axis)
  {
    wait(kBackSeconds);
    const Vec3 from = loop_.latest().state.hip;
    Vec3 force;
    force[axis] = settings_.limits.maximumForce;
    port_.push(force);
    device_.setArmed(true);
    wait(std::max(patience(kPushSeconds), kShortestPush));
    const Vec3 moved = loop_.latest().state.hip - from;
    const std::array<std::int16_t, 3> motors = device_.raw().command.motors;
    device_.setArmed(false);
    port_.push(Vec3());
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

void Diagnosis::run()
{
  note(
    "Novint Falcon, checks with its owner. Nothing pushes with more than 0.5 N; Ctrl+C ends it at any time.");
  printNow(stdout, "Starting the Falcon; loading its firmware takes some seconds.\n");
  device_.setArmed(false);
  if (const Status status = device_.open(); status != Status::Ok)
  {
    const std::string problem = openProblem(device_, status, kFirmwareOption);
    note("NOT started: " + problem);
    throw Failure(problem);
  }
  note("started" + (device_.message().empty() ? "" : "; " + device_.message()));
  std::string problem;
  require(loop_.start(port_, HapticParameters(), ServoSettings(), &problem) == Status::Ok, problem);
  checkLeds();
  const bool homed = checkHoming();
  using Check = void (Diagnosis::*)();
  for (const Check check : { &Diagnosis::checkEncoders, &Diagnosis::checkMotors, &Diagnosis::checkRate })
  {
    if (!stopIsRequested() && (homed || check == &Diagnosis::checkRate))
    {
      (this->*check)();
    }
  }
  loop_.stop();
  if (const std::string refusals = describeRefusals(loop_.statistics()); !refusals.empty())
  {
    note(refusals);
  }
  device_.close();
  if (stopIsRequested())
  {
    note("stopped on request: not all was checked");
  }
}

} // namespace

void diagnoseFalcon(const FalconSettings& settings, const std::string& reportFile, bool yes)
{
  // The report is opened before anything moves: one that cannot be written is no use.
  std::ofstream file(reportFile);
  require(bool(file), reportFile + ": cannot be written; name another file with --report");
  rememberStopSignals();
  Diagnosis diagnosis(settings, yes, file);
  const auto end = [&]
  {
    file.close();
    require(bool(file), reportFile + ": not all of it could be written; check the space left");
    printNow(stdout, fmt::format("\nreport: {}\n", reportFile));
  };
  try
  {
    diagnosis.run();
  }
  catch (const Failure&)
  {
    end();
    throw;
  }
  end();
  require(!stopIsRequested(), "stopped on request; what was checked is in " + reportFile);
  require(diagnosis.problems() == 0,
    fmt::format("{} checks found something wrong: see NOT in {}", diagnosis.problems(), reportFile));
}

} // namespace pointhaptics::app
