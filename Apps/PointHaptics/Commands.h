/// @file
/// The commands of the program: each file adds one to the command line and runs it.
#pragma once

namespace CLI
{
class App;
}

namespace pointhaptics
{
namespace app
{

/// Exit codes of the program.
enum ExitCode : int
{
  kSuccess = 0,
  kFailed = 1,
  kUsage = 2, ///< beside these: stopExitCode() where a signal ended the work
};

/// Each adds its subcommand to @p program; its callback runs the command and stores an ExitCode in @p
/// exitCode, which must outlive the parsing.
void addViewCommand(CLI::App& program, int& exitCode);
void addFeelCommand(CLI::App& program, int& exitCode);
void addResampleCommand(CLI::App& program, int& exitCode);
void addBandwidthCommand(CLI::App& program, int& exitCode);
void addInfoCommand(CLI::App& program, int& exitCode);
void addGenerateCommand(CLI::App& program, int& exitCode);
void addDevicesCommand(CLI::App& program, int& exitCode);
/// Hidden: for the build.
void addManualCommand(CLI::App& program);
/// Only where the benchmarks are built (POINTHAPTICS_HAVE_BENCHMARKS).
void addBenchCommand(CLI::App& program, int& exitCode);

} // namespace app
} // namespace pointhaptics
