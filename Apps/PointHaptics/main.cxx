/// The program pointhaptics: one subcommand per task, `view` where none is named.
#include "Commands.h"
#include "Messages.h"
#include "StopSignals.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
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
    fmt::print(stderr,
      "pointhaptics: nothing to do; name a file to view or a command ({}), or see pointhaptics --help\n",
      fmt::join(names, ", "));
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
    fmt::print(stderr, "pointhaptics: no command or file '{}'; commands are {}, see pointhaptics --help\n",
      first, fmt::join(names, ", "));
    return false;
  }
  arguments.insert(arguments.begin(), "view");
  return true;
}

/// CLI11's wording for the user, in one line.
std::string usageMessage(const CLI::ParseError& error)
{
  std::string message = error.what();
  std::replace(message.begin(), message.end(), '\n', ' ');
  if (const std::string extras = "arguments were not expected: "; message.find(extras) != std::string::npos)
  {
    return "unexpected arguments " + message.substr(message.find(extras) + extras.size());
  }
  if (const std::string extra = "argument was not expected: "; message.find(extra) != std::string::npos)
  {
    return "unexpected argument " + message.substr(message.find(extra) + extra.size());
  }
  return message;
}

int reportUsage(const CLI::App& program, const CLI::ParseError& error)
{
  std::string command;
  for (const CLI::App* app = &program; !app->get_subcommands().empty();)
  {
    app = app->get_subcommands().front();
    command += " " + app->get_name();
  }
  fmt::print(
    stderr, "pointhaptics{}: {}; see pointhaptics{} --help\n", command, usageMessage(error), command);
  return kUsage;
}

/// To @p command and all below it.
void addVersionFlags(CLI::App& command)
{
  command.set_version_flag("--version", "pointhaptics " POINTHAPTICS_VERSION, "Print the version and exit");
  for (CLI::App* below : command.get_subcommands([](CLI::App*) { return true; }))
  {
    addVersionFlags(*below);
  }
}

int run(std::vector<std::string> arguments)
{
  CLI::App program("See and feel raw point clouds.\nWithout a command: view.", "pointhaptics");
  int exitCode = kSuccess;
  addViewCommand(program, exitCode);
  addFeelCommand(program, exitCode);
  addResampleCommand(program, exitCode);
  addBandwidthCommand(program, exitCode);
  addInfoCommand(program, exitCode);
  addGenerateCommand(program, exitCode);
  addDevicesCommand(program, exitCode);
#ifdef POINTHAPTICS_HAVE_BENCHMARKS
  addBenchCommand(program, exitCode);
#endif
  addManualCommand(program);
  program.require_subcommand(1);
  addVersionFlags(program);
  if (!insertDefaultCommand(program, arguments))
  {
    return kUsage;
  }
  std::reverse(arguments.begin(), arguments.end()); // as CLI11 wants them
  try
  {
    program.parse(std::move(arguments));
  }
  catch (const CLI::CallForHelp& help)
  {
    return program.exit(help);
  }
  catch (const CLI::CallForVersion& asked)
  {
    return program.exit(asked);
  }
  catch (const CLI::ParseError& error)
  {
    return reportUsage(program, error);
  }
  return exitCode == kFailed && stopIsRequested() ? stopExitCode() : exitCode;
}

} // namespace

int main(int argc, char* argv[])
{
  collectVtkMessages();
  const std::string command = argc > 1 ? argv[1] : "";
  try
  {
    const int exitCode = run(std::vector<std::string>(argv + 1, argv + argc));
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) // all of it, from the first line on
    {
      return fail(command, "the standard output cannot be written; check the space left, and who reads it");
    }
    return exitCode;
  }
  catch (const std::bad_alloc&)
  {
    return fail(command, "not enough memory; give fewer points or larger voxels");
  }
  catch (const std::exception& error)
  {
    return fail(command, error.what());
  }
}
