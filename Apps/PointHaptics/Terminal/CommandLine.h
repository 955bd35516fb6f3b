/// @file
/// What the main functions of both programs do with a command line.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI
{
class App;
}

namespace pointhaptics
{
namespace app
{

/// Exit codes of the programs.
enum ExitCode : int
{
  kSuccess = 0,
  kFailed = 1,
  kUsage = 2, ///< beside these: stopExitCode() where a signal ended the work
};

/// Runs what @p arguments (without the program's name) ask of @p program, which must name a command. Prints
/// help, version and usage errors. @param exitCode where the callbacks of the commands leave theirs. @return
/// an ExitCode, or stopExitCode().
int runCommands(CLI::App& program, std::vector<std::string> arguments, const int& exitCode);

/// Calls @p run; what it throws, and a standard output that took not everything, become messages. @param
/// command as fail() wants it. To be called once, by main(). @return the exit code.
int runProgram(const std::string& command, const std::function<int()>& run);

} // namespace app
} // namespace pointhaptics
