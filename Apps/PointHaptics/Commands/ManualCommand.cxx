// `pointhaptics manual man|bash|keys|formats`: man page, bash completion and cheat sheet, from the options
// and bindings themselves. The build calls it.
#include "Commands/Commands.h"

#include "Options/Files.h"
#include "Options/OptionParsing.h"
#include "Terminal/Messages.h"
#include "View/ViewCommand.h"

#include "CommandRegistry.h"
#include "CompletionScript.h" // made of completion.bash
#include "HapticViewer.h"
#include "vtkPointCloudReader.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace pointhaptics::app
{
namespace
{

std::string longOptions(const CLI::App& command)
{
  std::string words;
  for (const auto& option : longNames(command))
  {
    words += (words.empty() ? "--" : " --") + option.first;
  }
  return words;
}

/// Values of an option or argument that takes one of a few words: "a b c"; empty where it takes others.
std::string choicesOf(const CLI::Option& option)
{
  std::string words = option.get_expected_max() > 0 ? option.get_type_name() : std::string();
  const bool areChoices =
    words.find('|') != std::string::npos && words.find_first_of(" ,[:") == std::string::npos;
  std::replace(words.begin(), words.end(), '|', ' ');
  return areChoices ? words : std::string();
}

/// Words of an option that takes some of a few, with commas between them; empty where it takes others.
std::string listOf(const CLI::Option& option)
{
  std::string words = option.get_type_name();
  const bool areWords = words.find(',') != std::string::npos &&
    std::all_of(
      words.begin(), words.end(), [](unsigned char c) { return std::islower(c) || c == '-' || c == ','; });
  std::replace(words.begin(), words.end(), ',', ' ');
  return areWords ? words : std::string();
}

/// Values with which an option's words begin: actions of --bind, and colours that every cloud has.
std::string beginningsOf(const std::string& option)
{
  std::string words = option == "color-by" ? "rgb clay height density proxyradius residual" : "";
  if (option == "bind")
  {
    for (const std::string& name : HapticViewer::commands().names())
    {
      words += (words.empty() ? "" : " ") + name + "=";
    }
  }
  return words;
}

std::string choiceCases(const CLI::App& command, const std::string& name)
{
  std::string cases;
  for (const auto& [each, option] : longNames(command))
  {
    const std::string choices = choicesOf(*option);
    const std::string list = listOf(*option);
    const std::string words = !choices.empty() ? choices : !list.empty() ? list : beginningsOf(each);
    if (!words.empty())
    {
      cases += fmt::format(
        "    '{} --{}') values=\"{}\"{} ;;\n", name, each, words, choices.empty() ? " separator=," : "");
    }
  }
  return cases;
}

std::string argumentChoices(const CLI::App& command)
{
  std::string words;
  for (const CLI::Option* option : command.get_options())
  {
    words += option->nonpositional() ? "" : " " + choicesOf(*option);
  }
  return words;
}

/// Makes the bash completion: commands and files first, then the options of the command; every other word is
/// a file.
std::string bashCompletion(CLI::App& program)
{
  std::string names;
  std::string cases;
  std::string values;
  for (const CLI::App* command : shownCommands(program))
  {
    const std::string words = longOptions(*command) + argumentChoices(*command);
    values += choiceCases(*command, command->get_name());
    names += (names.empty() ? "" : " ") + command->get_name();
    cases += fmt::format("    {}) words=\"{}\" ;;\n", command->get_name(), words);
  }
  const std::pair<const char*, std::string> parts[] = { { "@COMMANDS_WITH_OPTIONS@", cases },
    { "@COMMANDS@", names }, { "@OPTIONS_OF_VIEW@", longOptions(*program.get_subcommand("view")) },
    { "@VALUES@", values } };
  std::string script = kCompletionScript;
  for (const auto& [word, part] : parts)
  {
    for (std::size_t at = 0; (at = script.find(word, at)) != std::string::npos; at += part.size())
    {
      script.replace(at, std::strlen(word), part);
    }
  }
  return script;
}

/// Makes a line for each option that names files: "feel --output required writes csv".
std::string fileOptions(CLI::App& program)
{
  std::string text;
  for (const CLI::App* command : shownCommands(program))
  {
    for (const CLI::Option* option : command->get_options())
    {
      if (const std::string role = fileRole(*option); !role.empty())
      {
        text += fmt::format("{} {}{}{} {}\n", command->get_name(), option->get_positional() ? "" : "--",
          option->get_single_name(), option->get_required() ? " required" : "", role);
      }
    }
  }
  return text;
}

/// Help of all commands, also those that some windows lack.
std::string keysHelp()
{
  return HapticViewer::commands().help();
}

std::string cheatSheet()
{
  return "# Keys and mouse of `pointhaptics view`\n\nThis is what the help in the window (key " +
    HapticViewer::commands().label("help") + ") shows. Made by `pointhaptics manual keys`.\n\n```\n" +
    keysHelp() + "\n```\n";
}

struct ManualCommand : Command
{
  std::string what;
  CLI::App* program = nullptr;

  void addTo(CLI::App& command) override
  {
    this->program = command.get_parent();
    addWord(command, "what", this->what, { "man", "bash", "keys", "files", "formats" }, "What to print")
      ->required();
  }

  int run(Files&) override
  {
    describeKeys(*this->program->get_subcommand("view"), {});
    fmt::print("{}",
      this->what == "man"         ? manPage(*this->program, keysHelp())
        : this->what == "bash"    ? bashCompletion(*this->program)
        : this->what == "files"   ? fileOptions(*this->program)
        : this->what == "formats" ? vtkPointCloudReader::GetFormatTable()
                                  : cheatSheet());
    return kSuccess;
  }
};

} // namespace

Command* manualCommand()
{
  return new ManualCommand;
}

} // namespace pointhaptics::app
