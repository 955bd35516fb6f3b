#include "View/ViewSettings.h"

#include "Options/TouchOptions.h"
#include "Terminal/CommandLine.h"
#include "View/PictureOptions.h"

#include "HapticViewerOptions.h"

#include "Core/Base/OutputFile.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <vector>

namespace pointhaptics::app
{
namespace
{

const std::set<std::string>& deeds()
{
  static const std::set<std::string> names = { "help", "version", "config", "write-config", "recent",
    "screenshot", "skip-unreadable", "turntable", "force-chart", "trace", "record", "replay", "output",
    "sound-file", "marker-text", "marker-socket" };
  return names;
}

/// Options that belong to the cloud at hand, and to no other.
constexpr const char* kOfTheCloud[] = { "matrix", "workspace", "voxel", "dims", "scale", "rotate",
  "translate", "unit", "resolution", "columns", "salvage", "vertices", "path", "path-unit", "path-time-unit",
  "up", "color-by", "color-range", "clip", "hide", "measure", "together", "watch", "camera", "ideal" };

/// A number where it reads back as it was written, else text: an array may be called 1e3.
nlohmann::ordered_json valueOf(const CLI::Option& option)
{
  const std::string text = fmt::format("{}", fmt::join(option.results(), ","));
  if (option.get_expected_max() == 0) // a flag
  {
    return text != "false";
  }
  const nlohmann::ordered_json value = nlohmann::ordered_json::parse(text, nullptr, false);
  return value.is_number() && value.dump() == text ? value : nlohmann::ordered_json(text);
}

/// Model matrix and workspace in place of the options that led to them.
void setModel(nlohmann::ordered_json& settings, const HapticViewerState& state, double metresPerUnit)
{
  for (const char* name : { "scale", "rotate", "translate" })
  {
    settings.erase(name);
  }
  // --matrix works on metres.
  std::array<double, 16> elements = state.modelToWorkspace;
  for (std::size_t row = 0; row < 3; ++row)
  {
    for (std::size_t column = 0; column < 3; ++column)
    {
      elements[4 * row + column] /= metresPerUnit;
    }
  }
  settings["matrix"] = elements;
  settings["workspace"] = state.workspace;
}

} // namespace

nlohmann::ordered_json givenSettings(CLI::App& command)
{
  nlohmann::ordered_json settings = nlohmann::ordered_json::object();
  for (const CLI::Option* option : command.get_options())
  {
    for (const std::string& name : option->get_lnames())
    {
      if (option->count() > 0 && deeds().count(name) == 0 && commonOptions().count(name) == 0)
      {
        settings[name] = valueOf(*option);
      }
    }
  }
  return settings;
}

void setState(nlohmann::ordered_json& settings, const HapticViewerState& state, double metresPerUnit)
{
  setModel(settings, state, state.unit.empty() ? metresPerUnit : state.metresPerUnit);
  if (!state.unit.empty())
  {
    settings["unit"] = state.unit;
  }
  if (state.voxelSize > 0.0)
  {
    settings.erase("dims");
    settings["voxel"] = state.voxelSize;
  }
  setContact(settings, state.contact);
  settings["beta"] = state.radiusScale;
  settings["camera"] = state.camera;
  settings["push-pointer"] = state.pushPointer;
  settings["axes"] = state.axes;
  settings["figure"] = state.figure;
  settings["felt"] = state.felt;
  settings["ambient"] = state.ambient;
  settings["full-screen"] = state.fullScreen;
  settings["sound"] = state.sound;
  setPicture(settings, state.picture);
  setUnlessEmpty(settings, "up", state.up == "auto" ? std::string() : state.up);
  setUnlessEmpty(settings, "clip", state.clip);
  setUnlessEmpty(settings, "color-by", state.colorBy);
  settings["size"] = fmt::format("{}x{}", state.width, state.height);
}

bool writeSettings(const nlohmann::ordered_json& settings, const std::string& fileName, std::string& message)
{
  OutputFile file;
  Status status = file.open(fileName);
  if (status == Status::Ok)
  {
    static_cast<void>(file.write(settings.dump(2) + "\n"));
    status = file.commit();
  }
  if (status != Status::Ok)
  {
    message = fmt::format("{}: cannot be written: {}; {}", fileName, file.reason(), file.cure());
  }
  return status == Status::Ok;
}

std::string recentSettingsFile()
{
  const char* state = std::getenv("XDG_STATE_HOME");
  const char* home = std::getenv("HOME");
  if (state && *state == '/')
  {
    return std::string(state) + "/pointhaptics/view.json";
  }
  return home && *home ? std::string(home) + "/.local/state/pointhaptics/view.json" : std::string();
}

/// The axes of all files; and the name of the one that keeps them.
static nlohmann::ordered_json keptUps(std::filesystem::path& name)
{
  const std::string recent = recentSettingsFile();
  name = recent.empty() ? std::filesystem::path() : std::filesystem::path(recent).replace_filename("up.json");
  std::ifstream file(name);
  nlohmann::ordered_json ups = nlohmann::ordered_json::parse(file, nullptr, false);
  return ups.is_object() ? ups : nlohmann::ordered_json::object();
}

static std::string keyOf(const std::string& file)
{
  std::error_code error;
  return std::filesystem::absolute(file, error).string();
}

std::string keptUp(const std::string& file)
{
  std::filesystem::path name;
  const nlohmann::ordered_json ups = keptUps(name);
  const auto found = ups.find(keyOf(file));
  return found != ups.end() && found->is_string() ? found->get<std::string>() : std::string();
}

void keepUp(const std::string& file, const std::string& axis)
{
  std::filesystem::path name;
  nlohmann::ordered_json ups = keptUps(name);
  ups[keyOf(file)] = axis;
  std::error_code error;
  std::string message;
  if (!name.empty())
  {
    std::filesystem::create_directories(name.parent_path(), error);
    static_cast<void>(writeSettings(ups, name.string(), message));
  }
}

void rememberSettings(nlohmann::ordered_json settings)
{
  for (const char* name : kOfTheCloud)
  {
    settings.erase(name);
  }
  const std::string file = recentSettingsFile();
  std::error_code error;
  std::string message;
  if (!file.empty())
  {
    std::filesystem::create_directories(std::filesystem::path(file).parent_path(), error);
    static_cast<void>(writeSettings(settings, file, message));
  }
}

} // namespace pointhaptics::app
