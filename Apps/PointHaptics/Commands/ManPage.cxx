#include "Commands/Commands.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>
#include <vector>

namespace pointhaptics::app
{
namespace
{

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

} // namespace

std::vector<CLI::App*> shownCommands(CLI::App& program)
{
  return program.get_subcommands([](const CLI::App* command) { return !command->get_group().empty(); });
}

std::string manPage(CLI::App& program, const std::string& keys)
{
  const std::string& name = program.get_name();
  const bool isMain = !keys.empty();
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
  }
  text += isMain ? ".SH KEYS AND MOUSE OF VIEW\n.nf\n" + roff(keys) + "\n.fi\n" + examples() : "";
  text += kExitStatus;
  text += isMain
    ? ".SH FILES\n.TP\n\\fI$XDG_STATE_HOME/pointhaptics/view.json\\fR\nWhat the last window ended with, in "
      "~/.local/state where XDG_STATE_HOME is not set: see \\fBview \\-\\-recent\\fR.\n"
    : "";
  return text;
}

void addManPage(CLI::App& program)
{
  CLI::App* command = program.add_subcommand("manual", "Print the man page")->group("");
  command->callback([&program] { fmt::print("{}", manPage(program, "")); });
}

} // namespace pointhaptics::app
