#include "View/ViewOptions.h"

#include "Clouds/Pipeline.h"
#include "Options/ConfigFile.h"
#include "Options/OptionParsing.h"
#include "Terminal/KeyedHelp.h"
#include "Terminal/Messages.h"
#include "View/PictureOptions.h"
#include "View/ViewSettings.h"

#include "CommandRegistry.h"
#include "Gesture.h"
#include "HapticViewer.h"
#include "Recording.h"

#include "Shapes/Shapes.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>

namespace pointhaptics::app
{
namespace
{

/// Most pictures of a turntable.
constexpr std::int64_t kMostPictures = 9999;

/// Ends the parse where @p text is not ACTION=GESTURES.
void checkBinding(const std::string& text)
{
  const std::size_t equals = text.find('=');
  const std::string action = text.substr(0, equals);
  const CommandRegistry commands = HapticViewer::commands();
  if (equals == std::string::npos || !commands.get(action))
  {
    throwUsage("--bind", text,
      fmt::format("{}{}; give ACTION=KEY, such as help=F1, with one of: {}",
        equals == std::string::npos ? "no key" : "no such action", didYouMean(action, commands.names()),
        fmt::join(commands.names(), ", ")));
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
  const auto keepBindings = [&options](const std::vector<std::string>& bindings)
  {
    std::for_each(bindings.begin(), bindings.end(), checkBinding);
    options.viewer.bindings = bindings;
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
  command.add_flag("--sound", options.viewer.sound)->group(group);
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

/// Adds the options for files that a touch writes, and for a recording that is felt again.
void addTouchFileOptions(CLI::App& command, HapticViewerOptions& viewer)
{
  addOutput(
    command, "--force-chart", viewer.forceChart, { "png" }, "Write force and proxy radius over time as a PNG")
    ->type_name("OUT.png");
  addOutput(command, "--record", viewer.record, { "csv" },
    "Record the touch, from the first tick to the last, for --replay; a key records, too")
    ->type_name("REC.csv");
  command
    .add_option(
      "--marker-text", viewer.markerText, "What the recording says of the markers that the key sets")
    ->type_name("TEXT");
  addInteger(
    command, "--marker-socket", [&viewer](std::int64_t port) { viewer.markerPort = int(port); }, 0, 65535,
    "Each line of text that comes to this port of this machine is a marker of the recording, with its time");
  addInput(command, "--replay", viewer.replay,
    "Feel and show this recording again, with its settings and motions of the model: the same forces to "
    "the last bit")
    ->type_name("REC.csv");
  addOutput(command, "--trace", viewer.trace, { "csv" }, "Write one row per tick, as feel does")
    ->type_name("OUT.csv");
}

/// Keys are looked up for a help that is shown: it takes longer than to add the options.
void describeOptionsWhenShown(CLI::App& command, const std::vector<std::string>& bindings)
{
  command.formatter_fn(
    [&command, &bindings, usual = command.get_formatter()](
      const CLI::App* shown, const std::string& name, CLI::AppFormatMode mode)
    {
      describeKeyedOptions(command, bindings);
      return usual->make_help(shown, name, mode);
    });
}

} // namespace

void ViewOptions::addTo(CLI::App& command)
{
  addInput(command, "FILE", this->files,
    "Point clouds: PLY, PCD, LAS, LAZ, E57, VTP, OBJ or columns of text; one that cannot be read is skipped "
    "where there are others, but with --together; with --replay those that were recorded are the "
    "default; - is standard input");
  command.add_flag("--together", this->viewer.together);
  command.add_flag("--watch", this->viewer.watch, "Read a file again when it changes");
  addOutput(
    command, "--screenshot", this->screenshot, { "png" }, "Write this PNG instead of opening a window");
  command.add_flag("--skip-unreadable", this->skipsUnreadable,
    "Pictures: show what can be read of several files; without it one that cannot is an error");
  const auto keepSize = [this](int width, int height)
  {
    this->viewer.width = width;
    this->viewer.height = height;
  };
  addInteger(
    command, "--turntable", [this](std::int64_t pictures) { this->viewer.turntable = int(pictures); }, 2,
    kMostPictures, "");
  addSize(command, "--size", keepSize, "Size of the window or picture; default 1280x800");
  addInput(command, "--path", this->viewer.path,
    "Follow the hand path in this file: t,x,y,z, or what feel or --trace wrote")
    ->type_name("HIP.csv");
  addPathUnits(command, this->viewer.pathUnits);
  addWord(command, "--device", this->device, { "auto", "falcon", "simulated", "none" },
    "What moves the hand; default auto: a Falcon where one can be used, else the simulated hand, driven by "
    "mouse and keys; falcon is an error where none can be used, also with --screenshot and --path");
  this->falcon.addTo(command);
  addInput(
    command, "--config", this->config, "Defaults for these options, a JSON object; the command line wins")
    ->type_name("FILE.json");
  addOutput(command, "--write-config", this->writeConfig, { "json" }, "")->type_name("OUT.json");
  command.add_flag("--recent", this->recent, "Begin with the settings the last window ended with");
  addTouchFileOptions(command, this->viewer);
  addWord(command, "--up", this->viewer.up, { "auto", "x", "-x", "y", "-y", "z", "-z" },
    "Axis of the cloud that points up; default: a guess, or as it was turned in a window before");
  addWord(command, "--kind", this->viewer.kind, { "auto", "object", "terrain", "sweep", "indoors", "frame" },
    "What the cloud is, and so from where it is seen and how it is drawn; default: a guess");
  addClip(command, this->viewer.clip, "");
  command.add_flag("--felt", this->viewer.felt);
  command.add_option("--color-by", this->viewer.colorBy)->type_name("ARRAY[:COMPONENT]");
  addNumber(command, "--point-size", this->viewer.pointSize, { 1.0, 50.0 }, "PIXELS",
    "Diameter of a point; default: from the spacing of its neighbours, so that surfaces close");
  addPictureOptions(command, this->viewer.picture);
  addResolution(command, this->viewer.resolution);
  addReading(command, this->viewer.columns, this->viewer.salvage);
  addVertices(command, this->viewer.vertices);
  addWindowOptions(command, *this);
  this->touch.addTo(command);
  command.add_flag("--no-covariance", this->noCovariance, "Feel plain voxel means, without second moments")
    ->group("Touch");
  this->bandwidth.addTo(command);
  this->lattice.addTo(command);
  describeOptionsWhenShown(command, this->viewer.bindings);
  command.get_option("--dims")->description(
    "Voxels on each axis of the lattice, everywhere; default 300, up to 1200 where these leave little of a "
    "cloud, and near the hand, where that tells more, voxels about as fine as the points");
}

void ViewOptions::readConfig(CLI::App& command)
{
  std::error_code missing;
  if (this->recent && this->config.empty() && std::filesystem::exists(recentSettingsFile(), missing))
  {
    this->config = recentSettingsFile();
  }
  if (!this->config.empty())
  {
    applyConfigFile(command, this->config, {});
  }
}

/// Ends in a usage error where files that are to be written cannot be.
void ViewOptions::checkFiles() const
{
  const std::string& chart = this->viewer.forceChart;
  const std::string& trace = this->viewer.trace;
  if (this->viewer.turntable > 0 && (this->screenshot.empty() || this->screenshot == kStandardStream))
  {
    throwUsage("--turntable", std::to_string(this->viewer.turntable),
      "no picture is to be written; give the name of the first by --screenshot, or turn in the window by its "
      "key");
  }
  if (this->files.empty() && this->viewer.replay.empty() && this->writeConfig.empty())
  {
    throwUsage("FILE", "(none)", "name a point cloud to show, or a recording by --replay");
  }
  if (!this->viewer.record.empty() && (!this->needsWindow() || this->device == "none"))
  {
    throwUsage("--record", this->viewer.record,
      "nobody touches what has no window; leave out --screenshot, "
      "--trace and --force-chart of a --path, and --device none; feel --record records a path");
  }
  if (this->needsWindow() && this->device != "none")
  {
    checkForceLimitOfDevices(this->touch.parameters.contact,
      this->viewer.path.empty()
        ? ", or --device none"
        : ", or --device none; --screenshot, --trace and --force-chart follow a path without a device, too");
  }
  if (!this->viewer.followsFile() && !this->screenshot.empty() && (!trace.empty() || !chart.empty()))
  {
    throwUsage(trace.empty() ? "--force-chart" : "--trace", trace.empty() ? chart : trace,
      "nothing is felt in a still picture; give the hand's path with --path");
  }
}

/// Ends in a usage error where standard input is to be shown, and cannot be as asked for.
void ViewOptions::checkStandardInput() const
{
  const auto times = std::count(this->files.begin(), this->files.end(), kStandardStream);
  if (times == 0)
  {
    return;
  }
  if (this->viewer.watch)
  {
    throwUsage(
      "--watch", "", "standard input is read once and does not change; leave it out, or name a file");
  }
  if (!this->writeConfig.empty())
  {
    throwUsage("--write-config", this->writeConfig,
      "settings are written without reading a cloud; leave out -, or --write-config");
  }
}

/// The cloud of a recording, and the box that it was felt in.
void ViewOptions::takeRecording()
{
  Recording recording;
  std::string message;
  if (!readRecording(this->viewer.replay, recording, message))
  {
    throw Failure(message);
  }
  if (!recording.note.empty())
  {
    warn("view", recording.note, this->viewer.replay);
  }
  if (this->files.empty())
  {
    this->files = recording.header.cloud.files;
    this->viewer.resolution = recording.header.cloud.resolution;
    this->viewer.together = this->files.size() > 1;
  }
  RecordedReading reading = recordedReading(recording.header.settings);
  this->viewer.clip = std::move(reading.clip);
  std::string wrong;
  this->viewer.picture.hidden = hiddenIn(reading.hide, wrong);
  this->viewer.up = this->viewer.up == "auto" ? reading.up : this->viewer.up;
  this->viewer.columns = std::move(reading.columns);
  this->viewer.salvage = reading.salvage;
  this->viewer.vertices = reading.vertices;
}

/// Warns of options of the command line that have no effect beside the others.
void ViewOptions::warnOfIdle(const CLI::App& command, const std::vector<std::string>& named) const
{
  if (this->viewer.path.empty())
  {
    warnIdle(command, named, { "path-unit", "path-time-unit" }, "without --path");
  }
  if (this->device == "simulated" || this->device == "none")
  {
    warnIdle(command, named, { "falcon-firmware" }, "with --device " + this->device);
  }
  if (this->needsWindow())
  {
    warnIdle(command, named, { "skip-unreadable" }, "in a window");
  }
  else
  {
    warnIdle(command, named,
      { "bind", "full-screen", "marker-socket", "marker-text", "push-pointer", "sound", "watch" },
      "without a window");
  }
}

void ViewOptions::complete(CLI::App& command)
{
  const std::vector<std::string> named = givenOptions(command);
  if (!this->viewer.replay.empty())
  {
    refuseRecorded(command, named, this->viewer.replay);
  }
  this->readConfig(command);
  this->checkFiles();
  this->checkStandardInput();
  if (!this->viewer.replay.empty())
  {
    this->takeRecording();
  }
  if (this->writeConfig.empty())
  {
    this->warnOfIdle(command, named);
  }
  this->touch.complete(command);
  this->falcon.complete(command, this->touch.parameters.contact);
  this->completeViewer(command);
  this->given = givenSettings(command);
}

/// Sets options that follow from several others, or have another form in the viewer.
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
  options.names = { "--color-by", "--clip", "--felt", kFirmwareOption, "--workspace, --scale and --translate",
    unitOptions(), "--hide" };
}

void ViewOptions::declareMore(Files& taken) const
{
  for (const std::string& file : this->viewer.replay.empty() ? std::vector<std::string>() : this->files)
  {
    taken.addInput(file);
  }
  if (this->viewer.turntable > 0)
  {
    taken.dropOutput(this->screenshot);
  }
  for (int picture = 1; picture <= this->viewer.turntable; ++picture)
  {
    taken.addOutput(HapticViewer::pictureName(this->screenshot, picture, this->viewer.turntable));
  }
  // A person cannot repeat exactly what she did in a window.
  for (const std::string& output : { this->viewer.record, this->needsWindow() ? this->viewer.trace : "" })
  {
    taken.keep(output);
  }
  const bool isCopied = !this->viewer.record.empty() &&
    std::any_of(this->files.begin(), this->files.end(),
      [&taken](const std::string& file) { return taken.isStream(file); });
  if (isCopied)
  {
    taken.addOutput(keptCloudName(this->viewer.record));
  }
}

bool ViewOptions::needsWindow() const
{
  const bool writesTouch = !this->viewer.forceChart.empty() || !this->viewer.trace.empty();
  return this->screenshot.empty() && (!this->viewer.followsFile() || !writesTouch);
}

bool ViewOptions::draws() const
{
  return this->needsWindow() || !this->screenshot.empty() || !this->viewer.forceChart.empty();
}

} // namespace pointhaptics::app
