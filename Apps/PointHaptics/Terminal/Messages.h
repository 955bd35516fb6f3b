/// @file
/// What goes to the user: errors in one line, and the messages of VTK classes collected instead of printed.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

namespace pointhaptics
{
namespace app
{

/// Who speaks: the program's name in messages, `pointhaptics` unless main() says another at its beginning.
void nameProgram(const std::string& name);
/// Prints `PROGRAM COMMAND: message` on stderr, in one line. @return kFailed.
int fail(const std::string& command, const std::string& message);
/// Prints `PROGRAM COMMAND: warning: message` on stderr.
void warn(const std::string& command, const std::string& message);

/// Prints @p text on @p stream at once. Never throws: where nobody reads it any more, or there is no space,
/// it is lost, and a program that holds a force goes on; main() tells in the end of a stdout that failed.
void printNow(std::FILE* stream, const std::string& text) noexcept;

/// "1 point", "2 points".
std::string countOfPoints(std::int64_t count);
/// ", 2 of them NaN or infinite", to follow that; nothing of none.
std::string ofThemInvalid(std::int64_t count);

/// Prints one object on stdout, in one line; names that are no UTF-8 get replacement characters.
void printJson(const nlohmann::ordered_json& object);

/// From here on VTK's errors and warnings are kept, from all threads, instead of printed.
void collectVtkMessages();
/// Those since the last call, as plain sentences without file names, lines and addresses; oldest first.
std::vector<std::string> takeVtkErrors();
std::vector<std::string> takeVtkWarnings();

} // namespace app
} // namespace pointhaptics
