/// The program pointhaptics-bench: one subcommand per task.
#include "Benchmark/Commands/BenchTask.h"
#include "Commands/Commands.h"
#include "Options/OptionParsing.h"
#include "Terminal/CommandLine.h"
#include "Terminal/Messages.h"
#include "ViewDisplay.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <thread>

#include <unistd.h>

namespace pointhaptics
{
namespace app
{
namespace
{

/// Every task there is.
std::vector<BenchTask> allTasks()
{
  return { bandwidthTask(), resampleTask(), proxyTask(), touchTask(), frictionTask(), ioTask(), servoTask(),
    renderTask() };
}

constexpr std::int64_t kMostRepetitions = 10000;
/// Stands in the report for the folder that was named: that one is nobody else's. Of files their names are
/// shown.
constexpr const char* kShownFolder = "Documentation";

struct BenchOptions
{
  std::vector<double> threads;
  std::int64_t repetitions = 0; ///< 0: the default.
  std::string folder;
  bool quick = false;
  bool json = false;
};

int numberOfCores()
{
  return int(std::max(1u, std::thread::hardware_concurrency()));
}

BenchSettings settingsOf(const BenchOptions& options)
{
  BenchSettings settings;
  settings.threads.assign(options.threads.begin(), options.threads.end());
  if (settings.threads.empty())
  {
    settings.threads = { 1 };
    if (numberOfCores() > 1)
    {
      settings.threads.push_back(numberOfCores());
    }
  }
  settings.repetitions = int(options.repetitions);
  settings.quick = options.quick;
  return settings;
}

/// Of files, one or several with commas between, their names.
std::string withoutFolders(const std::string& files)
{
  std::vector<std::string> names;
  for (const std::string& file : CLI::detail::split(files, ','))
  {
    names.push_back(std::filesystem::path(file).filename().string());
  }
  return fmt::format("{}", fmt::join(names, ","));
}

/// The command line that repeats the run.
std::string commandText(const CLI::App& command)
{
  std::string text = "pointhaptics-bench " + command.get_name();
  for (const CLI::Option* option : command.get_options())
  {
    const std::string name = option->get_name();
    if (option->count() == 0 || name == "--json")
    {
      continue;
    }
    text += " " + name;
    if (option->get_expected_max() > 0)
    {
      const std::string value = option->as<std::string>();
      text += " " +
        (name == "--output"                         ? kShownFolder
            : name == "--file" || name == "--scans" ? withoutFolders(value)
                                                    : value);
    }
  }
  return text;
}

/// Asked before the long work: can the folder be had, and pictures be drawn?
bool prepareFolder(
  const std::string& who, const std::string& folder, bool& withPictures, std::string& message)
{
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || ::access(folder.c_str(), W_OK) != 0)
  {
    message = folder + ": no folder that can be written; give one, or a name that one can be made under";
    return false;
  }
  std::string whyNot;
  withPictures = displayIsAvailable(whyNot);
  if (!withPictures)
  {
    warn(who, "the report goes without pictures: " + whyNot);
  }
  return true;
}

int runBench(const BenchRun& run, const BenchOptions& options, const CLI::App& command)
{
  const std::string who = command.get_name();
  std::string message;
  bool withPictures = false;
  if (!options.folder.empty() && !prepareFolder(who, options.folder, withPictures, message))
  {
    return fail(who, message);
  }
  const bool talks = isatty(STDERR_FILENO) != 0;
  const auto progress = [talks](const std::string& what)
  {
    if (talks)
    {
      fmt::print(stderr, "{}\n", what);
    }
  };
  BenchOutcome outcome = run(settingsOf(options), progress);
  if (outcome.report.parts.empty() && !outcome.wrong.empty())
  {
    return fail(who, outcome.wrong);
  }
  outcome.report.command = commandText(command);
  if (options.json)
  {
    printJson(bench::toJson(outcome.report));
  }
  else
  {
    fmt::print("{}", bench::toText(outcome.report));
  }
  if (!options.folder.empty() && !bench::writeReport(outcome.report, options.folder, withPictures, message))
  {
    return fail(who, message);
  }
  if (const std::vector<std::string> errors = takeVtkErrors(); !errors.empty())
  {
    return fail(who, errors.front());
  }
  return outcome.wrong.empty() ? kSuccess : fail(who, outcome.wrong);
}

void addTask(CLI::App& bench, const BenchTask& task, int& exitCode)
{
  CLI::App* command = bench.add_subcommand(task.name, task.description);
  auto options = std::make_shared<BenchOptions>();
  if (task.hasThreads)
  {
    addWholeNumbers(*command, "--threads", options->threads, numberOfCores(),
      "Numbers of threads; default one, and all cores");
  }
  addInteger(*command, "--repetitions", options->repetitions, 1, kMostRepetitions,
    fmt::format("Rounds in which each contestant runs once; default {}", task.repetitions));
  const BenchRun run = task.addOptions(*command);
  command->add_flag("--quick", options->quick, "A second or two, to see that everything works");
  command->add_flag("--json", options->json, "Print the figures as JSON");
  command
    ->add_option("-o,--output", options->folder,
      "Folder for Performance.md, Accuracy.md and Images/*.png; a section already there is replaced")
    ->type_name("FOLDER");
  command->callback([run, options, command, &exitCode] { exitCode = runBench(run, *options, *command); });
}

} // namespace

void addChoices(CLI::App& command, BenchChoices& choices, const std::vector<std::string>& rivalWords,
  const std::vector<std::string>& studyWords)
{
  choices.rivals = rivalWords;
  addWords(command, "--rivals", choices.rivals, rivalWords, true,
    "Who runs beside ours, or none; default all that were found");
  addWords(command, "--studies", choices.studies, studyWords, false, "What to measure; default all");
}

} // namespace app
} // namespace pointhaptics

namespace
{

using namespace pointhaptics::app;

int run(std::vector<std::string> arguments)
{
  CLI::App program("Measure PointHaptics beside others, and against exact answers.", "pointhaptics-bench");
  int exitCode = kSuccess;
  std::vector<std::string> names;
  for (const BenchTask& task : allTasks())
  {
    addTask(program, task, exitCode);
    names.push_back(task.name);
  }
  addManPage(program);
  if (arguments.empty() ||
    (arguments.front() != "manual" && arguments.front().rfind("-", 0) != 0 &&
      std::find(names.begin(), names.end(), arguments.front()) == names.end()))
  {
    const std::string what = arguments.empty() ? "name a task" : "no task '" + arguments.front() + "'";
    return failUsage("pointhaptics-bench",
      fmt::format("{}{}; tasks are {}", what, arguments.empty() ? "" : didYouMean(arguments.front(), names),
        fmt::join(names, ", ")));
  }
  return runCommands(program, std::move(arguments), exitCode);
}

} // namespace

int main(int argc, char* argv[])
{
  nameProgram("pointhaptics-bench");
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  return runProgram(arguments, [&] { return run(arguments); });
}
