/// @file
/// The commands of the program. Those that draw or feel are in a library of their own, as they take most of
/// the time of a start: it is loaded where it is needed, and they are looked up by these names.
#pragma once

#include "Terminal/CommandLine.h"

#include <string>

namespace pointhaptics::app
{

///@{
/// Each makes a command, which the caller owns.
extern "C" Command* viewCommand();
extern "C" Command* feelCommand();
extern "C" Command* compareCommand();
/// A hidden command for the build.
extern "C" Command* manualCommand();
Command* resampleCommand();
Command* bandwidthCommand();
Command* convertCommand();
Command* infoCommand();
Command* generateCommand();
Command* devicesCommand();
/// Runs the program pointhaptics-bench, where it is installed.
Command* benchCommand();
///@}

/// The whole program, as main() would be. @return its exit code.
extern "C" int runPointHaptics(int argc, char* argv[]);

/// Adds a hidden command to a program beside pointhaptics, which prints its man page for the build.
void addManPage(CLI::App& program);
/// Man page of @p program; @p keys: its section about keys and all of the main program's own, or empty.
std::string manPage(CLI::App& program, const std::string& keys);
/// The commands of @p program that are not hidden.
std::vector<CLI::App*> shownCommands(CLI::App& program);

} // namespace pointhaptics::app
