/// @file
/// A task of `pointhaptics bench`. What all tasks share (these options, running, printing, writing, errors)
/// is in BenchCommand.cxx; a task is a file Bench<Task>.cxx with the options of its own, and a line in the
/// list of BenchCommand.cxx. What it measures lies in a folder of Testing/Benchmark.
#pragma once

#include "Benchmark/Report/Report.h"

#include <functional>
#include <string>
#include <vector>

namespace CLI
{
class App;
}

namespace pointhaptics
{
namespace app
{

/// The options that every task has.
struct BenchSettings
{
  std::vector<int> threads; ///< Ascending, each once; where none were given one, and all cores.
  int repetitions = 0;      ///< 0: the task's default, or fewer where quick.
  bool quick = false;       ///< A second or two, to see that everything works.
};

struct BenchOutcome
{
  bench::Report report; ///< Without its command, which is filled in afterwards.
  std::string wrong;    ///< Which answer of ours is wrong and where to look; empty: none is. With a report
                        ///< without parts: why nothing could be measured.
};

/// The options --rivals and --studies, of tasks that run beside other libraries and in several studies.
struct BenchChoices
{
  std::vector<std::string> rivals;  ///< All that were built, until some are asked for.
  std::vector<std::string> studies; ///< Empty: all.
};

/// Adds both options, with the task's words. @p choices must outlive the parsing.
void addChoices(CLI::App& command, BenchChoices& choices, const std::vector<std::string>& rivalWords,
  const std::vector<std::string>& studyWords);

/// Puts what was chosen, and what all tasks share, into a task's settings after its own.
template <class Settings>
void takeChoices(Settings& settings, const BenchChoices& choices, const BenchSettings& shared)
{
  settings.rivals = choices.rivals;
  settings.studies = choices.studies;
  settings.repetitions = shared.repetitions > 0 ? shared.repetitions : settings.repetitions;
}

/// Measures. Called once, after the command line was parsed.
using BenchRun = std::function<BenchOutcome(const BenchSettings& settings, const bench::Progress& progress)>;

struct BenchTask
{
  std::string name;        ///< On the command line: one word.
  std::string description; ///< In the help, without a full stop.
  int repetitions = 15;    ///< The default, as the help says it.
  bool hasThreads = true;  ///< Whether --threads means anything to it.
  /// Adds the task's own options and returns what runs it with them.
  std::function<BenchRun(CLI::App& command)> addOptions;
};

BenchTask bandwidthTask();
BenchTask ioTask();
BenchTask resampleTask();
BenchTask proxyTask();
BenchTask touchTask();
BenchTask frictionTask();
BenchTask renderTask();
BenchTask servoTask();

} // namespace app
} // namespace pointhaptics
