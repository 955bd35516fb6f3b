#include "Terminal/CommandLine.h"

#include "Terminal/Messages.h"
#include "Terminal/StopSignals.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <system_error>
#include <vector>

namespace pointhaptics
{
namespace app
{
namespace
{

/// Which of @p words that are no option is a file that is there; empty: none.
std::string fileLikeAnOption(const std::vector<std::string>& words)
{
  const auto found = std::find_if(words.begin(), words.end(),
    [](const std::string& word)
    {
      std::error_code ignored;
      return word.size() > 1 && word.front() == '-' && std::filesystem::exists(word, ignored);
    });
  return found == words.end() ? std::string() : *found;
}

/// CLI11's wording for the user, in one line.
std::string usageMessage(const CLI::App& program, const CLI::ParseError& error)
{
  // In the order in which they were given; the message has them from the last to the first.
  const std::vector<std::string> words = program.remaining(true);
  if (const std::string file = fileLikeAnOption(words); !file.empty())
  {
    return fmt::format("{}: begins with - as options do; give the file as ./{}", file, file);
  }
  if (dynamic_cast<const CLI::ExtrasError*>(&error) && !words.empty())
  {
    return fmt::format("unexpected argument{} {}", words.size() > 1 ? "s" : "", fmt::join(words, " "));
  }
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
  std::string command = program.get_name();
  for (const CLI::App* app = &program; !app->get_subcommands().empty();)
  {
    app = app->get_subcommands().front();
    command += " " + app->get_name();
  }
  fmt::print(stderr, "{}: {}; see {} --help\n", command, usageMessage(program, error), command);
  return kUsage;
}

/// To @p command and all below it, but where another program looks at the options.
void addVersionFlags(CLI::App& command, const std::string& version)
{
  if (command.get_prefix_command())
  {
    return;
  }
  command.set_version_flag("--version", version, "Print the version and exit");
  for (CLI::App* below : command.get_subcommands([](CLI::App*) { return true; }))
  {
    addVersionFlags(*below, version);
  }
}

} // namespace

int runCommands(CLI::App& program, std::vector<std::string> arguments, const int& exitCode)
{
  program.require_subcommand(1);
  addVersionFlags(program, program.get_name() + " " POINTHAPTICS_VERSION);
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

int runProgram(const std::string& command, const std::function<int()>& run)
{
  collectVtkMessages();
  try
  {
    const int exitCode = run();
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

} // namespace app
} // namespace pointhaptics
