/// The program pointhaptics: one subcommand per task, `view` where none is named.
#include "Commands/Commands.h"
#include "Terminal/Messages.h"
#include "Terminal/StopSignals.h"

#include "Core/Base/Host/OutOfMemory.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include <dlfcn.h>

namespace
{

using namespace pointhaptics::app;

constexpr const char* kManualCommand = "manual";
const std::vector<std::string> kHelp = { "-h", "--help" };

struct NamedCommand
{
  const char* name;
  const char* description;
  Command* (*make)(); ///< Null: the library of the view makes it.
};

constexpr NamedCommand kCommands[] = {
  { "view", "Show point clouds and feel them (the default command)", nullptr },
  { "feel", "Feel a point cloud along a path, in virtual time, or with a Falcon", nullptr },
  { "compare", "Feel a recording by two methods, and draw both forces side by side", nullptr },
  { "resample", "Replace the points in each voxel of a lattice by their mean, or by one of them",
    resampleCommand },
  { "bandwidth", "Add kernel bandwidth, proxy radius and density to every point", bandwidthCommand },
  { "convert", "Write point clouds in another format, with all they have", convertCommand },
  { "info", "Say what is in point cloud files", infoCommand },
  { "generate", "Make a point cloud of a shape with exact answers", generateCommand },
  { "devices", "List haptic devices and SpaceMice; check a Falcon", devicesCommand },
  { "bench", "Measure PointHaptics beside others (pointhaptics-bench)", benchCommand },
  { kManualCommand,
    "Print the man page, the bash completion, the cheat sheet, which options name files, or which formats "
    "there are",
    nullptr },
};

/// Address space that the libraries of the view are loaded in at least, 46 MiB with VTK 9.1: what VTK's and
/// TBB's first objects throw while they are loaded ends the process.
constexpr std::size_t kRoomOfView = std::size_t(80) << 20;

/// The command that the library of the view makes: loading VTK's rendering takes 20 ms.
/// @throws std::bad_alloc where there is no room for it.
Command* fromLibrary(const std::string& name)
{
  static void* library = nullptr;
  if (!library && !pointhaptics::hasAddressSpace(kRoomOfView))
  {
    throw std::bad_alloc();
  }
  library = library ? library : dlopen(POINTHAPTICS_VIEW_LIBRARY, RTLD_LAZY);
  void* const make = library ? dlsym(library, (name + "Command").c_str()) : nullptr;
  const char* const problem = make ? nullptr : dlerror();
  require(make,
    fmt::format("{} cannot be loaded: {}; install the program again", POINTHAPTICS_VIEW_LIBRARY,
      problem ? problem : "it lacks a command"));
  return reinterpret_cast<Command* (*)()>(make)();
}

bool isOneOf(const std::vector<std::string>& words, const std::string& word)
{
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// `pointhaptics FILE...` and `pointhaptics --size 800x600 FILE` mean `pointhaptics view ...`.
/// False: the first word is neither a command nor a file; the usage error is printed.
bool insertDefaultCommand(std::vector<std::string>& arguments)
{
  std::vector<std::string> names;
  for (const NamedCommand& command : kCommands)
  {
    names.emplace_back(command.name);
  }
  if (arguments.empty())
  {
    failUsage("pointhaptics",
      fmt::format("nothing to do; name a file to view or a command ({})", fmt::join(names, ", ")));
    return false;
  }
  const std::string& first = arguments.front();
  if (isOneOf(names, first) || isOneOf(kHelp, first) || first == "--version")
  {
    return true;
  }
  std::error_code error;
  const bool isWord =
    first.find_first_of("./-") == std::string::npos && !std::filesystem::exists(first, error);
  if (isWord)
  {
    failUsage("pointhaptics",
      fmt::format("no command or file '{}'{}; commands are {}", first, didYouMean(first, names),
        fmt::join(names, ", ")));
    return false;
  }
  arguments.insert(arguments.begin(), "view");
  return true;
}

int run(std::vector<std::string> arguments)
{
  if (!insertDefaultCommand(arguments))
  {
    return kUsage;
  }
  const bool isHelp = isOneOf(kHelp, arguments.front());
  nameCommand(isHelp ? std::string() : arguments.front());
  CLI::App program("See and feel raw point clouds.\nWithout a command: view.", "pointhaptics");
  int exitCode = kSuccess;
  for (const NamedCommand& command : kCommands)
  {
    if (isHelp)
    {
      program.add_subcommand(command.name, command.description);
    }
    else if (arguments.front() == kManualCommand || arguments.front() == command.name)
    {
      const std::shared_ptr<Command> made(command.make ? command.make() : fromLibrary(command.name));
      addCommand(program, exitCode, command.name, command.description, made);
    }
  }
  return runCommands(program, std::move(arguments), exitCode);
}

} // namespace

int main(int argc, char* argv[])
{
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  return runProgram(arguments, [&] { return run(arguments); });
}
