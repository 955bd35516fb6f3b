/// @file
/// The commands of the program: each file adds one to the command line and runs it.
#pragma once

#include "Terminal/CommandLine.h"

namespace CLI
{
class App;
}

namespace pointhaptics::app
{

/// Each adds its subcommand to @p program; its callback runs the command and stores an ExitCode in @p
/// exitCode, which must outlive the parsing.
void addViewCommand(CLI::App& program, int& exitCode);
void addFeelCommand(CLI::App& program, int& exitCode);
void addCompareCommand(CLI::App& program, int& exitCode);
void addResampleCommand(CLI::App& program, int& exitCode);
void addBandwidthCommand(CLI::App& program, int& exitCode);
void addConvertCommand(CLI::App& program, int& exitCode);
void addInfoCommand(CLI::App& program, int& exitCode);
void addGenerateCommand(CLI::App& program, int& exitCode);
void addDevicesCommand(CLI::App& program, int& exitCode);
/// Adds a hidden command for the build.
void addManualCommand(CLI::App& program, int& exitCode);
/// Adds a hidden command to a program beside pointhaptics, which prints its man page for the build.
void addManPage(CLI::App& program);
/// Adds a command that runs the program pointhaptics-bench, where it is installed.
void addBenchCommand(CLI::App& program, int& exitCode);

} // namespace pointhaptics::app
