#include "Terminal/CommandLine.h"

#include "Options/Files.h"
#include "Terminal/LastResort.h"
#include "Terminal/Messages.h"
#include "Terminal/StopSignals.h"

#include "Core/Base/Status.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <system_error>
#include <vector>

namespace pointhaptics::app
{
namespace
{

/// Which of @p words that are no option is a file that is there; empty: none.
std::string fileLikeAnOption(const std::vector<std::string>& words)
{
  const auto found = std::find_if(words.begin(), words.end(),
    [](const std::string& word)
    {
      std::error_code ignored;
      return word.size() > 1 && word.front() == '-' && std::filesystem::exists(word, ignored);
    });
  return found == words.end() ? std::string() : *found;
}

std::vector<std::string> optionNames(const CLI::App& command)
{
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
  {
    for (const std::string& name : option->get_lnames())
    {
      names.push_back("--" + name);
    }
  }
  return names;
}

/// The command that the words so far name.
const CLI::App& parsedCommand(const CLI::App& program)
{
  const CLI::App* command = &program;
  while (!command->get_subcommands().empty())
  {
    command = command->get_subcommands().front();
  }
  return *command;
}

/// How often an option was given, or that its value is missing.
std::string mismatchMessage(const CLI::App& command, const std::string& text)
{
  const std::string name = text.substr(0, text.find(':'));
  const CLI::Option* option = command.get_option_no_throw(name);
  if (!option)
  {
    return text;
  }
  if (text.find("At Most") != std::string::npos || option->count() > 1)
  {
    return fmt::format("{} is given {} times; give it once", name, option->count());
  }
  const std::string form = option->get_type_name();
  return fmt::format("{}: its value is missing; give {}{}{}", name, name, form.empty() ? "" : " ", form);
}

/// Our wording in place of CLI11's, in one line.
std::string usageMessage(const CLI::App& program, const CLI::ParseError& error)
{
  const CLI::App& command = parsedCommand(program);
  // In the order in which they were given; the message has them from the last to the first.
  const std::vector<std::string> words = program.remaining(true);
  if (const std::string file = fileLikeAnOption(words); !file.empty())
  {
    return fmt::format("{}: begins with - as options do; give the file as ./{}", file, file);
  }
  std::string message = error.what();
  std::replace(message.begin(), message.end(), '\n', ' ');
  if (dynamic_cast<const CLI::ExtrasError*>(&error))
  {
    const std::string first =
      words.empty() ? std::string() : words.front().substr(0, words.front().find('='));
    return fmt::format("unexpected argument{} {}{}", words.size() > 1 ? "s" : "", fmt::join(words, " "),
      first.rfind("--", 0) == 0 ? didYouMean(first, optionNames(command)) : "");
  }
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error))
  {
    return mismatchMessage(command, message);
  }
  if (const std::size_t at = message.find(" excludes "); dynamic_cast<const CLI::ExcludesError*>(&error))
  {
    return fmt::format(
      "{} cannot stand beside {}; leave out one of them", message.substr(0, at), message.substr(at + 10));
  }
  if (const std::size_t at = message.find(" requires "); dynamic_cast<const CLI::RequiresError*>(&error))
  {
    return fmt::format(
      "{} has a meaning only beside {}; give that too", message.substr(0, at), message.substr(at + 10));
  }
  return message;
}

int reportUsage(const CLI::App& program, const CLI::ParseError& error)
{
  std::string command = program.get_name();
  for (const CLI::App* app = &program; !app->get_subcommands().empty();)
  {
    app = app->get_subcommands().front();
    command += " " + app->get_name();
  }
  return failUsage(command, usageMessage(program, error));
}

/// To @p command and all below it, but where another program looks at the options.
void addVersionFlags(CLI::App& command, const std::string& version)
{
  if (command.get_prefix_command())
  {
    return;
  }
  command.set_version_flag("--version", version, "Print the version and exit");
  for (CLI::App* below : command.get_subcommands([](CLI::App*) { return true; }))
  {
    addVersionFlags(*below, version);
  }
}

std::string commandName(const CLI::App& program)
{
  const CLI::App& command = parsedCommand(program);
  return &command == &program ? std::string() : command.get_name();
}

