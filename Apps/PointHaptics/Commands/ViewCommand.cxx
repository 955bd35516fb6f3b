#include "Commands/Commands.h"

#include "Clouds/Pipeline.h"
#include "Terminal/CommandLine.h"
#include "Terminal/Messages.h"
#include "Terminal/ProgressBar.h"
#include "Terminal/StopSignals.h"
#include "View/ViewOptions.h"
#include "View/ViewSettings.h"

#include "HapticViewer.h"
#include "ViewDisplay.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace pointhaptics::app
{
namespace
{

constexpr const char* kViewCommand = "view";
/// Exit code as after Ctrl+C.
constexpr int kCancelled = 130;

/// Checks the device. False: the options cannot be met, whatever the clouds are; @p message says why.
bool checkDevice(const ViewOptions& options, std::string& message)
{
  // If the hand follows a path or is in no window, nothing else would notice a missing Falcon.
  const bool opensFalcon = options.needsWindow() && !options.viewer.followsFile();
  if (options.device == "falcon" && !opensFalcon && !falconIsUsable(message))
  {
    message = fmt::format("--device falcon: {}; {} does without a device: leave the option out, or give "
                          "--device none",
      message, options.viewer.followsFile() ? "a hand path" : "a picture");
    return false;
  }
  return true;
}

void showMessage(HapticViewerObserver::Kind kind, const std::string& text)
{
  switch (kind)
  {
    case HapticViewerObserver::Kind::Note:
      printSummary(shownLine(text));
      std::fflush(stdout);
      break;
    case HapticViewerObserver::Kind::Warning:
      warn(kViewCommand, text);
      showKeptWarnings(); // a window may stay for hours
      break;
    case HapticViewerObserver::Kind::Error:
      fail(kViewCommand, text);
  }
}

/// Sends the viewer's messages to the terminal, and its settings to JSON files. @p options must outlive the
/// result.
HapticViewerObserver observerFor(const ViewOptions& options)
{
  HapticViewerObserver observer;
  observer.message = showMessage;
  observer.progress = [bar = std::shared_ptr<ProgressBar>(), last = std::string()](
                        const std::string& what, double part) mutable
  {
    if (part >= 1.0 || what != last)
    {
      bar.reset();
      last = what;
    }
    if (part >= 1.0)
    {
      return;
    }
    if (!bar)
    {
      bar = std::make_shared<ProgressBar>(what);
    }
    bar->show(part);
  };
  observer.shouldStop = stopIsRequested;
  observer.takeVtkErrors = takeVtkErrors;
  const auto settingsOf = [&options](const HapticViewerState& state)
  {
    nlohmann::ordered_json settings = options.given;
    setState(settings, state, options.viewer.metresPerUnit);
    return settings;
  };
  observer.writeState = [settingsOf](
                          const HapticViewerState& state, const std::string& fileName, std::string& message)
  { return writeSettings(settingsOf(state), fileName, message); };
  observer.program = "pointhaptics " POINTHAPTICS_VERSION;
  observer.describeState = [settingsOf](const HapticViewerState& state) { return settingsOf(state).dump(); };
  observer.rememberState = [settingsOf](const HapticViewerState& state)
  { rememberSettings(settingsOf(state)); };
  observer.keepUp = keepUp;
  observer.upOf = options.needsWindow() ? keptUp : decltype(observer.upOf)();
  return observer;
}

void reportTimes(const ViewOptions& options, HapticViewer& viewer)
{
  if (!options.config.empty())
  {
    say(kViewCommand, "settings from " + options.config);
  }
  const vtkIdType voxels = viewer.means()->GetNumberOfPoints();
  say(kViewCommand,
    fmt::format("read in {:.2f} s{}", viewer.readSeconds(),
      voxels > 0 ? fmt::format(", resampled in {:.2f} s: {} active voxels", viewer.resampleSeconds(), voxels)
                 : ""));
}

/// Shows the window, or writes the requested files.
bool show(const ViewOptions& options, HapticViewer& viewer)
{
  if (options.needsWindow())
  {
    rememberStopSignals(); // before a device that takes its time to start
    return viewer.run();
  }
  return (!options.viewer.followsFile() || viewer.feelPath()) &&
    (options.screenshot.empty() || viewer.renderToFile(options.screenshot));
}

/// True if every file can be read: a picture of some of them is not the requested one.
bool canReadAll(const ViewOptions& options, std::string& message)
{
  Cloud cloud;
  ReadOptions reading;
  reading.columns = options.viewer.columns;
  reading.salvage = options.viewer.salvage; // vertices or samples: both can be read or neither
  return options.needsWindow() || options.skipsUnreadable || options.files.size() < 2 ||
    std::all_of(options.files.begin(), options.files.end(),
      [&](const std::string& file) { return readCloud(file, cloud, message, reading); });
}

/// Sets the places where the viewer reads and writes: pipes are read once, and files that are not of a
/// session appear together.
void placeFiles(ViewOptions& options, Files& files)
{
  HapticViewerOptions& viewer = options.viewer;
  for (std::string& file : options.files)
  {
    const std::string given = file;
    file = files.input(file);
    viewer.passingFile = file != given ? file : viewer.passingFile;
  }
  viewer.path = files.input(viewer.path);
  viewer.replay = files.input(viewer.replay);
  // Outputs of a session appear when they are written: the session may last for hours.
  for (std::string* output : { &viewer.forceChart, &viewer.trace, &viewer.record })
  {
    if (!output->empty() && (!options.needsWindow() || *output == kStandardStream))
    {
      *output = files.output(*output);
    }
  }
}

int runView(ViewOptions& options, Files& files)
{
  std::string message;
  if (!options.writeConfig.empty())
  {
    require(writeSettings(options.given, files.output(options.writeConfig), message) && files.commit(message),
      message);
    printSummary("settings: " + options.writeConfig);
    return kSuccess;
  }
  require(checkDevice(options, message), message);
  placeFiles(options, files);
  if (!canReadAll(options, message))
  {
    return fail(kViewCommand, message + "; --skip-unreadable shows the others");
  }
  HapticViewerObserver observer = observerFor(options);
  if (!options.needsWindow())
  {
    observer.placeOf = [&files](const std::string& name) { return files.output(name); };
  }
  HapticViewer viewer(options.viewer, observer);
  if (!viewer.open(options.files))
  {
    fail(kViewCommand, viewer.message());
    return viewer.isCancelled() ? kCancelled : kFailed;
  }
  reportTimes(options, viewer);
  printSummary(fmt::format("{}{}, {}", countOfPoints(viewer.numberOfPoints()),
    ofThemInvalid(viewer.numberOfInvalidPoints()), viewer.scaleNote()));
  std::fflush(stdout);
  require(!options.draws() || displayIsAvailable(message), message); // before a path is felt
  message = show(options, viewer) ? std::string() : viewer.message();
  require(message.empty() && files.commit(message), message);
  return stopIsRequested() ? stopExitCode() : kSuccess;
}

} // namespace

void addViewCommand(CLI::App& program, int& exitCode)
{
  CLI::App* command = program.add_subcommand("view", "Show point clouds and feel them (the default command)");
  auto options = std::make_shared<ViewOptions>();
  options->addTo(*command);
  const auto complete = [command, options]
  {
    options->complete(*command);
    collectVtkMessages();
  };
  runAs(*command, exitCode,
    { [options](Files& files) { return runView(*options, files); }, complete,
      [options](Files& files) { options->declareMore(files); } });
}

} // namespace pointhaptics::app
