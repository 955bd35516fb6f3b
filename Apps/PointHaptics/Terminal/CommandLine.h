/// @file
/// Parses and runs the command lines of both programs.
#pragma once

#include "Options/Files.h"

#include <functional>
#include <set>
#include <string>
#include <vector>

namespace CLI
{
class App;
}

namespace pointhaptics::app
{

/// Exit codes of the programs.
enum ExitCode : int
{
  kSuccess = 0,
  kFailed = 1,
  kUsage = 2, ///< beside these: stopExitCode() where a signal ended the work, and fail()'s of a closed pipe
};

/// How a command runs once its options are parsed.
struct CommandRun
{
  /// Does the work. The files that the options name are taken and checked. @return an ExitCode.
  std::function<int(Files&)> run;
  /// Checks that need all options: ends in a usage error, or throws Failure.
  std::function<void()> complete = {};
  /// Adds the files that no option names, and says which outputs cannot be made again.
  std::function<void(Files&)> declare = {};
};

/// Makes @p command run so, and adds the options that every command has: --quiet and --verbose, and where it
/// has options for outputs (Files.h) --no-clobber --force and --dry-run too. To be called after all other
/// options are added.
/// @param exitCode where the run leaves its exit code; must outlive the parsing.
void runAs(CLI::App& command, int& exitCode, CommandRun run);
/// Adds --quiet and --verbose, and if @p writes the options about outputs.
void addCommonOptions(CLI::App& command, bool writes);
/// Names of the options that say how a run goes, not what it makes: they are in no configuration file.
const std::set<std::string>& commonOptions();

/// Runs what @p arguments (without the program's name) ask of @p program, which must name a command. Prints
/// help, version and usage errors. @param exitCode where the callbacks of the commands leave theirs. @return
/// an ExitCode, or stopExitCode().
int runCommands(CLI::App& program, std::vector<std::string> arguments, const int& exitCode);

/// Prints a usage error of @p command, "pointhaptics convert", in one line. @return kUsage.
int failUsage(const std::string& command, const std::string& message);

/// Calls @p run; what it throws, and a standard output that took not everything, become messages. To be
/// called once, by main(), with the words of the command line. @return the exit code.
int runProgram(const std::vector<std::string>& arguments, const std::function<int()>& run);

} // namespace pointhaptics::app
