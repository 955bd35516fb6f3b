/// The program pointhaptics-bench: one subcommand per task, which prints JSON rows.
#include "Benchmark/Harness/Instructions.h"
#include "Benchmark/Harness/Machine.h"
#include "Benchmark/Tasks.h"
#include "Commands/Commands.h"
#include "Options/OptionParsing.h"
#include "Terminal/CommandLine.h"
#include "Terminal/LargePages.h"
#include "Terminal/Messages.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <thread>

#include <unistd.h>

namespace pointhaptics::bench
{
namespace
{

using namespace app;

std::vector<Task> allTasks()
{
  return { bandwidthTask(), resampleTask(), proxyTask(), touchTask(), frictionTask(), ioTask(), servoTask(),
    renderTask() };
}

constexpr std::int64_t kMostRepetitions = 10000;
constexpr const char* kFiles = "FILE,...";

int numberOfCores()
{
  return int(std::max(1u, std::thread::hardware_concurrency()));
}

/// The command line that repeats the run. Files go without their folders, which are nobody else's.
std::string commandText(const CLI::App& command)
{
  std::string text = "pointhaptics bench " + command.get_name();
  for (const CLI::Option* option : command.get_options())
  {
    if (option->count() == 0 || option->get_name() == "--json")
    {
      continue;
    }
    text += " " + option->get_name();
    if (option->get_expected_max() > 0)
    {
      std::vector<std::string> words = CLI::detail::split(option->as<std::string>(), ',');
      for (std::string& word : words)
      {
        word = option->get_type_name().rfind("FILE", 0) == 0 ? std::filesystem::path(word).filename().string()
                                                             : word;
      }
      text += fmt::format(" {}", fmt::join(words, ","));
    }
  }
  return text;
}

struct Options
{
  std::vector<double> threads;
  std::int64_t repetitions = 0; ///< 0: the task's.
  bool json = false;
  Run run;
};

void printLine(const Json& line)
{
  fmt::print("{}\n", jsonText(line));
  std::fflush(stdout);
}

int runTask(const Task& task, const TaskRun& measure, Options& options, const CLI::App& command)
{
  Run& run = options.run;
  run.threads.assign(options.threads.begin(), options.threads.end());
  if (run.threads.empty())
  {
    run.threads = numberOfCores() > 1 ? std::vector<int>{ 1, numberOfCores() } : std::vector<int>{ 1 };
  }
  run.repetitions = options.repetitions > 0 ? int(options.repetitions)
    : run.quick                             ? task.quickRepetitions
                                            : task.repetitions;
  if (isatty(STDERR_FILENO) != 0)
  {
    run.progress = [](const std::string& what) { fmt::print(stderr, "{}\n", what); };
  }
  Json head{ { "task", task.name }, { "command", commandText(command) }, { "machine", thisMachine() } };
  if (!options.json)
  {
    run.print = [&head](const Json& line)
    {
      if (!head.empty())
      {
        printLine(head);
        head.clear();
      }
      printLine(line);
    };
  }
  measure(run);
  if (options.json && !run.parts().empty())
  {
    head.update(run.parts());
    printJson(head);
  }
  const std::vector<std::string> errors = takeVtkErrors();
  const std::string& wrong = errors.empty() ? run.faults() : errors.front();
  return wrong.empty() ? kSuccess : fail(wrong);
}

void addTask(CLI::App& program, const Task& task, int& exitCode)
{
  CLI::App* command = program.add_subcommand(task.name, task.description);
  auto options = std::make_shared<Options>();
  options->run.rivals = task.rivals;
  if (task.hasThreads)
  {
    addWholeNumbers(*command, "--threads", options->threads, numberOfCores(),
      "Numbers of threads; default one, and all cores");
  }
  if (task.repetitions > 0)
  {
    addInteger(*command, "--repetitions", options->repetitions, 1, kMostRepetitions,
      fmt::format("How often each contestant runs, in turn with the others; default {}", task.repetitions));
  }
  const TaskRun measure = task.addOptions(*command);
  if (!task.rivals.empty())
  {
    addWords(*command, "--rivals", options->run.rivals, task.rivals, true,
      "Who runs beside ours, or none; default all that were found");
  }
  if (task.studies.size() > 1)
  {
    addWords(*command, "--studies", options->run.studies, task.studies, false,
      task.name == "touch" ? "What to measure; default all but hard" : "What to measure; default all");
  }
  command->add_flag("--quick", options->run.quick, "A second or two, to see that everything works");
  command->add_flag(
    "--json", options->json, "Print one JSON document at the end in the place of a row a line");
  command->callback(
    [task, measure, options, command, &exitCode]
    {
      nameCommand(task.name);
      exitCode = runTask(task, measure, *options, *command);
    });
}

} // namespace

void addFiles(
  CLI::App& command, const std::string& name, std::vector<std::string>& files, const std::string& description)
{
  command
    .add_option_function<std::string>(
      name, [&files](const std::string& text) { files = CLI::detail::split(text, ','); }, description)
    ->type_name(kFiles);
}

void addWholeNumbers(CLI::App& command, const std::string& name, std::vector<double>& values, double maximum,
  const std::string& description)
{
  const auto store = [&values, maximum, name](const std::string& text)
  {
    const auto isFit = [maximum](double x) { return x == std::floor(x) && x >= 1.0 && x <= maximum; };
    const bool areFit = parseNumbers(text, values) && std::all_of(values.begin(), values.end(), isFit);
    requireUsage(
      areFit, name, text, fmt::format("give whole numbers from 1 to {:.0f}, separated by commas", maximum));
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
  };
  command.add_option_function<std::string>(name, store, description)->type_name("N,...");
}

void addInstructions(CLI::App& command, int& set)
{
  std::vector<std::pair<std::string, int>> sets;
  for (const NamedInstructionSet& one : kInstructionSets)
  {
    if (hasInstructions(one.set))
    {
      sets.emplace_back(one.word, int(one.set));
    }
  }
  addChoice(command, "--instructions", set, std::move(sets),
    "Hold the inner loops to this instruction set; default the best of the machine");
}

/// The whole program. @return an ExitCode.
int runBench(std::vector<std::string> arguments)
{
  CLI::App program(
    "Measure PointHaptics beside others, and against exact answers. Each task prints a JSON row a "
    "line; Documentation/MakeTables.py makes tables and pictures of them.",
    "pointhaptics-bench");
  int exitCode = kSuccess;
  for (const Task& task : allTasks())
  {
    addTask(program, task, exitCode);
  }
  addManPage(program);
  return runCommands(program, std::move(arguments), exitCode);
}

} // namespace pointhaptics::bench

int main(int argc, char* argv[])
{
  if (argc > 1 && std::string(argv[1]) == "touch")
  {
    pointhaptics::app::beginWithLargePages(argv); // scenes are built as the view does
  }
  pointhaptics::app::nameProgram("pointhaptics-bench");
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  return pointhaptics::app::runProgram(arguments, [&] { return pointhaptics::bench::runBench(arguments); });
}