/// The system's text of an error without the library's words around it.
std::string sentenceOf(const std::exception& error)
{
  const std::string text = error.what();
  if (const auto* problem = dynamic_cast<const std::filesystem::filesystem_error*>(&error))
  {
    return fmt::format(
      "{}: {}; check the path and its permissions", problem->path1().string(), problem->code().message());
  }
  const auto* problem = dynamic_cast<const std::system_error*>(&error);
  if (dynamic_cast<const std::bad_alloc*>(&error))
  {
    return message(Status::OutOfMemory);
  }
  if (text.find("pthread_create") != std::string::npos || (problem && problem->code().value() == EAGAIN))
  {
    return "no more threads can be started; give --threads 1, or raise the limit of processes (ulimit -u)";
  }
  return problem ? problem->code().message() + "; look for what the system lacks, and start it again"
                 : "an unexpected fault, \"" + text + "\"; please report it with the command line";
}

int runParsed(CLI::App& program, std::vector<std::string> arguments, const int& exitCode)
{
  try
  {
    program.parse(std::move(arguments));
  }
  catch (const CLI::CallForHelp& help)
  {
    return program.exit(help);
  }
  catch (const CLI::CallForVersion& asked)
  {
    return program.exit(asked);
  }
  catch (const CLI::ParseError& error)
  {
    return reportUsage(program, error);
  }
  catch (const Failure& failure)
  {
    return fail(commandName(program), failure.what());
  }
  catch (const std::exception& error)
  {
    return fail(commandName(program), sentenceOf(error));
  }
  return exitCode;
}

} // namespace

const std::set<std::string>& commonOptions()
{
  static const std::set<std::string> names = { "quiet", "verbose", "no-clobber", "force", "dry-run" };
  return names;
}

void addCommonOptions(CLI::App& command, bool writes)
{
  const auto flag = [&command](const char* name, const char* text, Verbosity verbosity)
  {
    return command.add_flag_function(
      name, [verbosity](std::int64_t) { setVerbosity(verbosity); }, text);
  };
  CLI::Option* quiet = flag(
    "-q,--quiet", "Print errors and what was asked for, but no warnings and summaries", Verbosity::Quiet);
  flag("-v,--verbose", "Say on stderr what is read and written, and what takes how long", Verbosity::Verbose)
    ->excludes(quiet);
  if (writes)
  {
    command
      .add_flag("--force", "Replace files also where a touch was recorded, or OUT is given by its place")
      ->excludes(command.add_flag("--no-clobber", "Refuse to replace a file"));
    command.add_flag("--dry-run", "Print what would be read and written, and end");
  }
}

void runAs(CLI::App& command, int& exitCode, CommandRun run)
{
  addCommonOptions(command, writesFiles(command));
  command.callback(
    [&command, &exitCode, run = std::move(run)]
    {
      const auto isGiven = [&command](const char* name)
      {
        const CLI::Option* option = command.get_option_no_throw(name);
        return option && option->count() > 0;
      };
      Files files;
      files.take(command); // before anything is read
      if (run.complete)
      {
        run.complete();
        files.take(command); // with those of a configuration
      }
      if (run.declare)
      {
        run.declare(files);
      }
      if (isGiven("--dry-run"))
      {
        files.printPlan(isGiven("--json"));
        return;
      }
      exitCode = run.run(files);
    });
}

int failUsage(const std::string& command, const std::string& message)
{
  keepError(message);
  printNow(stderr, fmt::format("{}: {}; see {} --help\n", command, shownLine(message), command));
  return kUsage;
}

int runCommands(CLI::App& program, std::vector<std::string> arguments, const int& exitCode)
{
  program.require_subcommand(1);
  addVersionFlags(program, program.get_name() + " " POINTHAPTICS_VERSION);
  std::reverse(arguments.begin(), arguments.end()); // as CLI11 wants them
  const int code = runParsed(program, std::move(arguments), exitCode);
  return code == kFailed && stopIsRequested() ? stopExitCode() : code;
}

int runProgram(const std::vector<std::string>& arguments, const std::function<int()>& run)
{
  collectVtkMessages();
  // Writing fails instead, and OutputFile says why.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  if (std::find(arguments.begin(), arguments.end(), "--json") != arguments.end())
  {
    promiseJson();
  }
  const std::string command = arguments.empty() ? std::string() : arguments.front();
  endCleanlyOnAbort(command);
  int exitCode = kSuccess;
  try
  {
    exitCode = run();
    showKeptWarnings();
    printPromisedJson(exitCode);
  }
  catch (const std::exception& error)
  {
    return fail(command, sentenceOf(error));
  }
  errno = 0;
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) // all of it, from the first line on
  {
    return failStandardOutput(command, errno);
  }
  return exitCode;
}

} // namespace pointhaptics::app
