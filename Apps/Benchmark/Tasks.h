/// @file
/// The tasks of pointhaptics-bench: each is a file of its folder with its options and its studies.
#pragma once

#include "Benchmark/Harness/Run.h"

#include <functional>
#include <string>
#include <vector>

namespace CLI
{
class App;
}

namespace pointhaptics::bench
{

/// Measures. Called once, after the command line was parsed.
using TaskRun = std::function<void(Run& run)>;

struct Task
{
  std::string name;                 ///< On the command line: one word.
  std::string description;          ///< In the help, without a full stop.
  int repetitions = 15;             ///< The default; 0: there is no such option.
  int quickRepetitions = 3;         ///< The default with --quick.
  bool hasThreads = false;          ///< Whether --threads means anything to it.
  std::vector<std::string> studies; ///< For --studies; with one there is no such option.
  std::vector<std::string> rivals;  ///< For --rivals: those that were built; empty: there is no such option.
  /// Adds the options of the task alone and returns what runs it with them.
  std::function<TaskRun(CLI::App& command)> addOptions;
};

Task bandwidthTask();
Task frictionTask();
Task ioTask();
Task proxyTask();
Task renderTask();
Task resampleTask();
Task servoTask();
Task touchTask();

/// Adds an option of file names with commas between.
void addFiles(CLI::App& command, const std::string& name, std::vector<std::string>& files,
  const std::string& description);
/// Adds an option taking comma-separated whole numbers from 1 to @p maximum; stored ascending, each once.
void addWholeNumbers(CLI::App& command, const std::string& name, std::vector<double>& values, double maximum,
  const std::string& description);
/// Adds --instructions, which names an InstructionSet by its number.
void addInstructions(CLI::App& command, int& set);

} // namespace pointhaptics::bench
