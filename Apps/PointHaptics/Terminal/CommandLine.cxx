#include "Terminal/CommandLine.h"

#include "Options/OptionParsing.h"
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
  for (const auto& option : longNames(command))
  {
    names.push_back("--" + option.first);
  }
  return names;
}

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
std::string usageMessage(const CLI::App& program, const CLI::App& command, const CLI::ParseError& error)
{
  // In the order in which they were given; the message has them from the last to the first.
  const std::vector<std::string> words = program.remaining(true);
  if (const std::string file = fileLikeAnOption(words); !file.empty())
  {
    return fmt::format("{}: begins with - as options do; give the file as ./{}", file, file);
  }
  std::string message = error.what();
  std::replace(message.begin(), message.end(), '\n', ' ');
  // An option that is missing may be there, misspelt.
  const bool isMissing = &command != &program && dynamic_cast<const CLI::RequiredError*>(&error);
  if (!words.empty() && (dynamic_cast<const CLI::ExtrasError*>(&error) || isMissing))
  {
    const std::string first = words.front().substr(0, words.front().find('='));
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

/// The system's text of an error without the library's words around it.
std::string sentenceOf(const std::exception& error)
{
  const std::string text = error.what();
  if (dynamic_cast<const Failure*>(&error))
  {
    return text;
  }
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

/// As fail(); a standard output that failed is said once, at the end.
int failBy(const std::exception& error)
{
  return std::ferror(stdout) != 0 ? kFailed : fail(sentenceOf(error));
}

int runParsed(CLI::App& program, std::vector<std::string> arguments, const int& exitCode)
{
  try
  {
    program.parse(std::move(arguments));
  }
  catch (const CLI::Success& asked) // for help or version
  {
    setVerbosity(Verbosity::Quiet);
    return program.exit(asked);
  }
  catch (const CLI::ParseError& error)
  {
    const std::vector<CLI::App*> named = program.get_subcommands();
    const CLI::App& command = named.empty() ? program : *named.front();
    const std::string name = named.empty() ? "" : " " + command.get_name();
    return failUsage(program.get_name() + name, usageMessage(program, command, error));
  }
  catch (const std::exception& error)
  {
    return failBy(error);
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

void addCommand(
  CLI::App& program, int& exitCode, const char* name, const char* description, std::shared_ptr<Command> work)
{
  CLI::App& command = *program.add_subcommand(name, description);
  work->addTo(command);
  if (!command.get_prefix_command()) // another program looks at the options
  {
    addCommonOptions(command, writesFiles(command));
  }
  command.callback(
    [&command, &exitCode, work]
    {
      nameCommand(command.get_name());
      Files files;
      files.take(command); // before anything is read
      work->complete(command, files);
      if (isGiven(command, "--dry-run"))
      {
        files.printPlan(isGiven(command, "--json"));
        return;
      }
      exitCode = work->run(files);
    });
}

int runCommands(
  CLI::App& program, std::vector<std::string> arguments, const int& exitCode, std::vector<std::string> names)
{
  program.require_subcommand(1);
  std::vector<CLI::App*> all = program.get_subcommands([](CLI::App*) { return true; });
  const bool listsAll = names.empty();
  const std::string kinds = listsAll ? "command" : "command or file";
  const std::string first = arguments.empty() ? std::string() : arguments.front();
  bool isKnown = false;
  for (const CLI::App* command : all)
  {
    isKnown = isKnown || command->get_name() == first;
    names.insert(names.end(), listsAll && !command->get_group().empty() ? 1 : 0, command->get_name());
  }
  all.push_back(&program);
  for (CLI::App* command : all)
  {
    if (!command->get_prefix_command()) // another program looks at the options
    {
      command->set_version_flag(
        "--version", program.get_name() + " " POINTHAPTICS_VERSION, "Print the version and exit");
    }
  }
  if (!isKnown && !program.get_option_no_throw(first))
  {
    return failUsage(program.get_name(),
      fmt::format("{}{}; commands are {}",
        first.empty() ? "nothing to do" : "no " + kinds + " '" + first + "'",
        didYouMean(first, first.rfind('-', 0) == 0 ? optionNames(program) : names), fmt::join(names, ", ")));
  }
  std::reverse(arguments.begin(), arguments.end()); // as CLI11 wants them
  const int code = runParsed(program, std::move(arguments), exitCode);
  return code == kFailed && stopIsRequested() ? stopExitCode() : code;
}

int runProgram(const std::vector<std::string>& arguments, const std::function<int()>& run)
{
  collectVtkMessages();
  // Writing fails instead, and OutputFile says why. A reader that ends - view ... | head - must not end a
  // program that pushes.
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  if (std::find(arguments.begin(), arguments.end(), "--json") != arguments.end())
  {
    promiseJson();
  }
  nameCommand({}); // until it is known
  int exitCode = kSuccess;
  const auto guarded = [&exitCode](const auto& step)
  {
    try
    {
      step();
    }
    catch (const std::exception& error)
    {
      exitCode = failBy(error);
    }
  };
  guarded([&] { exitCode = run(); });
  guarded(
    [&exitCode]
    {
      showKeptWarnings();
      printPromisedJson(exitCode);
    });
  errno = 0;
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) // all of it, from the first line on
  {
    return failStandardOutput(errno);
  }
  return exitCode;
}

} // namespace pointhaptics::app
