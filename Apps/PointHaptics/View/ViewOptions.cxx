#include "View/ViewCommand.h"

#include "Commands/Commands.h"
#include "Feel/FeelReplay.h"
#include "Options/OptionParsing.h"
#include "Terminal/Messages.h"
#include "View/ViewSettings.h"

#include "ClippedCloud.h"
#include "CloudAppearance.h"
#include "ColorMaps.h"
#include "CommandRegistry.h"
#include "Gesture.h"
#include "HapticViewer.h"
#include "Recording.h"
#include "StereoPicture.h"

#include "Shapes/Shapes.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>

namespace pointhaptics::app
{
namespace
{

constexpr std::int64_t kMostPictures = 9999;

/// Ends the parse where @p text is not ACTION=GESTURES.
void checkBinding(const std::string& text)
{
  const std::size_t equals = text.find('=');
  const std::string action = text.substr(0, equals);
  const CommandRegistry commands = HapticViewer::commands();
  const bool isAction = commands.get(action) != nullptr;
  requireUsage(isAction && equals != std::string::npos, "--bind", text,
    fmt::format("{}{}; give ACTION=KEY, such as help=Ctrl+h, with one of: {}",
      isAction ? "no key" : "no such action", isAction ? "" : didYouMean(action, commands.names()),
      fmt::join(commands.names(), ", ")));
  std::istringstream gestures(text.substr(equals + 1));
  for (std::string gesture; gestures >> gesture;)
  {
    requireUsage(isGesture(gesture), "--bind", text,
      fmt::format("\"{}\" is no key or gesture; give names such as F1, plus, Ctrl+z, Shift+left or hand1, "
                  "with blanks between them",
        gesture));
  }
}

/// Warns of commands that lose their last key to @p bindings, unless these say so.
void warnOfLostKeys(const std::vector<std::string>& bindings)
{
  const CommandRegistry usual = HapticViewer::commands();
  CommandRegistry table = HapticViewer::commands();
  table.bind(bindings);
  for (const std::string& name : table.names())
  {
    const bool isMeant = std::any_of(bindings.begin(), bindings.end(),
      [&](const std::string& binding) { return binding.rfind(name + "=", 0) == 0; });
    const std::string lost = isMeant || !table.bindings(name).empty() ? "" : usual.bindings(name);
    warn(lost.empty()
        ? lost
        : fmt::format("--bind takes {}, all the keys it has, from {}; give that another, too, or {}=", lost,
            name, name));
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

/// Ends the parts of a keyed() text.
constexpr char kMark = '\x1f';

/// Help of an option that a key does too: @p commands are the names of those that the keys run, with blanks
/// between them, the option's own where empty; @p rest is what the key does besides.
std::string keyed(const std::string& text, const std::string& commands = {}, const std::string& rest = {})
{
  return text + kMark + commands + kMark + rest;
}

void addPictureOptions(CLI::App& command, PictureSettings& picture)
{
  const OptionGroup group(command, "Picture");
  addChoice(command, "--projection", picture.parallel, { { "perspective", false }, { "parallel", true } },
    keyed("How the cloud is seen: perspective (the default), or parallel, without perspective"));
  addWord(command, "--stereo", picture.stereo, stereoNames(),
    keyed(
      "A picture for each eye: by colours for red and cyan, or red and blue glasses, by lines, by pixels, "
      "beside each other, or on a screen that shows two"));
  addWord(command, "--background", picture.background, groundNames(),
    keyed("What is behind the cloud; default dark"));
  addWord(command, "--theme", picture.theme, themeNames(),
    keyed("high-contrast: black or white background, larger texts on opaque plates, thick outlines and other "
          "colours of the marks of touch; default usual"));
  addNumber(command, "--point-scale", picture.pointScale, { 0.1, 10.0 }, "FACTOR",
    keyed("All points are drawn this many times as large", "points-larger points-smaller"));
  addNumber(command, "--edl-strength", picture.depthStrength, { 0.0, 10.0 }, "STRENGTH",
    keyed(
      "How much darker points are that lie behind those around them (eye-dome lighting); 0: none; default "
      "1.6",
      "depth-stronger depth-weaker"));
  addNumber(command, "--font-scale", picture.fontScale, { 0.5, 4.0 }, "FACTOR",
    "Size of all texts over the usual one, which follows the screen's dots per inch; default 1");
  addWord(
    command, "--color-map", picture.colorMap, colorMapNames(), keyed("The colours that stand for numbers"));
  const auto checkRange = [](const std::vector<double>& range)
  { return range[0] < range[1] ? "" : "the first colour's value must be less than the last one's"; };
  addNumbers(command, "--color-range", picture.colorRange, { 2 }, checkRange, "LOW,HIGH",
    keyed(
      "The values that have the first and the last of these colours; default: nearly all that occur; drag "
      "on the colour bar to change them",
      "", " takes all again"));
  const auto hide = [&picture](const std::string& text)
  {
    std::string wrong;
    picture.hidden = hiddenIn(text, wrong);
    requireUsage(wrong.empty(), "--hide", wrong,
      "no values; give ARRAY=VALUE or ARRAY=LOW:HIGH, such as Classification=7");
  };
  command
    .add_option_function<std::string>("--hide", hide,
      keyed("Neither shows nor lets feel these values: Classification=7,intensity=:20", "hide-outside"))
    ->type_name("ARRAY=VALUE,...");
  const auto checkEnds = [](const std::vector<double>& ends)
  {
    return std::equal(ends.begin(), ends.begin() + 3, ends.begin() + 3)
      ? "both are the same place; give two, in coordinates of the file"
      : "";
  };
  addNumbers(command, "--measure", picture.measure, { 6 }, checkEnds, "X,Y,Z,X,Y,Z",
    keyed("Shows the distance of two places of the file, in its coordinates and its unit", "",
      " measures between points that are clicked on"));
  addSize(command, "--screenshot-size", picture.screenshotSize[0], picture.screenshotSize[1],
    keyed("Size of pictures that are written, whatever the window's is; they show at least what it shows; "
          "default: the window's, or --size",
      "screenshot", " writes one"));
  command.add_flag(
    "--transparent", picture.transparent, "Pictures have no background: what they are laid on shows through");
}

void addWindowOptions(CLI::App& command, ViewCommand& options)
{
  const OptionGroup group(command, "Window");
  const auto keepBindings = [&options](const std::vector<std::string>& bindings)
  {
    std::for_each(bindings.begin(), bindings.end(), checkBinding);
    warnOfLostKeys(bindings);
    options.viewer.bindings = bindings;
  };
  command
    .add_option_function<std::vector<std::string>>("--bind", keepBindings,
      "Gives an action other keys or gestures, such as help=Ctrl+h or rotate-x=Ctrl+x; several "
      "separated by commas")
    ->delimiter(',')
    ->type_name("ACTION=KEY,...");
  addNumbers(command, "--camera", options.viewer.camera, { 9 }, checkCamera, "X,Y,Z,FX,FY,FZ,UX,UY,UZ",
    "Where the person looks from, at, and what is up; metres of the workspace; default: from in front");
  const auto addFlag = [&](const char* name, bool& flag, const char* text)
  { command.add_flag(name, flag, keyed(text)); };
  addFlag("--push-pointer", options.viewer.pushPointer,
    "The touch pushes the mouse pointer while the hand follows it");
  addFlag("--axes", options.viewer.axes,
    "A box about the cloud with its bounds in metres of the file, and where its axes point");
  addFlag("--figure", options.viewer.figure,
    "Nothing but the cloud in one colour on white, the workspace, proxy and normal");
  addFlag("--ambient", options.viewer.ambient,
    "Light from the normals of the felt surface: the shape of a cloud without colours");
  addFlag("--full-screen", options.viewer.fullScreen, "The window covers the screen, without a border");
  addFlag("--sound", options.viewer.sound,
    "Hear the touch: a tone as loud as the force, a click where contact begins");
  std::vector<std::string> shapes = { "auto", "none" };
  for (int shape = 0; shape < kNumberOfShapes; ++shape)
  {
    shapes.emplace_back(shapeName(static_cast<Shape>(shape)));
  }
  addWord(command, "--ideal", options.viewer.ideal, shapes,
    "The chart shows the exact force of this shape of generate too; default auto: where the cloud is one, "
    "without noise");
}

/// Adds the options for files that a touch writes, and for a recording that is felt again.
void addTouchFileOptions(CLI::App& command, HapticViewerOptions& viewer)
{
  addOutput(command, "--force-chart", viewer.forceChart, { "png" },
    "Write force and proxy radius over time as a PNG", "OUT.png");
  addOutput(command, "--record", viewer.record, { "csv" },
    "Record the touch, from the first tick to the last, for --replay; a key records, too", "REC.csv");
  command
    .add_option(
      "--marker-text", viewer.markerText, "What the recording says of the markers that the key sets")
    ->type_name("TEXT");
  addInteger(command, "--marker-socket", viewer.markerPort, 0, 65535,
    "Each line of text that comes to this port of this machine is a marker of the recording, with its time");
  addInput(command, "--replay", viewer.replay,
    "Feel and show this recording again, with its settings and motions of the model: the same forces to "
    "the last bit",
    "REC.csv");
  addOutput(command, "--trace", viewer.trace, { "csv" }, "Write one row per tick, as feel does", "OUT.csv");
}

void addLook(CLI::App& command, HapticViewerOptions& viewer)
{
  addWord(command, "--up", viewer.up, { "auto", "x", "-x", "y", "-y", "z", "-z" },
    "Axis of the cloud that points up; default: a guess, or as it was turned in a window before");
  addWord(command, "--kind", viewer.kind, { "auto", "object", "terrain", "sweep", "indoors", "frame" },
    "What the cloud is, and so from where it is seen and how it is drawn; default: a guess");
  addClip(command, viewer.clip,
    keyed("Shows, lets feel and pick only what lies in this box, in coordinates of the file; default: all",
      "clip-box", " shows its handles"));
  command.add_flag("--felt", viewer.felt, keyed("Show the voxel means that are felt instead of the points"));
  command
    .add_option("--color-by", viewer.colorBy,
      keyed(
        "Array to colour by: rgb, clay (one colour), height, density, proxyradius, residual (the distance "
        "of each voxel mean from the surface that is felt) or one of the file, in upper or lower case, "
        "with :x, :0 or :magnitude for a component of a vector; default: rgb, classification, clay or "
        "height, what suits",
        "colors"))
    ->type_name("ARRAY[:COMPONENT]");
  addNumber(command, "--point-size", viewer.pointSize, { 1.0, 50.0 }, "PIXELS",
    "Diameter of a point; default: from the spacing of its neighbours, so that surfaces close");
  addPictureOptions(command, viewer.picture);
}

/// Options that the help only names: it is to be read in a minute.
constexpr const char* kRare[] = { "skip-unreadable", "path-unit", "path-time-unit", "falcon-firmware",
  "marker-text", "marker-socket", "stereo", "theme", "edl-strength", "font-scale", "color-map", "color-range",
  "measure", "screenshot-size", "transparent", "bind", "camera", "push-pointer", "ambient", "sound", "ideal",
  "preset", "damping", "mu-s", "no-covariance", "neighbors", "radius", "rule", "beta", "r1", "r2" };

/// Leaves the rare options out of the help, but for their names.
void hideRareOptions(CLI::App& command)
{
  for (const char* name : kRare)
  {
    command.get_option(fmt::format("--{}", name))->group("");
  }
  command.footer(fmt::format("Rarer options, which `pointhaptics manual man | man -l -` describes:\n  --{}\n",
    fmt::join(kRare, " --")));
}

/// Keys are looked up for a help that is shown: it takes longer than to add the options.
void describeOptionsWhenShown(CLI::App& command, const std::vector<std::string>& bindings)
{
  command.formatter_fn(
    [&command, &bindings, usual = command.get_formatter()](
      const CLI::App* shown, const std::string& name, CLI::AppFormatMode mode)
    {
      describeKeys(command, bindings);
      hideRareOptions(command);
      return usual->make_help(shown, name, mode);
    });
}

} // namespace

void describeKeys(CLI::App& command, const std::vector<std::string>& bindings)
{
  CommandRegistry table = HapticViewer::commands();
  table.bind(bindings);
  for (CLI::Option* option : command.get_options([](const CLI::Option*) { return true; }))
  {
    const std::vector<std::string> parts = CLI::detail::split(option->get_description(), kMark);
    if (parts.size() < 2)
    {
      continue;
    }
    std::vector<std::string> keys;
    for (const std::string& name :
      CLI::detail::split(parts[1].empty() ? option->get_lnames().front() : parts[1], ' '))
    {
      const std::string key = table.label(name);
      keys.insert(keys.end(), key.empty() ? 0 : 1, key);
    }
    option->description(keys.empty() ? parts[0]
                                     : fmt::format("{}; key{} {}{}", parts[0], keys.size() > 1 ? "s" : "",
                                         fmt::join(keys, " and "), parts.size() > 2 ? parts[2] : ""));
  }
}

void ViewCommand::addTo(CLI::App& command)
{
  addInput(command, "FILE", this->files,
    "Point clouds: PLY, PCD, LAS, LAZ, E57, VTP, OBJ or columns of text; one that cannot be read is skipped "
    "where there are others, but with --together; with --replay those that were recorded are the "
    "default; - is standard input");
  command.add_flag("--together", this->viewer.together,
    keyed("All files as one cloud; default: one at a time", "next-file previous-file"));
  command.add_flag("--watch", this->viewer.watch, "Read a file again when it changes");
  addOutput(
    command, "--screenshot", this->screenshot, { "png" }, "Write this PNG instead of opening a window");
  command.add_flag("--skip-unreadable", this->skipsUnreadable,
    "Pictures: show what can be read of several files; without it one that cannot is an error");
  addInteger(command, "--turntable", this->viewer.turntable, 2, kMostPictures,
    keyed("With --screenshot OUT.png: as many pictures, OUT-001.png and so on, from all around the cloud", "",
      " turns in the window"));
  addSize(command, "--size", this->viewer.width, this->viewer.height,
    "Size of the window or picture; default 1280x800");
  addInput(command, "--path", this->viewer.path,
    "Follow the hand path in this file: t,x,y,z, or what feel or --trace wrote", "HIP.csv");
  addPathUnits(command, this->viewer.pathUnits);
  addWord(command, "--device", this->device, { "auto", "falcon", "simulated", "none" },
    "What moves the hand; default auto: a Falcon where one can be used, else the simulated hand, driven by "
    "mouse and keys; falcon is an error where none can be used, also with --screenshot and --path");
  this->falcon.addTo(command);
  addInput(command, "--config", this->config,
    "Defaults for these options, a JSON object; the command line wins", "FILE.json");
  command
    .add_option("--set", this->set, "One of these defaults, such as stereo=red-blue; wins over --config")
    ->type_name("NAME=VALUE")
    ->allow_extra_args(false);
  addOutput(command, "--write-config", this->writeConfig, { "json" },
    keyed("Write the options in force as a file for --config, and end", "write-settings",
      " writes those of the window"),
    "OUT.json");
  command.add_flag("--recent", this->recent, "Begin with the settings the last window ended with");
  addTouchFileOptions(command, this->viewer);
  addLook(command, this->viewer);
  addResolution(command, this->viewer.resolution);
  addReading(command, this->viewer.columns, this->viewer.salvage);
  addVertices(command, this->viewer.vertices);
  addWindowOptions(command, *this);
  this->touch.addTo(command);
  {
    const OptionGroup group(command, kTouchGroup);
    command.add_flag("--no-covariance", this->noCovariance, "Feel plain voxel means, without second moments");
  }
  this->bandwidth.addTo(command);
  this->lattice.addTo(command);
  describeOptionsWhenShown(command, this->viewer.bindings);
  command.get_option("--dims")->description(
    "Voxels on each axis of the lattice, everywhere; default 300, up to 1200 where these leave little of a "
    "cloud, and near the hand, where that tells more, voxels about as fine as the points");
}

void ViewCommand::readConfig(CLI::App& command, Files& taken)
{
  std::error_code missing;
  if (this->recent && this->config.empty() && std::filesystem::exists(recentSettingsFile(), missing))
  {
    this->config = recentSettingsFile();
  }
  if (!this->config.empty())
  {
    applyConfigFile(command, this->config, {}, taken);
  }
}

void ViewCommand::checkFiles() const
{
  const HapticViewerOptions& v = this->viewer;
  const bool writesPictures = !this->screenshot.empty() && this->screenshot != kStandardStream;
  requireUsage(v.turntable == 0 || writesPictures, "--turntable", std::to_string(v.turntable),
    "no picture is to be written; give the name of the first by --screenshot, or turn in the window by its "
    "key");
  requireUsage(!this->files.empty() || !v.replay.empty() || !this->writeConfig.empty(), "FILE", "(none)",
    "name a point cloud to show, or a recording by --replay");
  requireUsage(v.record.empty() || (this->needsWindow() && this->device != "none"), "--record", v.record,
    "nobody touches what has no window; leave out --screenshot, --trace and --force-chart of a --path, and "
    "--device none; feel --record records a path");
  if (this->needsWindow() && this->device != "none")
  {
    checkForceLimitOfDevices(this->touch.parameters.contact,
      v.path.empty()
        ? ", or --device none"
        : ", or --device none; --screenshot, --trace and --force-chart follow a path without a device, too");
  }
  const bool writesTouch = !v.forceChart.empty() || !v.trace.empty();
  requireUsage(!writesTouch || this->screenshot.empty() || v.followsFile(),
    v.trace.empty() ? "--force-chart" : "--trace", v.trace.empty() ? v.forceChart : v.trace,
    "nothing is felt in a still picture; give the hand's path with --path");
  const bool readsStream = std::count(this->files.begin(), this->files.end(), kStandardStream) > 0;
  requireUsage(!readsStream || !v.watch, "--watch", "",
    "standard input is read once and does not change; leave it out, or name a file");
  requireUsage(!readsStream || this->writeConfig.empty(), "--write-config", this->writeConfig,
    "settings are written without reading a cloud; leave out -, or --write-config");
}

void ViewCommand::complete(CLI::App& command, Files& taken)
{
  applySettings(command, this->set, taken);
  const std::vector<std::string> named = givenOptions(command);
  if (!this->viewer.replay.empty())
  {
    refuseRecorded(command, named, this->viewer.replay);
  }
  this->readConfig(command, taken);
  this->checkFiles();
  if (!this->viewer.replay.empty())
  {
    const bool areNamed = !this->files.empty();
    this->viewer.replay = taken.input(this->viewer.replay);
    readRecordingFor(this->viewer, this->files, this->viewer.replay);
    for (const std::string& file : areNamed ? std::vector<std::string>() : this->files)
    {
      taken.addInput(file);
    }
  }
  if (this->writeConfig.empty())
  {
    const bool hasWindow = this->needsWindow();
    warnIdle(this->viewer.path.empty(), named, { "path-unit", "path-time-unit" }, "without --path");
    warnIdle(this->device == "simulated" || this->device == "none", named, { "falcon-firmware" },
      "with --device " + this->device);
    warnIdle(hasWindow, named, { "skip-unreadable" }, "in a window");
    warnIdle(!hasWindow, named,
      { "bind", "full-screen", "marker-socket", "marker-text", "push-pointer", "sound", "watch" },
      "without a window");
  }
  this->touch.complete(command);
  this->falcon.complete(command, this->touch.parameters.contact);
  this->completeViewer(command);
  this->given = givenSettings(command);
  this->declare(taken);
}

/// Sets options that follow from several others, or have another form in the viewer.
void ViewCommand::completeViewer(CLI::App& command)
{
  HapticViewerOptions& options = this->viewer;
  for (const char* name : { "--unit", "--scale", "--matrix", "--translate", "--workspace" })
  {
    options.fitsWorkspace = options.fitsWorkspace && command.get_option(name)->count() == 0;
  }
  setFelt(options, this->lattice, this->bandwidth, this->noCovariance);
  options.unitIsChosen = options.unitIsChosen || command.count("--unit") > 0; // a recording has it, too
  options.haptics = this->touch.parameters;
  options.device = this->device == "falcon" ? HapticViewerDevice::Falcon
    : this->device == "simulated"           ? HapticViewerDevice::Simulated
    : this->device == "none"                ? HapticViewerDevice::None
                                            : HapticViewerDevice::Auto;
  options.falcon = this->falcon.settings();
  options.showsReading = this->needsWindow();
  options.makesMeans = this->needsWindow();
}

void ViewCommand::declare(Files& taken) const
{
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

bool ViewCommand::needsWindow() const
{
  const bool writesTouch = !this->viewer.forceChart.empty() || !this->viewer.trace.empty();
  return this->screenshot.empty() && (!this->viewer.followsFile() || !writesTouch);
}

bool ViewCommand::draws() const
{
  return this->needsWindow() || !this->screenshot.empty() || !this->viewer.forceChart.empty();
}

Command* viewCommand()
{
  return new ViewCommand;
}

} // namespace pointhaptics::app
