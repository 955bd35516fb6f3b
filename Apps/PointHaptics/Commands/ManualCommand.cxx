// `pointhaptics manual man|bash|keys|formats`: man page, bash completion and cheat sheet, from the options
// and bindings themselves. The build calls it.
#include "Commands/Commands.h"

#include "Options/OptionParsing.h"
#include "Terminal/KeyedHelp.h"

#include "CommandRegistry.h"
#include "HapticViewer.h"
#include "vtkPointCloudReader.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace pointhaptics::app
{
namespace
{

std::vector<CLI::App*> shownCommands(CLI::App& program)
{
  return program.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

/// Escapes text for roff: dashes that can be copied, no line that reads as a request.
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

/// Help of all commands, also those that some windows lack.
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

std::string examples()
{
  const std::pair<const char*, const char*> all[] = {
    { "pointhaptics scan.laz", "Show and feel a scan; F lets the hand follow the mouse." },
    { "pointhaptics view scan.laz --screenshot scan.png --size 1920x1080", "Write a picture." },
    { "pointhaptics info scan.laz", "Say what is in it, and in which unit it seems to be." },
    { "pointhaptics resample scan.laz --voxel 0.05 -o small.ply", "One point in each voxel of 5 cm." },
    { "pointhaptics feel scan.laz --fit --path hip.csv -o felt.csv",
      "Feel it along a path of t,x,y,z in seconds and metres: a row a tick." },
    { "pointhaptics view scan.laz --record touch.csv", "Record what a person feels." },
    { "pointhaptics compare touch.csv -o forces.png", "Feel that again by two methods, and draw both." },
    { "pointhaptics convert a.e57 b.pcd --together all.laz", "One file of several, with all their arrays." },
  };
  std::string text = ".SH EXAMPLES\n";
  for (const auto& [line, words] : all)
  {
    text += fmt::format(".TP\n\\fB{}\\fR\n{}\n", roff(line), roff(words));
  }
  return text;
}

constexpr const char* kExitStatus =
  ".SH EXIT STATUS\n.TP\n\\fB0\\fR\nDone.\n.TP\n\\fB1\\fR\nFailed: a file cannot be read or written, or the "
  "work "
  "cannot be done.\n.TP\n\\fB2\\fR\nThe command line or a configuration is wrong, or an output would cost a "
  "file; nothing "
  "was touched.\n.TP\n\\fB128 + N\\fR\nSignal N ended it: 130 Ctrl+C (or Escape, Q and the close button "
  "before the first "
  "cloud is read), 143 SIGTERM, 129 SIGHUP, 141 a reader of standard output that ended.\n";

/// Manual page of this program or of one beside it, which has no window.
std::string manPage(CLI::App& program)
{
  const std::string& name = program.get_name();
  const bool isMain = name == "pointhaptics";
  const std::string description = program.get_description();
  std::string text = fmt::format(
    ".TH {0} 1 \"\" \"{1} {2}\" \"User Commands\"\n.SH NAME\n{1} \\- {3}\n.SH SYNOPSIS\n.B "
    "{1}\n[\\fICOMMAND\\fR] [\\fIOPTIONS\\fR] \\fIFILE\\fR...\n.SH DESCRIPTION\n{4}\n",
    upper(name), roff(name), POINTHAPTICS_VERSION,
    isMain ? "see and feel raw point clouds" : roff(description.substr(0, description.find('\n'))),
    isMain ? "Shows point clouds, and renders their touch to a haptic device or a simulated hand. Without a "
             "command: \\fBview\\fR."
           : roff(description));
  for (const CLI::App* command : shownCommands(program))
  {
    text += fmt::format(".SH {}\n{}.\n{}", roff(upper(name + " " + command->get_name())),
      roff(command->get_description()), optionsOf(*command));
    for (const CLI::App* below : command->get_subcommands([](const CLI::App*) { return true; }))
    {
      text += fmt::format(".SS {} {}\n{}.\n{}", roff(command->get_name()), roff(below->get_name()),
        roff(below->get_description()), optionsOf(*below));
    }
  }
  text += isMain ? ".SH KEYS AND MOUSE OF VIEW\n.nf\n" + roff(keysHelp()) + "\n.fi\n" + examples() : "";
  text += kExitStatus;
  text += isMain
    ? ".SH FILES\n.TP\n\\fI$XDG_STATE_HOME/pointhaptics/view.json\\fR\nWhat the last window ended with, in "
      "~/.local/state where XDG_STATE_HOME is not set: see \\fBview \\-\\-recent\\fR.\n"
    : "";
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

/// Makes a case for each option of @p command with choices, and their words.
std::string choiceCases(const CLI::App& command, const std::string& name)
{
  std::string cases;
  for (const CLI::Option* option : command.get_options())
  {
    const std::string choices = choicesOf(*option);
    const std::string list = listOf(*option);
    for (const std::string& each : option->get_lnames())
    {
      const std::string words = !choices.empty() ? choices : !list.empty() ? list : beginningsOf(each);
      if (!words.empty())
      {
        cases += fmt::format(
          "    '{} --{}') values=\"{}\"{} ;;\n", name, each, words, choices.empty() ? " separator=," : "");
      }
    }
  }
  return cases;
}

/// Choices of the command's arguments that are no options.
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
    std::string words = longOptions(*command) + argumentChoices(*command);
    values += choiceCases(*command, command->get_name());
    for (const CLI::App* below : command->get_subcommands([](const CLI::App*) { return true; }))
    {
      words += " " + below->get_name() + " " + longOptions(*below);
    }
    names += (names.empty() ? "" : " ") + command->get_name();
    cases += fmt::format("    {}) words=\"{}\" ;;\n", command->get_name(), words);
  }
  return fmt::format(R"text(# bash completion for pointhaptics
_pointhaptics() {{
  local word="${{COMP_WORDS[COMP_CWORD]}}" before="${{COMP_WORDS[COMP_CWORD - 1]}}" words command="${{COMP_WORDS[1]}}" values="" separator=""
  if [[ "$word" == "=" ]]; then # bash takes --option=value for three words
    word=""
  elif [[ "$before" == "=" ]] && ((COMP_CWORD > 2)); then
    before="${{COMP_WORDS[COMP_CWORD - 2]}}"
  fi
  case " {1} " in
    *" $command "*) ;;
    *) command=view ;;
  esac
  case "$command $before" in
{3}  esac
  if [[ -n "$separator" ]]; then
    local head=""
    [[ "$word" != *,* ]] || head="${{word%,*}},"
    mapfile -t COMPREPLY < <(compgen -P "$head" -W "$values" -- "${{word##*,}}")
    compopt -o nospace 2>/dev/null
    return
  fi
  if [[ -n "$values" ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$values" -- "$word")
    return
  fi
  case "$command" in
{0}    *) words="{2}" ;;
  esac
  if ((COMP_CWORD == 1)); then
    words="{1} --help --version"
  fi
  if [[ "$word" == -* ]] || ((COMP_CWORD == 1)); then
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
  fi
  if [[ "$word" != -* ]] && ((COMP_CWORD > 1)); then
    mapfile -t COMPREPLY < <(compgen -W "$(printf '%s\n' $words | grep -v '^-')" -- "$word")
  fi
  if [[ "$word" != -* ]]; then
    mapfile -t -O "${{#COMPREPLY[@]}}" COMPREPLY < <(compgen -f -- "$word")
  fi
}}
complete -o filenames -F _pointhaptics pointhaptics
)text",
    cases, names, longOptions(*program.get_subcommand("view")), values);
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

std::string cheatSheet()
{
  return "# Keys and mouse of `pointhaptics view`\n\nThis is what the help in the window (key " +
    HapticViewer::commands().label("help") + ") shows. Made by `pointhaptics manual keys`.\n\n```\n" +
    keysHelp() + "\n```\n";
}

} // namespace

void addManPage(CLI::App& program)
{
  CLI::App* command = program.add_subcommand("manual", "Print the man page")->group("");
  command->callback([&program] { fmt::print("{}", manPage(program)); });
}

void addManualCommand(CLI::App& program, int& exitCode)
{
  CLI::App* command = program.add_subcommand("manual",
    "Print the man page, the bash completion, the cheat sheet, which options name files, or which formats "
    "there are");
  auto what = std::make_shared<std::string>();
  addWord(*command, "what", *what, { "man", "bash", "keys", "files", "formats" }, "What to print")
    ->required();
  const auto run = [what, &program](Files&)
  {
    describeKeyedOptions(*program.get_subcommand("view"), {});
    fmt::print("{}",
      *what == "man"         ? manPage(program)
        : *what == "bash"    ? bashCompletion(program)
        : *what == "files"   ? fileOptions(program)
        : *what == "formats" ? vtkPointCloudReader::GetFormatTable()
                             : cheatSheet());
    return kSuccess;
  };
  runAs(*command, exitCode, { run });
}

} // namespace pointhaptics::app
