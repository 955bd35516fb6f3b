/// @file
/// Ctrl+C and the like as a question the program asks, so that a device in somebody's hand is let go in
/// order, and no half-written file stays behind; and what ends the process at once.
#pragma once

#include <string>

namespace pointhaptics::app
{

/// From here on SIGINT, SIGTERM and SIGHUP are remembered instead of ending the program; a second one of the
/// same kind ends it.
void rememberStopSignals();
/// A signal has come since. Any thread.
bool stopIsRequested() noexcept;
/// Exit code of a program that gave up its work for the signal: 130 for SIGINT, 143 for SIGTERM. @pre
/// stopIsRequested()
int stopExitCode() noexcept;

/// From now on an abort of this process, as VTK and graphics drivers call it without memory or OpenGL, and an
/// exception that nobody catches, end it with kFailed and one line, and leave no unfinished file. @param
/// speaker whose line it is.
void endCleanlyOnAbort(const std::string& speaker);

} // namespace pointhaptics::app
