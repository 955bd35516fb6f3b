#include "View/ViewSettings.h"

#include "Terminal/CommandLine.h"
#include "Terminal/Messages.h"

#include "ClippedCloud.h"
#include "HapticViewerOptions.h"

#include "Core/Base/OutputFile.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <vector>

namespace pointhaptics::app
{
namespace
{

const std::set<std::string> kDeeds = { "help", "version", "config", "set", "write-config", "recent",
  "screenshot", "skip-unreadable", "turntable", "force-chart", "trace", "record", "replay", "output",
  "sound-file", "marker-text", "marker-socket" };

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

/// x, y, z of both ends; while a person has chosen only one, there is none to keep.
constexpr std::size_t kNumbersOfDistance = 6;

/// The setting @p name becomes @p value, as the last one, or goes where that is empty: then nobody chose any.
template <typename Value>
void setUnlessEmpty(nlohmann::ordered_json& settings, const char* name, const Value& value)
{
  settings.erase(name);
  if (!value.empty())
  {
    settings[name] = value;
  }
}

/// Puts @p picture in @p settings, by the names of the options; what is as if it were never asked for is left
/// out.
void setPicture(nlohmann::ordered_json& settings, const PictureSettings& picture)
{
  settings["projection"] = picture.parallel ? "parallel" : "perspective";
  settings["stereo"] = picture.stereo;
  settings["background"] = picture.background;
  settings["theme"] = picture.theme;
  settings["point-scale"] = picture.pointScale;
  settings["edl-strength"] = picture.depthStrength;
  settings["font-scale"] = picture.fontScale;
  settings["color-map"] = picture.colorMap;
  settings["transparent"] = picture.transparent;
  setUnlessEmpty(settings, "color-range", picture.colorRange);
  std::vector<std::string> hidden;
  std::transform(picture.hidden.begin(), picture.hidden.end(), std::back_inserter(hidden), textOf);
  setUnlessEmpty(settings, "hide", fmt::format("{}", fmt::join(hidden, ",")));
  const auto& size = picture.screenshotSize;
  setUnlessEmpty(
    settings, "screenshot-size", size[0] > 0 ? fmt::format("{}x{}", size[0], size[1]) : std::string());
  const bool isWhole = picture.measure.size() == kNumbersOfDistance;
  setUnlessEmpty(settings, "measure", isWhole ? picture.measure : decltype(picture.measure)());
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

/// One JSON value as it would stand on the command line. False: objects and null have no such form.
bool argumentOf(const nlohmann::json& value, std::string& text)
{
  if (!value.is_array())
  {
    text = value.is_string() ? value.get<std::string>() : value.dump();
    return value.is_primitive() && !value.is_null();
  }
  text.clear();
  return std::all_of(value.begin(), value.end(),
    [&](const nlohmann::json& element)
    {
      std::string part;
      const bool isPlain = !element.is_array() && argumentOf(element, part);
      text += (text.empty() ? "" : ",") + part;
      return isPlain;
    });
}

using Given = std::set<const CLI::Option*>; ///< On the command line.

/// The command line wins: also over a key that cannot stand beside one of its options.
bool isOverruled(CLI::Option* option, const Given& given)
{
  const std::set<CLI::Option*> others = option->get_excludes();
  return given.count(option) > 0 ||
    std::any_of(others.begin(), others.end(), [&](CLI::Option* other) { return given.count(other) > 0; });
}

std::string applyValue(CLI::Option* option, const std::string& key, const nlohmann::json& value)
{
  std::string text;
  if (!argumentOf(value, text))
  {
    return fmt::format("key \"{}\": give a number, a text, true or false, or a list of numbers", key);
  }
  for (const CLI::Option* other : option->get_excludes())
  {
    if (other->count() > 0)
    {
      return fmt::format(
        "key \"{}\" cannot stand beside \"{}\"; keep one of them", key, other->get_single_name());
    }
  }
  try
  {
    option->add_result(text);
    option->run_callback();
  }
  catch (const CLI::Error& error)
  {
    return fmt::format("key \"{}\": {}", key, error.what());
  }
  return {};
}

std::string applyKeys(CLI::App& command, const nlohmann::json& keys, const std::vector<std::string>& ignored)
{
  Given given;
  for (const CLI::Option* option : command.get_options())
  {
    if (option->count() > 0)
    {
      given.insert(option);
    }
  }
  const std::vector<std::string> names = configurableNames(command);
  for (const auto& item : keys.items())
  {
    if (std::find(ignored.begin(), ignored.end(), item.key()) != ignored.end())
    {
      continue;
    }
    if (std::find(names.begin(), names.end(), item.key()) == names.end())
    {
      return fmt::format("unknown key \"{}\"{}; valid keys: {}", item.key(), didYouMean(item.key(), names),
        fmt::join(names, ", "));
    }
    CLI::Option* option = command.get_option("--" + item.key());
    const std::string problem =
      isOverruled(option, given) ? std::string() : applyValue(option, item.key(), item.value());
    if (!problem.empty())
    {
      return problem;
    }
  }
  return {};
}

} // namespace

std::vector<std::string> configurableNames(CLI::App& command)
{
  const std::set<std::string> others = { "help", "version", "config", "set", "write-config", "recent" };
  std::vector<std::string> names;
  for (const auto& [name, option] : longNames(command))
  {
    names.insert(names.end(), others.count(name) + commonOptions().count(name) == 0 ? 1 : 0, name);
  }
  return names;
}

void takeRecordedReading(const std::string& settings, HapticViewerOptions& viewer)
{
  const nlohmann::json keys = nlohmann::json::parse(settings, nullptr, false, true);
  // Lists and flags as the command line has them.
  const auto text = [&keys](const char* key)
  {
    std::string value;
    return keys.is_object() && keys.contains(key) && argumentOf(keys.at(key), value) ? value : std::string();
  };
  if (!parseNumbers(text("clip"), viewer.clip))
  {
    viewer.clip.clear();
  }
  std::string wrong;
  viewer.picture.hidden = hiddenIn(text("hide"), wrong);
  viewer.up = viewer.up == "auto" && keys.contains("up") ? text("up") : viewer.up;
  const std::string columns = text("columns");
  viewer.columns = columns.empty() ? std::vector<std::string>() : CLI::detail::split(columns, ',');
  viewer.salvage = text("salvage") == "true";
  viewer.vertices = text("vertices") == "true";
  viewer.unitIsChosen = keys.contains("unit");
}

void applyConfigFile(
  CLI::App& command, const std::string& fileName, const std::vector<std::string>& ignored, Files& files)
{
  std::error_code error;
  std::ifstream file(files.input(fileName));
  require(file && !std::filesystem::is_directory(fileName, error),
    fileName + ": cannot be opened; check the name given to --config");
  nlohmann::json keys;
  std::string place;
  try
  {
    keys = nlohmann::json::parse(file, nullptr, true, true);
  }
  catch (const nlohmann::json::parse_error& fault)
  {
    place = fmt::format(" at byte {}", fault.byte);
  }
  requireUsage(keys.is_object(), fileName, "",
    fmt::format("not a JSON object{}; write {{\"stiffness\": 600, \"up\": \"z\"}} for example", place));
  const std::string problem = applyKeys(command, keys, ignored);
  requireUsage(problem.empty(), fileName, "", problem);
  files.take(command);
}

void applySettings(CLI::App& command, const std::vector<std::string>& settings, Files& files)
{
  nlohmann::json keys = nlohmann::json::object();
  for (const std::string& setting : settings)
  {
    const std::size_t equals = setting.find('=');
    requireUsage(
      equals != std::string::npos, "--set", setting, "no value; give NAME=VALUE, such as axes=true");
    const std::string name = setting.substr(0, equals);
    requireUsage(!keys.contains(name), "--set", setting, "is set twice; keep one of them");
    keys[name] = setting.substr(equals + 1);
  }
  const std::string problem = applyKeys(command, keys, {});
  requireUsage(problem.empty(), "--set", "", problem);
  files.take(command);
}

nlohmann::ordered_json givenSettings(CLI::App& command)
{
  nlohmann::ordered_json settings = nlohmann::ordered_json::object();
  for (const auto& [name, option] : longNames(command))
  {
    if (option->count() > 0 && kDeeds.count(name) + commonOptions().count(name) == 0)
    {
      settings[name] = valueOf(*option);
    }
  }
  return settings;
}

void setState(nlohmann::ordered_json& settings, const HapticViewerState& state, double metresPerUnit)
{
  setModel(settings, state, state.unitIsChosen ? state.metresPerUnit : metresPerUnit);
  if (state.unitIsChosen)
  {
    settings["unit"] = state.unit;
  }
  if (state.voxels.lattice.voxelSize > 0.0)
  {
    settings.erase("dims");
    settings["voxel"] = state.voxels.lattice.voxelSize;
  }
  setContact(settings, state.haptics.contact);
  settings["beta"] = state.bandwidth.radiusScale;
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

void writeSettings(const nlohmann::ordered_json& settings, const std::string& fileName)
{
  for (const auto& [name, value] : settings.items())
  {
    require(!value.is_string() || nlohmann::ordered_json::parse(jsonText(value)) == value,
      fmt::format("--{}: its text is no UTF-8, which JSON needs; give another name", name));
  }
  OutputFile file;
  const bool isWritten = file.open(fileName) == Status::Ok &&
    file.write(jsonText(settings, 2) + "\n") == Status::Ok && file.commit() == Status::Ok;
  require(isWritten, writeFault(fileName, file));
}

void setFelt(HapticViewerOptions& viewer, const LatticeOptions& lattice, const BandwidthOptions& bandwidth,
  bool noCovariance)
{
  viewer.transform = lattice.transform();
  viewer.unit = lattice.unit;
  viewer.metresPerUnit = lattice.metresPerUnit();
  viewer.voxels = lattice.voxels;
  if (!lattice.voxelsAreGiven)
  {
    viewer.voxels.lattice.dimensions = { 0, 0, 0 }; // the viewer chooses
  }
  viewer.voxels.computeCovariance = !noCovariance;
  viewer.bandwidth = bandwidth.settings;
  viewer.names = { "--color-by", "--clip", "--felt", kFirmwareOption, "--workspace, --scale and --translate",
    unitOptions(), "--hide" };
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

namespace
{

/// Writes a file beside recentSettingsFile(); what cannot be kept is no reason to complain.
void keep(const nlohmann::ordered_json& settings, const std::string& name)
{
  try
  {
    const std::filesystem::path file(recentSettingsFile());
    if (!file.empty())
    {
      std::filesystem::create_directories(file.parent_path());
      writeSettings(settings, file.parent_path() / name);
    }
  }
  catch (const std::exception&)
  {
  }
}

constexpr const char* kUps = "up.json"; ///< The axes of all files.

nlohmann::ordered_json keptUps()
{
  std::ifstream file(std::filesystem::path(recentSettingsFile()).replace_filename(kUps));
  nlohmann::ordered_json ups = nlohmann::ordered_json::parse(file, nullptr, false);
  return ups.is_object() ? ups : nlohmann::ordered_json::object();
}

std::string keyOf(const std::string& file)
{
  std::error_code error;
  return std::filesystem::absolute(file, error).string();
}

} // namespace

std::string keptUp(const std::string& file)
{
  const nlohmann::ordered_json ups = keptUps();
  const auto found = ups.find(keyOf(file));
  return found != ups.end() && found->is_string() ? found->get<std::string>() : std::string();
}

void keepUp(const std::string& file, const std::string& axis)
{
  nlohmann::ordered_json ups = keptUps();
  ups[keyOf(file)] = axis;
  keep(ups, kUps);
}

void rememberSettings(nlohmann::ordered_json settings)
{
  for (const char* name : kOfTheCloud)
  {
    settings.erase(name);
  }
  keep(settings, std::filesystem::path(recentSettingsFile()).filename());
}

} // namespace pointhaptics::app
