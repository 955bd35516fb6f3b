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

std::vector<std::string> commandNames(const CLI::App& program)
{
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; }))
  {
    names.push_back(command->get_name());
  }
  return names;
}

bool isOneOf(const std::vector<std::string>& words, const std::string& word)
{
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// `pointhaptics FILE...` and `pointhaptics --size 800x600 FILE` mean `pointhaptics view ...`.
/// False: the first word is neither a command nor a file; the usage error is printed.
bool insertDefaultCommand(const CLI::App& program, std::vector<std::string>& arguments)
{
  const std::vector<std::string> names = commandNames(program);
  if (arguments.empty())
  {
    failUsage("pointhaptics",
      fmt::format("nothing to do; name a file to view or a command ({})", fmt::join(names, ", ")));
    return false;
  }
  const std::string& first = arguments.front();
  if (isOneOf(names, first) || isOneOf({ "-h", "--help", "--version" }, first))
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
  CLI::App program("See and feel raw point clouds.\nWithout a command: view.", "pointhaptics");
  int exitCode = kSuccess;
  addViewCommand(program, exitCode);
  addFeelCommand(program, exitCode);
  addCompareCommand(program, exitCode);
  addResampleCommand(program, exitCode);
  addBandwidthCommand(program, exitCode);
  addConvertCommand(program, exitCode);
  addInfoCommand(program, exitCode);
  addGenerateCommand(program, exitCode);
  addDevicesCommand(program, exitCode);
  addBenchCommand(program, exitCode);
  addManualCommand(program, exitCode);
  if (!insertDefaultCommand(program, arguments))
  {
    return kUsage;
  }
  return runCommands(program, std::move(arguments), exitCode);
}

} // namespace

int main(int argc, char* argv[])
{
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  return runProgram(arguments, [&] { return run(arguments); });
}
