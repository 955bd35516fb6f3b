#include "Benchmark/Servo/ServoBenchmark.h"

#include "Benchmark/Servo/RoundTrip.h"
#include "Benchmark/Servo/ServoRun.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace pointhaptics
{
namespace bench
{
namespace servo
{
namespace
{

/// 2 mm at 800 N/m are 1.6 N.
constexpr double kLargestError = 0.08;
constexpr double kLongestRoundTrip = 10.0; // seconds
/// Above this the machine has other things to do.
constexpr double kQuietLoad = 0.3;

std::string microseconds(double seconds)
{
  return brief(1e6 * seconds);
}

nlohmann::ordered_json toJson(const LatencyHistogram::Summary& s)
{
  return { { "p50", s.p50 }, { "p99", s.p99 }, { "p999", s.p999 }, { "max", s.maximum } };
}

std::string fourOf(const LatencyHistogram::Summary& s)
{
  return fmt::format("{} / {} / {} / {}", microseconds(s.p50), microseconds(s.p99), microseconds(s.p999),
    microseconds(s.maximum));
}

/// A row's place on one of the three axes, as the command line and the code call it.
template <class Value>
struct Choice
{
  const char* word;
  Value value;
};

constexpr Choice<Hand> kHands[] = { { "simulated", Hand::Simulated }, { "falcon", Hand::Falcon } };
constexpr Choice<Load> kLoads[] = { { "idle", Load::Idle }, { "busy", Load::Busy },
  { "drawing", Load::Rendering } };
constexpr Choice<double> kRates[] = { { "1000", 1000.0 }, { "10000", 10000.0 } };

template <class Value, std::size_t Count>
std::vector<std::string> wordsOf(const Choice<Value> (&choices)[Count])
{
  std::vector<std::string> words;
  for (const Choice<Value>& choice : choices)
  {
    words.emplace_back(choice.word);
  }
  return words;
}

bool isWanted(const char* word, const std::vector<std::string>& wanted)
{
  return wanted.empty() || std::find(wanted.begin(), wanted.end(), word) != wanted.end();
}

std::vector<Setting> settingsOf(const ServoBenchmarkOptions& options)
{
  std::vector<Setting> settings;
  for (const auto& hand : kHands)
  {
    for (const auto& load : kLoads)
    {
      for (const auto& rate : kRates)
      {
        const bool tooFast = rate.value > 1000.0 && hand.value == Hand::Falcon;
        const bool cannot = tooFast || (load.value == Load::Rendering && !options.draw);
        if (!cannot && isWanted(hand.word, options.hands) && isWanted(load.word, options.loads) &&
          isWanted(rate.word, options.rates))
        {
          settings.push_back({ hand.value, load.value, rate.value, options.seconds, options.draw });
        }
      }
    }
  }
  return settings;
}

bool addRow(const Setting& setting, const Outcome& outcome, ReportPart& part)
{
  const ServoStatistics& s = outcome.statistics;
  const bool right = outcome.contactFraction > 0.3 && outcome.largestError < kLargestError;
  const std::string load = setting.load == Load::Rendering
    ? fmt::format("{}, {:.0f} fps", name(setting.load), outcome.framesPerSecond)
    : name(setting.load);
  part.table.rows.push_back({ name(setting.hand), load, brief(setting.rateHz), fourOf(s.update),
    fourOf(s.jitter), grouped((long long)s.ticks), grouped((long long)s.deadlineMisses),
    outcome.empty ? grouped((long long)outcome.empty->deadlineMisses) : "", fmt::format("{:.1f}", s.rateHz),
    right ? "right" : "wrong" });
  part.rows.push_back({ { "hand", name(setting.hand) }, { "load", name(setting.load) },
    { "rate_hz", setting.rateHz }, { "step_seconds", toJson(s.update) },
    { "jitter_seconds", toJson(s.jitter) }, { "ticks", s.ticks }, { "deadline_misses", s.deadlineMisses },
    { "empty_loop",
      outcome.empty ? nlohmann::ordered_json{ { "deadline_misses", outcome.empty->deadlineMisses },
                        { "largest_jitter_seconds", outcome.empty->largestJitter } }
                    : nlohmann::ordered_json() },
    { "achieved_hz", s.rateHz }, { "real_time_priority", s.realtime }, { "memory_locked", s.memoryLocked },
    { "cores_awake", s.coresAwake }, { "frames_per_second", outcome.framesPerSecond },
    { "largest_force_error_n", outcome.largestError }, { "right", right } });
  return right;
}

std::string grant(const ServoStatistics& s)
{
  const auto word = [](bool granted) { return granted ? "granted" : "refused"; };
  return fmt::format("SCHED_FIFO was {}, locking the memory {}, keeping the cores awake {}.",
    word(s.realtime), word(s.memoryLocked), word(s.coresAwake));
}

} // namespace

std::vector<std::string> handWords()
{
  return wordsOf(kHands);
}

std::vector<std::string> loadWords()
{
  return wordsOf(kLoads);
}

std::vector<std::string> rateWords()
{
  return wordsOf(kRates);
}

namespace
{

/// A row for each setting; what the reader must know of the machine below them.
ReportPart loopStudy(const ServoBenchmarkOptions& options, const std::vector<Setting>& settings, double load,
  const Progress& progress, bool& allRight)
{
  ReportPart part;
  part.key = "loop";
  part.title = "Step time, jitter and deadline misses";
  part.text = fmt::format("{} points; {:g} s for each row.", grouped(options.points), options.seconds);
  part.table.header = { "hand", "machine", "Hz", "step us: p50 / p99 / p99.9 / max",
    "jitter us: p50 / p99 / p99.9 / max", "ticks", "deadline misses", "misses of an empty loop",
    "achieved Hz", "force" };
  const auto scene = sphereScene(options.points);
  allRight = scene != nullptr;
  ServoStatistics last;
  for (const Setting& setting : settings)
  {
    progress(fmt::format("{}, {}, {:g} Hz", name(setting.hand), name(setting.load), setting.rateHz));
    const Outcome outcome = run(setting, scene);
    allRight = addRow(setting, outcome, part) && allRight;
    last = outcome.statistics;
  }
  part.remarks.push_back(grant(last));
  if (load > kQuietLoad)
  {
    part.remarks.push_back(
      fmt::format("Other programs ran beside these (load {:.1f} before the run): jitter and "
                  "deadline misses are theirs too, and \"idle\" means idle as far as we were.",
        load));
  }
  if (!options.draw)
  {
    part.remarks.push_back("Without a display: the rows with drawing were left out.");
  }
  return part;
}

} // namespace

Report benchmarkServo(const ServoBenchmarkOptions& options, const Progress& progress, bool& allRight)
{
  Report report;
  report.task = "servo";
  report.title = "Servo loop";
  report.machine = thisMachine();
  report.method =
    "A hand presses up to 2 mm into a sphere and slides over it at 50 mm/s, in real time.\n"
    "\n"
    "- step: the whole tick, from reading the device, through scene and parameters, proxy and force\n"
    "  guard, to writing the device and the sample.\n"
    "- jitter: from the deadline to the first instruction of the tick. The thread wakes 0.1 ms, at\n"
    "  most half a period, before each deadline, prefetches the step and spins.\n"
    "- Percentiles are upper edges of bins that grow by 19 %; maxima are exact.\n"
    "- The Falcon's driver runs on a wire in memory: codec, kinematics and force chain are in its\n"
    "  step, USB is not.\n"
    "- drawing: the viewer's own scene of the cloud rotates, with its level of detail, 1280 x 720\n"
    "  pixels, at most 30 frames a second.\n"
    "- empty loop: on an idle machine a second loop keeps the same deadlines at the same priority on\n"
    "  another core. What it misses, the machine (its firmware, kernel or host) took from its\n"
    "  programs.";
  const std::vector<Setting> settings = settingsOf(options);
  if (settings.empty())
  {
    allRight = true;
    return report;
  }
  ReportPart part = loopStudy(options, settings, report.machine.load, progress, allRight);
  progress("round trip against an emulated Falcon");
  ReportPart roundTrip;
  const bool hasRoundTrip = roundTripStudy(std::min(options.seconds, kLongestRoundTrip), roundTrip, allRight);
  if (!hasRoundTrip)
  {
    part.remarks.push_back(
      fmt::format("The round trip against an emulated Falcon was left out: {}, which the tests build where "
                  "umockdev is found, is not beside this program.",
        kRoundTripProgram));
  }
  report.parts.push_back(std::move(part));
  if (hasRoundTrip)
  {
    report.parts.push_back(std::move(roundTrip));
  }
  return report;
}

} // namespace servo
} // namespace bench
} // namespace pointhaptics
