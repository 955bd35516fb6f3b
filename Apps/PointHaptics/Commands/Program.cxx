// One subcommand per task, `view` where none is named.
#include "Commands/Commands.h"
#include "Terminal/Messages.h"
#include "Terminal/StopSignals.h"

#include "Core/Base/Host/OutOfMemory.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include <dlfcn.h>

namespace pointhaptics::app
{
namespace
{

constexpr const char* kManualCommand = "manual";

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
  if (!library && !hasAddressSpace(kRoomOfView))
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

/// `pointhaptics FILE...` and `pointhaptics --size 800x600 FILE` mean `pointhaptics view ...`.
bool isOfView(const std::string& first)
{
  std::error_code error;
  return first.find_first_of("./-") != std::string::npos || std::filesystem::exists(first, error);
}

int run(std::vector<std::string> arguments)
{
  std::vector<std::string> names;
  for (const NamedCommand& command : kCommands)
  {
    names.emplace_back(command.name);
  }
  std::string first = arguments.empty() ? std::string() : arguments.front();
  const bool isHelp = first == "-h" || first == "--help";
  const bool isNamed = std::find(names.begin(), names.end(), first) != names.end();
  if (!isNamed && !isHelp && first != "--version" && isOfView(first))
  {
    first = "view";
    arguments.insert(arguments.begin(), first);
  }
  nameCommand(isNamed ? first : std::string());
  CLI::App program("See and feel raw point clouds.\nWithout a command: view.", "pointhaptics");
  int exitCode = kSuccess;
  for (const NamedCommand& command : kCommands)
  {
    if (isHelp)
    {
      program.add_subcommand(command.name, command.description);
    }
    else if (first == kManualCommand || first == command.name)
    {
      const std::shared_ptr<Command> made(command.make ? command.make() : fromLibrary(command.name));
      addCommand(program, exitCode, command.name, command.description, made);
    }
  }
  return runCommands(program, std::move(arguments), exitCode, std::move(names));
}

} // namespace

extern "C" int runPointHaptics(int argc, char* argv[])
{
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  return runProgram(arguments, [&] { return run(arguments); });
}

} // namespace pointhaptics::app
