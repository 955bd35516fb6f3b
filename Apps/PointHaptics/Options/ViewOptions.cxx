#include "Options/ViewOptions.h"

#include "Options/OptionParsing.h"
#include "Options/PictureOptions.h"
#include "Options/ViewSettings.h"
#include "Terminal/KeyedHelp.h"
#include "Terminal/Messages.h"

#include "CommandRegistry.h"
#include "Gesture.h"
#include "HapticViewer.h"

#include "Shapes/Shapes.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

namespace pointhaptics
{
namespace app
{
namespace
{

constexpr int kLargestPicture = 16384;

/// One JSON value as it would stand on the command line. False: objects and null have no such form.
bool textOf(const nlohmann::json& value, std::string& text)
{
  if (value.is_string())
  {
    text = value.get<std::string>();
    return true;
  }
  if (value.is_array())
  {
    text.clear();
    for (const nlohmann::json& element : value)
    {
      std::string part;
      if (element.is_array() || !textOf(element, part))
      {
        return false;
      }
      text += (text.empty() ? "" : ",") + part;
    }
    return true;
  }
  if (value.is_boolean() || value.is_number())
  {
    text = value.dump();
    return true;
  }
  return false;
}

/// Long names of the options a configuration file may set, without the dashes.
std::vector<std::string> configurableNames(CLI::App& command)
{
  std::vector<std::string> names;
  for (const CLI::Option* option : command.get_options())
  {
    for (const std::string& name : option->get_lnames())
    {
      const std::set<std::string> others = { "help", "version", "config", "write-config", "recent" };
      if (others.count(name) == 0)
      {
        names.push_back(name);
      }
    }
  }
  return names;
}

bool isGivenOnCommandLine(const CLI::Option* option, const std::vector<const CLI::Option*>& given)
{
  return std::find(given.begin(), given.end(), option) != given.end();
}

/// The command line wins: also over a key that cannot stand beside one of its options.
bool isOverruled(CLI::Option* option, const std::vector<const CLI::Option*>& given)
{
  if (isGivenOnCommandLine(option, given))
  {
    return true;
  }
  for (CLI::Option* other : given.empty() ? std::set<CLI::Option*>() : option->get_excludes())
  {
    if (isGivenOnCommandLine(other, given))
    {
      return true;
    }
  }
  return false;
}

std::string applyValue(CLI::Option* option, const std::string& key, const nlohmann::json& value)
{
  std::string text;
  if (!textOf(value, text))
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

std::string applyKeys(CLI::App& command, const nlohmann::json& keys)
{
  std::vector<const CLI::Option*> given;
  for (const CLI::Option* option : command.get_options())
  {
    if (option->count() > 0)
    {
      given.push_back(option);
    }
  }
  const std::vector<std::string> names = configurableNames(command);
  for (const auto& item : keys.items())
  {
    if (std::find(names.begin(), names.end(), item.key()) == names.end())
    {
      return fmt::format("unknown key \"{}\"; valid keys: {}", item.key(), fmt::join(names, ", "));
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

/// Ends the parse where @p text is not ACTION=GESTURES.
void checkBinding(const std::string& text)
{
  const std::size_t equals = text.find('=');
  const std::string action = text.substr(0, equals);
  const CommandRegistry commands = HapticViewer::commands();
  if (equals == std::string::npos || !commands.get(action))
  {
    throwUsage("--bind", text,
      fmt::format("{}; give ACTION=KEY, such as help=F1, with one of: {}",
        equals == std::string::npos ? "no key" : "no such action", fmt::join(commands.names(), ", ")));
  }
  std::istringstream gestures(text.substr(equals + 1));
  for (std::string gesture; gestures >> gesture;)
  {
    if (!isGesture(gesture))
    {
      throwUsage("--bind", text,
        fmt::format("\"{}\" is no key or gesture; give names such as F1, plus, Ctrl+z, Shift+left or hand1, "
                    "with blanks between them",
          gesture));
    }
  }
}

std::string checkCamera(const std::vector<double>& numbers)
{
  const Vec3 direction{ numbers[3] - numbers[0], numbers[4] - numbers[1], numbers[5] - numbers[2] };
  const Vec3 up{ numbers[6], numbers[7], numbers[8] };
  return norm(cross(direction, up)) > 0.0
    ? ""
    : "no view; give different points, and an upward direction that is not along the view";
}

void addWindowOptions(CLI::App& command, ViewOptions& options)
{
  const char* const group = "Window";
  const auto keepBindings = [&options, &command](const std::vector<std::string>& bindings)
  {
    std::for_each(bindings.begin(), bindings.end(), checkBinding);
    options.viewer.bindings = bindings;
    describeKeyedOptions(command, bindings); // for a --help beside it
  };
  command
    .add_option_function<std::vector<std::string>>("--bind", keepBindings,
      "Gives an action other keys or gestures, such as help=F1 or translate-model-by-hand=hand2; several "
      "separated by commas")
    ->delimiter(',')
    ->type_name("ACTION=KEY,...")
    ->group(group);
  addNumbers(command, "--camera", options.viewer.camera, { 9 }, checkCamera, "X,Y,Z,FX,FY,FZ,UX,UY,UZ",
    "Where the person looks from, at, and what is up; metres of the workspace; default: from in front")
    ->group(group);
  command.add_flag("--push-pointer", options.viewer.pushPointer)->group(group);
  command.add_flag("--axes", options.viewer.axes)->group(group);
  command.add_flag("--figure", options.viewer.figure)->group(group);
  command.add_flag("--ambient", options.viewer.ambient)->group(group);
  command.add_flag("--full-screen", options.viewer.fullScreen)->group(group);
  std::vector<std::string> shapes = { "auto", "none" };
  for (int shape = 0; shape < kNumberOfShapes; ++shape)
  {
    shapes.emplace_back(shapeName(static_cast<Shape>(shape)));
  }
  addWord(command, "--ideal", options.viewer.ideal, shapes,
    "The chart shows the exact force of this shape of generate too; default auto: where the cloud is one, "
    "without noise")
    ->group(group);
}

} // namespace

void ViewOptions::addTo(CLI::App& command)
{
  command
    .add_option("FILE", this->files,
      "Point clouds: PLY, PCD, LAS, VTP, OBJ or columns of text; one that cannot be read is skipped "
      "where there are others, but with --together")
    ->required();
  command.add_flag("--together", this->viewer.together);
  command.add_flag("--watch", this->viewer.watch, "Read a file again when it changes");
  command.add_option("--screenshot", this->screenshot, "Write this PNG instead of opening a window");
  command
    .add_option_function<std::string>(
      "--size",
      [this](const std::string& text)
      {
        char rest = 0;
        if (std::sscanf(text.c_str(), "%dx%d%c", &this->viewer.width, &this->viewer.height, &rest) != 2 ||
          this->viewer.width < 16 || this->viewer.height < 16 || this->viewer.width > kLargestPicture ||
          this->viewer.height > kLargestPicture)
        {
          throwUsage("--size", text, fmt::format("give WIDTHxHEIGHT in pixels, 16 to {}", kLargestPicture));
        }
      },
      "Size of the window or picture; default 1280x800")
    ->type_name("WxH");
  command
    .add_option("--path", this->viewer.path,
      "Follow the hand path in this file: t,x,y,z, or what feel or --trace wrote")
    ->type_name("HIP.csv");
  addWord(command, "--device", this->device, { "auto", "falcon", "simulated", "none" },
    "What moves the hand; default auto: a Falcon where one can be used, else the simulated hand, driven by "
    "mouse and keys; falcon is an error where none can be used, also with --screenshot and --path");
  this->falcon.addTo(command);
  command
    .add_option("--config", this->config, "Defaults for these options, a JSON object; the command line wins")
    ->type_name("FILE.json");
  command.add_option("--write-config", this->writeConfig)->type_name("OUT.json");
  command.add_flag("--recent", this->recent, "Begin with the settings the last window ended with");
  command
    .add_option("--force-chart", this->viewer.forceChart, "Write force and proxy radius over time as a PNG")
    ->type_name("OUT.png");
  command.add_option("--trace", this->viewer.trace, "Write one row per tick, as feel does")
    ->type_name("OUT.csv");
  addWord(command, "--up", this->viewer.up, { "auto", "x", "-x", "y", "-y", "z", "-z" },
    "Axis of the cloud that points up; default: a guess");
  addWord(command, "--kind", this->viewer.kind, { "auto", "object", "terrain", "sweep", "indoors", "frame" },
    "What the cloud is, and so from where it is seen and how it is drawn; default: a guess");
  command.add_flag("--felt", this->viewer.felt);
  command.add_option("--color-by", this->viewer.colorBy)->type_name("ARRAY[:COMPONENT]");
  addNumber(command, "--point-size", this->viewer.pointSize, { 1.0, 50.0 }, "PIXELS",
    "Diameter of a point; default: from the spacing of its neighbours, so that surfaces close");
  addPictureOptions(command, this->viewer.picture);
  addResolution(command, this->viewer.resolution);
  command.add_flag("-v,--verbose", this->verbose, "Say on stderr what takes how long");
  addWindowOptions(command, *this);
  this->touch.addTo(command);
  command.add_flag("--no-covariance", this->noCovariance, "Feel plain voxel means, without second moments")
    ->group("Touch");
  this->bandwidth.addTo(command);
  this->lattice.addTo(command);
  describeKeyedOptions(command, {});
  command.get_option("--dims")->description(
    "Voxels on each axis of the lattice, everywhere; default 300, up to 1200 where these leave little of a "
    "cloud, and near the hand, where that tells more, voxels about as fine as the points");
}

bool ViewOptions::readConfig(CLI::App& command, std::string& message)
{
  std::error_code missing;
  if (this->recent && this->config.empty() && std::filesystem::exists(recentSettingsFile(), missing))
  {
    this->config = recentSettingsFile();
  }
  if (this->config.empty())
  {
    return true;
  }
  std::error_code error;
  std::ifstream file(this->config);
  if (!file || std::filesystem::is_directory(this->config, error))
  {
    message = fmt::format("{}: cannot be opened; check the name given to --config", this->config);
    return false;
  }
  const nlohmann::json keys = nlohmann::json::parse(file, nullptr, false, true);
  if (!keys.is_object())
  {
    message = fmt::format(
      "{}: not a JSON object; write {{\"stiffness\": 600, \"up\": \"z\"}} for example", this->config);
    return false;
  }
  const std::string problem = applyKeys(command, keys);
  message = problem.empty() ? std::string() : fmt::format("{}: {}", this->config, problem);
  return problem.empty();
}

/// Ends in a usage error where files that are to be written cannot be.
void ViewOptions::checkFiles() const
{
  const std::string& chart = this->viewer.forceChart;
  const std::string& trace = this->viewer.trace;
  for (const auto& [option, name] :
    { std::pair{ "--screenshot", &this->screenshot }, std::pair{ "--force-chart", &chart } })
  {
    if (!name->empty() && std::filesystem::path(*name).extension() != ".png")
    {
      throwUsage(option, *name, "pictures are written as PNG; end the name in .png");
    }
  }
  if (this->viewer.path.empty() && !this->screenshot.empty() && (!trace.empty() || !chart.empty()))
  {
    throwUsage(trace.empty() ? "--force-chart" : "--trace", trace.empty() ? chart : trace,
      "nothing is felt in a still picture; give the hand's path with --path");
  }
}

bool ViewOptions::complete(CLI::App& command, std::string& message)
{
  if (!this->readConfig(command, message))
  {
    return false;
  }
  this->checkFiles();
  this->touch.complete(command);
  this->completeViewer(command);
  this->given = givenSettings(command);
  return true;
}

/// What follows from several options, or has another form in the viewer.
void ViewOptions::completeViewer(CLI::App& command)
{
  HapticViewerOptions& options = this->viewer;
  for (const char* name : { "--unit", "--scale", "--matrix", "--translate", "--workspace" })
  {
    options.fitsWorkspace = options.fitsWorkspace && command.get_option(name)->count() == 0;
  }
  options.transform = this->lattice.transform();
  options.unit = this->lattice.unit;
  options.metresPerUnit = this->lattice.metresPerUnit();
  options.unitIsChosen = command.count("--unit") > 0;
  options.voxels = this->lattice.voxels;
  if (!this->lattice.voxelsAreGiven)
  {
    options.voxels.lattice.dimensions = { 0, 0, 0 }; // the viewer chooses
  }
  options.voxels.computeCovariance = !this->noCovariance;
  options.bandwidth = this->bandwidth.settings;
  options.haptics = this->touch.parameters;
  options.device = this->device == "falcon" ? HapticViewerDevice::Falcon
    : this->device == "simulated"           ? HapticViewerDevice::Simulated
    : this->device == "none"                ? HapticViewerDevice::None
                                            : HapticViewerDevice::Auto;
  options.falcon = this->falcon.settings();
  options.showsReading = this->needsWindow();
  options.names = { "--color-by", kFirmwareOption, "--workspace, --scale and --translate" };
}

bool ViewOptions::needsWindow() const
{
  const bool writesTouch = !this->viewer.forceChart.empty() || !this->viewer.trace.empty();
  return this->screenshot.empty() && (this->viewer.path.empty() || !writesTouch);
}

bool ViewOptions::draws() const
{
  return this->needsWindow() || !this->screenshot.empty() || !this->viewer.forceChart.empty();
}

} // namespace app
} // namespace pointhaptics
