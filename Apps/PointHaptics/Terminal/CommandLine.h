/// @file
/// Parses and runs the command lines of both programs.
#pragma once

#include "Options/Files.h"

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace pointhaptics::app
{

/// A command of a program; the options are its members.
class Command
{
public:
  virtual ~Command() = default;
  /// Adds the options to @p command; bad values end the parse with a usage error.
  virtual void addTo(CLI::App& command) = 0;
  /// Checks that need all options, adds files that no option names, and says which outputs cannot be made
  /// again: ends in a usage error, or throws Failure.
  virtual void complete(CLI::App&, Files&) {}
  /// Does the work. The files that the options name are taken and checked. @return an ExitCode.
  virtual int run(Files& files) = 0;
};

/// Adds @p work to @p program with the options that every command has: --quiet and --verbose, and where it
/// has options for outputs (Files.h) --no-clobber --force and --dry-run too.
/// @param exitCode where the run leaves its exit code; must outlive the parsing.
void addCommand(
  CLI::App& program, int& exitCode, const char* name, const char* description, std::shared_ptr<Command> work);
/// Adds --quiet and --verbose, and if @p writes the options about outputs.
void addCommonOptions(CLI::App& command, bool writes);
/// Names of the options that say how a run goes, not what it makes: they are in no configuration file.
const std::set<std::string>& commonOptions();

/// Runs what @p arguments (without the program's name) ask of @p program, which must name a command: the
/// first word, one of @p names, or of its own commands where these are empty. Prints help, version and usage
/// errors.
/// @param exitCode where the callbacks of the commands leave theirs. @return an ExitCode, or stopExitCode().
int runCommands(CLI::App& program, std::vector<std::string> arguments, const int& exitCode,
  std::vector<std::string> names = {});

/// Calls @p run; what it throws, and a standard output that took not everything, become messages. To be
/// called once, by main(), with the words of the command line. @return the exit code.
int runProgram(const std::vector<std::string>& arguments, const std::function<int()>& run);

} // namespace pointhaptics::app
