// `pointhaptics manual man|bash|keys`: man page, bash completion and cheat sheet, from the options and
// bindings themselves. The build calls it; it is not in the help.
#include "Commands/Commands.h"

#include "Options/OptionParsing.h"

#include "CommandRegistry.h"
#include "HapticViewer.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <memory>

namespace pointhaptics
{
namespace app
{
namespace
{

std::vector<CLI::App*> shownCommands(CLI::App& program)
{
  return program.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

/// Text as roff takes it: dashes that can be copied, no line that reads as a request.
std::string roff(const std::string& text)
{
  std::string result;
  for (char c : text)
  {
    const bool atLineStart = result.empty() || result.back() == '\n';
    if (atLineStart && (c == '.' || c == '\''))
    {
      result += "\\&";
    }
    result += c == '-' ? "\\-" : c == '\\' ? "\\e" : std::string(1, c);
  }
  return result;
}

std::string upper(std::string word)
{
  std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::toupper(c); });
  return word;
}

/// Of all commands, also those that some windows have not.
std::string keysHelp()
{
  return HapticViewer::commands().help(CommandRegistry::Scope::All);
}

std::string optionsOf(const CLI::App& command)
{
  std::string text;
  for (const CLI::Option* option : command.get_options())
  {
    const std::string type = option->get_expected_max() > 0 ? option->get_type_name() : "";
    const bool isPositional = option->nonpositional() == false;
    const std::string name = option->get_name(isPositional, !isPositional);
    text += fmt::format(".TP\n\\fB{}\\fR{}\n{}\n", roff(name),
      type.empty() ? "" : " \\fI" + roff(type) + "\\fR", roff(option->get_description()));
  }
  return text;
}

std::string manPage(CLI::App& program)
{
  std::string text = fmt::format(
    ".TH POINTHAPTICS 1 \"\" \"pointhaptics {0}\" \"User Commands\"\n.SH NAME\npointhaptics \\- see and feel "
    "raw "
    "point clouds\n.SH SYNOPSIS\n.B pointhaptics\n[\\fICOMMAND\\fR] [\\fIOPTIONS\\fR] \\fIFILE\\fR...\n.SH "
    "DESCRIPTION\nShows point clouds, and renders their touch to a haptic device or a simulated hand. "
    "Without a "
    "command: \\fBview\\fR.\n",
    POINTHAPTICS_VERSION);
  for (const CLI::App* command : shownCommands(program))
  {
    text += fmt::format(".SH {}\n{}.\n{}", roff("POINTHAPTICS " + upper(command->get_name())),
      roff(command->get_description()), optionsOf(*command));
    for (const CLI::App* below : command->get_subcommands([](const CLI::App*) { return true; }))
    {
      text += fmt::format(".SS {} {}\n{}.\n{}", roff(command->get_name()), roff(below->get_name()),
        roff(below->get_description()), optionsOf(*below));
    }
  }
  text += ".SH KEYS AND MOUSE OF VIEW\n.nf\n" + roff(keysHelp()) + "\n.fi\n";
  text += ".SH EXIT STATUS\n0: done, 1: failed, 2: the command line is wrong.\n";
  text +=
    ".SH FILES\n.TP\n\\fI$XDG_STATE_HOME/pointhaptics/view.json\\fR\nWhat the last window ended with, in "
    "~/.local/state where XDG_STATE_HOME is not set: see \\fBview \\-\\-recent\\fR.\n";
  return text;
}

std::string longOptions(const CLI::App& command)
{
  std::string words;
  for (const CLI::Option* option : command.get_options())
  {
    for (const std::string& name : option->get_lnames())
    {
      words += (words.empty() ? "--" : " --") + name;
    }
  }
  return words;
}

/// Commands and files first, then the options of the command; everything else is a file.
std::string bashCompletion(CLI::App& program)
{
  std::string names;
  std::string cases;
  for (const CLI::App* command : shownCommands(program))
  {
    std::string words = longOptions(*command);
    for (const CLI::App* below : command->get_subcommands([](const CLI::App*) { return true; }))
    {
      words += " " + below->get_name() + " " + longOptions(*below);
    }
    names += (names.empty() ? "" : " ") + command->get_name();
    cases += fmt::format("    {}) words=\"{}\" ;;\n", command->get_name(), words);
  }
  return fmt::format(R"(# bash completion for pointhaptics
_pointhaptics() {{
  local word="${{COMP_WORDS[COMP_CWORD]}}" words command="${{COMP_WORDS[1]}}"
  case "$command" in
{0}    *) words="{2}" ;;
  esac
  if ((COMP_CWORD == 1)); then
    words="{1} --help --version"
  fi
  if [[ "$word" == -* ]] || ((COMP_CWORD == 1)); then
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
  fi
  if [[ "$word" != -* ]]; then
    mapfile -t -O "${{#COMPREPLY[@]}}" COMPREPLY < <(compgen -f -- "$word")
  fi
}}
complete -o filenames -F _pointhaptics pointhaptics
)",
    cases, names, longOptions(*program.get_subcommand("view")));
}

std::string cheatSheet()
{
  return "# Keys and mouse of `pointhaptics view`\n\nThis is what the help in the window (key " +
    HapticViewer::commands().label("help") + ") shows. Made by `pointhaptics manual keys`.\n\n```\n" +
    keysHelp() + "\n```\n";
}

} // namespace

void addManualCommand(CLI::App& program)
{
  CLI::App* command =
    program.add_subcommand("manual", "Print the man page, the bash completion or the cheat sheet");
  command->group("");
  auto what = std::make_shared<std::string>();
  addWord(*command, "what", *what, { "man", "bash", "keys" }, "What to print")->required();
  command->callback(
    [what, &program]
    {
      fmt::print("{}",
        *what == "man"      ? manPage(program)
          : *what == "bash" ? bashCompletion(program)
                            : cheatSheet());
    });
}

} // namespace app
} // namespace pointhaptics
