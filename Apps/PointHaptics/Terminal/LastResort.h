/// @file
/// Where a library aborts the process, as VTK and graphics drivers do without memory or OpenGL.
#pragma once

#include <string>

namespace pointhaptics::app
{

/// From now on an abort of this process, and an exception that nobody catches, end it with kFailed and one
/// line, and leave no unfinished file. @param command names who speaks in that line.
void endCleanlyOnAbort(const std::string& command);

} // namespace pointhaptics::app
