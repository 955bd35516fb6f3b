/// The program pointhaptics: one subcommand per task, `view` where none is named.
#include "Commands/Commands.h"
#include "Terminal/Messages.h"
#include "Terminal/StopSignals.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace
{

using namespace pointhaptics::app;

constexpr const char* kManualCommand = "manual";
const std::vector<std::string> kHelp = { "-h", "--help" };

struct NamedCommand
{
  const char* name;
  void (*add)(CLI::App& program, int& exitCode);
};

constexpr NamedCommand kCommands[] = { { "view", addViewCommand }, { "feel", addFeelCommand },
  { "compare", addCompareCommand }, { "resample", addResampleCommand }, { "bandwidth", addBandwidthCommand },
  { "convert", addConvertCommand }, { "info", addInfoCommand }, { "generate", addGenerateCommand },
  { "devices", addDevicesCommand }, { "bench", addBenchCommand }, { kManualCommand, addManualCommand } };

bool isOneOf(const std::vector<std::string>& words, const std::string& word)
{
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// `pointhaptics FILE...` and `pointhaptics --size 800x600 FILE` mean `pointhaptics view ...`.
/// False: the first word is neither a command nor a file; the usage error is printed.
bool insertDefaultCommand(std::vector<std::string>& arguments)
{
  std::vector<std::string> names;
  for (const NamedCommand& command : kCommands)
  {
    names.emplace_back(command.name);
  }
  if (arguments.empty())
  {
    failUsage("pointhaptics",
      fmt::format("nothing to do; name a file to view or a command ({})", fmt::join(names, ", ")));
    return false;
  }
  const std::string& first = arguments.front();
  if (isOneOf(names, first) || isOneOf(kHelp, first) || first == "--version")
  {
    return true;
  }
  std::error_code error;
  const bool isWord =
    first.find_first_of("./-") == std::string::npos && !std::filesystem::exists(first, error);
  if (isWord)
  {
    failUsage("pointhaptics",
      fmt::format("no command or file '{}'{}; commands are {}", first, didYouMean(first, names),
        fmt::join(names, ", ")));
    return false;
  }
  arguments.insert(arguments.begin(), "view");
  return true;
}

int run(std::vector<std::string> arguments)
{
  if (!insertDefaultCommand(arguments))
  {
    return kUsage;
  }
  CLI::App program("See and feel raw point clouds.\nWithout a command: view.", "pointhaptics");
  int exitCode = kSuccess;
  // The options of all commands take a tenth of the time of a start.
  const bool areAllShown = arguments.front() == kManualCommand || isOneOf(kHelp, arguments.front());
  for (const NamedCommand& command : kCommands)
  {
    if (areAllShown || arguments.front() == command.name)
    {
      command.add(program, exitCode);
    }
  }
  return runCommands(program, std::move(arguments), exitCode);
}

} // namespace

int main(int argc, char* argv[])
{
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  return runProgram(arguments, [&] { return run(arguments); });
}
