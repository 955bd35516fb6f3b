/// @file
/// Messages to the user: errors in one line, and the messages of VTK classes collected instead of printed.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

namespace pointhaptics::app
{

/// Exit codes of the programs.
enum ExitCode : int
{
  kSuccess = 0,
  kFailed = 1,
  kUsage = 2, ///< beside these: stopExitCode() where a signal ended the work, and fail()'s of a closed pipe
};

/// A fault that ends the command with kFailed: what, where and the cure.
class Failure : public std::runtime_error
{
public:
  using std::runtime_error::runtime_error;
};
/// Throws a Failure unless @p isDone, whose call must not fill a text that @p message is a sum of.
inline void require(bool isDone, const std::string& message)
{
  if (!isDone)
  {
    throw Failure(message);
  }
}

/// Name the speaker of messages, also of the last one (endCleanlyOnAbort()): `pointhaptics` unless main()
/// says another at its beginning, and the command.
void nameProgram(const std::string& name);
void nameCommand(const std::string& name);
/// Prints `PROGRAM COMMAND: message` on stderr, in one line, after the warnings so far. Says nothing where
/// the reader of standard output has ended and that is the fault. @return kFailed, or 141, as a shell counts
/// SIGPIPE.
int fail(const std::string& message);
/// As fail(), of a standard output that could not be written for the reason @p error (errno, 0: unknown).
int failStandardOutput(int error);
/// Prints a usage error of @p command, "pointhaptics convert", in one line. @return kUsage.
int failUsage(const std::string& command, const std::string& message);
/// Keeps `PROGRAM COMMAND: warning: FILE: message` for showKeptWarnings(); no @p message: none. Warnings that
/// differ in numbers and files alone are one, with their count.
void warn(const std::string& message, const std::string& file = {});
/// Prints the warnings kept since the last call. None in a quiet run, and none that was printed before.
void showKeptWarnings();
/// From here on messages say @p shown where they would say @p path.
void showAs(const std::string& path, const std::string& shown);
std::string shownLine(const std::string& text);

/// --quiet: errors alone; --verbose: also what is read and written, and how long it takes, on stderr.
enum class Verbosity
{
  Quiet,
  Usual,
  Verbose
};
void setVerbosity(Verbosity verbosity);
/// Prints `LABEL: message` on stderr in a verbose run. @p label: empty is the command.
void say(const std::string& message, const std::string& label = {});
/// An output goes to standard output, where nothing else is printed then.
void takeStandardOutput();
/// Prints the last line of a command on stdout; not in a quiet run, nor where stdout is taken.
void printSummary(const std::string& line);
/// Errors are printed as JSON, too: `{"error": TEXT, "exit_code": CODE}`, at the end and only where no other
/// JSON was printed.
void promiseJson();
void printPromisedJson(int exitCode);

/// "; did you mean WORD?" where one of @p words is near to @p given, else empty.
std::string didYouMean(const std::string& given, const std::vector<std::string>& words);

/// Prints @p text on @p stream at once. Never throws: where nobody reads it any more, or there is no space,
/// it is lost, and a program that holds a force goes on; main() tells in the end of a stdout that failed.
void printNow(std::FILE* stream, const std::string& text) noexcept;

/// "1 point", "2 points".
std::string countOfPoints(std::int64_t count);
/// ", 2 of them NaN or infinite", to follow that; nothing of none.
std::string ofThemInvalid(std::int64_t count);

/// The text of @p object, in one line or indented; names that are no UTF-8 get replacement characters.
std::string jsonText(const nlohmann::ordered_json& object, int indent = -1);
/// Prints one object on stdout, in one line.
void printJson(const nlohmann::ordered_json& object);
/// Prints the result of a command as it was asked for.
void printResult(bool asJson, const nlohmann::ordered_json& object, const std::string& summary);

/// From here on VTK's errors and warnings are kept, from all threads, instead of printed.
void collectVtkMessages();
/// Returns the messages since the last call, as plain sentences without file names, lines and addresses;
/// oldest first.
std::vector<std::string> takeVtkErrors();
std::vector<std::string> takeVtkWarnings();

} // namespace pointhaptics::app
