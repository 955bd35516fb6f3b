/// @file
/// Formats that people take for point clouds and this program does not read: their names, and tools that
/// convert them.
#pragma once

#include <string>

namespace pointhaptics::io
{

struct FormatStart;

/// @throws FileProblem where @p start is that of such a file.
void refuseForeign(const FormatStart& start);

/// @throws FileProblem where @p extension (lower case, no dot) is that of such a file: for those that nobody
/// knows by their first bytes.
void refuseForeignName(const std::string& extension);

} // namespace pointhaptics::io
