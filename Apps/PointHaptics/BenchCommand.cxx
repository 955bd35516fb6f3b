#include "Commands.h"

#include "Messages.h"
#include "OptionParsing.h"
#include "ViewDisplay.h"

#include "Benchmark/Resample/ResampleBenchmark.h"
#include "Benchmark/Resample/Rival.h"

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

namespace pointhaptics
{
namespace app
{
namespace
{

constexpr const char* kCommand = "bench resample";
constexpr double kMostPoints = 1e8;
constexpr double kMostVoxels = 2097152;
constexpr std::int64_t kMostRepetitions = 10000;
/// Stands in the report for the folder that was named: that one is nobody else's.
constexpr const char* kShownFolder = "Documentation";

struct BenchOptions
{
  std::vector<double> points;
  std::vector<double> dimensions;
  std::vector<double> threads;
  std::vector<std::string> rivals;
  std::vector<std::string> studies;
  std::int64_t repetitions = 0; ///< 0: the default.
  std::string folder;
  bool quick = false;
  bool json = false;
  bool rivalsAreGiven = false;
};

int numberOfCores()
{
  return int(std::max(1u, std::thread::hardware_concurrency()));
}

/// A comma-separated list of whole numbers from 1 to @p maximum, sorted, each once.
void addWholeNumbers(CLI::App& command, const std::string& name, std::vector<double>& values, double maximum,
  const std::string& description)
{
  const auto store = [&values, maximum, name](const std::string& text)
  {
    const auto isFit = [maximum](double x) { return x == std::floor(x) && x >= 1.0 && x <= maximum; };
    if (!parseNumbers(text, values) || !std::all_of(values.begin(), values.end(), isFit))
    {
      throwUsage(
        name, text, fmt::format("give whole numbers from 1 to {:.0f}, separated by commas", maximum));
    }
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
  };
  command.add_option_function<std::string>(name, store, description)->type_name("N,...");
}

/// A comma-separated list of some of @p words; "none" where @p mayBeNone gives an empty one.
void addWords(CLI::App& command, const std::string& name, std::vector<std::string>& values,
  const std::vector<std::string>& words, bool mayBeNone, const std::string& description)
{
  const auto store = [&values, words, mayBeNone, name](const std::string& text)
  {
    values.clear();
    for (const std::string& word : CLI::detail::split(mayBeNone && text == "none" ? "" : text, ','))
    {
      if (word.empty() && mayBeNone)
      {
        continue;
      }
      if (std::find(words.begin(), words.end(), word) == words.end())
      {
        throwUsage(name, text, fmt::format("no such choice; give some of {}", fmt::join(words, ",")));
      }
      values.push_back(word);
    }
  };
  command.add_option_function<std::string>(name, store, description)
    ->type_name(fmt::format("{}", fmt::join(words, ",")));
}

bench::ResampleBenchmarkOptions settingsOf(const BenchOptions& options)
{
  bench::ResampleBenchmarkOptions settings;
  if (options.quick)
  {
    settings.makeQuick();
  }
  const auto take = [](const std::vector<double>& from, auto& to)
  {
    if (!from.empty())
    {
      to.assign(from.begin(), from.end());
    }
  };
  settings.threads = { 1 };
  if (numberOfCores() > 1)
  {
    settings.threads.push_back(numberOfCores());
  }
  take(options.points, settings.points);
  take(options.dimensions, settings.dimensions);
  take(options.threads, settings.threads);
  settings.rivals = options.rivalsAreGiven ? options.rivals : bench::rivalWords();
  settings.studies = options.studies;
  if (options.repetitions > 0)
  {
    settings.repetitions = int(options.repetitions);
  }
  return settings;
}

/// The command line that repeats the run.
std::string commandText(const CLI::App& command)
{
  std::string text = "pointhaptics bench resample";
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
      text += " " + (name == "--output" ? kShownFolder : option->as<std::string>());
    }
  }
  return text;
}

/// Asked before the long work: can the folder be had, and pictures be drawn?
bool prepareFolder(const BenchOptions& options, bool& withPictures, std::string& message)
{
  std::error_code error;
  std::filesystem::create_directories(options.folder, error);
  if (error || ::access(options.folder.c_str(), W_OK) != 0)
  {
    message =
      options.folder + ": no folder that can be written; give one, or a name that one can be made under";
    return false;
  }
  std::string whyNot;
  withPictures = displayIsAvailable(whyNot);
  if (!withPictures)
  {
    warn(kCommand, "the report goes without pictures: " + whyNot);
  }
  return true;
}

int runBench(const BenchOptions& options, const std::string& command)
{
  std::string message;
  bool withPictures = false;
  if (!options.folder.empty() && !prepareFolder(options, withPictures, message))
  {
    return fail(kCommand, message);
  }
  const bool talks = isatty(STDERR_FILENO) != 0;
  const auto progress = [talks](const std::string& what)
  {
    if (talks)
    {
      fmt::print(stderr, "{}\n", what);
    }
  };
  bool allRight = false;
  bench::Report report = bench::benchmarkResample(settingsOf(options), progress, allRight);
  report.command = command;
  if (options.json)
  {
    printJson(bench::toJson(report));
  }
  else
  {
    fmt::print("{}", bench::toText(report));
  }
  if (!options.folder.empty() && !bench::writeReport(report, options.folder, withPictures, message))
  {
    return fail(kCommand, message);
  }
  if (const std::vector<std::string> errors = takeVtkErrors(); !errors.empty())
  {
    return fail(kCommand, errors.front());
  }
  return allRight
    ? kSuccess
    : fail(kCommand, "an answer of vtkVoxelMeanResampler is wrong; look for \"wrong\" in the tables");
}

} // namespace

void addBenchCommand(CLI::App& program, int& exitCode)
{
  CLI::App* bench = program.add_subcommand("bench", "Measure this program beside others");
  bench->callback(
    [bench]
    {
      if (bench->get_subcommands().empty())
      {
        throw CLI::ParseError("name a task: resample", CLI::ExitCodes::RequiredError);
      }
    });
  CLI::App* command = bench->add_subcommand(
    "resample", "Time mean resampling: ours, PCL's, VTK's, Open3D's; answers checked first");
  auto options = std::make_shared<BenchOptions>();
  addWholeNumbers(
    *command, "--points", options->points, kMostPoints, "Numbers of points; default 1e4,1e5,543652,1e6,5e6");
  addWholeNumbers(*command, "--dims", options->dimensions, kMostVoxels,
    "Voxels on an axis, for the study of voxel size; default 75,150,300,600,1200,4096");
  addWholeNumbers(*command, "--threads", options->threads, numberOfCores(),
    "Numbers of threads; default one, and all cores");
  addInteger(*command, "--repetitions", options->repetitions, 1, kMostRepetitions,
    "Rounds in which each contestant runs once; default 15");
  addWords(*command, "--rivals", options->rivals, bench::rivalWords(), true,
    "Who runs beside ours, or none; default all that were found");
  addWords(
    *command, "--studies", options->studies, bench::studyWords(), false, "What to measure; default all");
  command->add_flag("--quick", options->quick, "A second or two, to see that everything works");
  command->add_flag("--json", options->json, "Print the figures as JSON");
  command
    ->add_option("-o,--output", options->folder,
      "Folder for Performance.md and Images/*.png; a section already there is replaced")
    ->type_name("FOLDER");
  command->callback(
    [options, command, &exitCode]
    {
      options->rivalsAreGiven = command->get_option("--rivals")->count() > 0;
      exitCode = runBench(*options, commandText(*command));
    });
}

} // namespace app
} // namespace pointhaptics
