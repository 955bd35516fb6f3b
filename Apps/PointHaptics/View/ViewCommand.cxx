#include "View/ViewCommand.h"

#include "Clouds/Pipeline.h"
#include "Terminal/Messages.h"
#include "Terminal/ProgressBar.h"
#include "Terminal/StopSignals.h"
#include "View/ViewSettings.h"

#include "HapticViewer.h"
#include "ViewDisplay.h"

#include <fmt/format.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cstdio>
#include <memory>

namespace pointhaptics::app
{
namespace
{

/// Exit code as after Ctrl+C.
constexpr int kCancelled = 130;

/// @throws Failure where the options cannot be met, whatever the clouds are.
void checkDevice(const ViewCommand& options)
{
  // If the hand follows a path or is in no window, nothing else would notice a missing Falcon.
  const bool opensFalcon = options.needsWindow() && !options.viewer.followsFile();
  std::string message;
  const bool isRight = options.device != "falcon" || opensFalcon || falconIsUsable(message);
  require(isRight,
    fmt::format("--device falcon: {}; {} does without a device: leave the option out, or give --device none",
      message, options.viewer.followsFile() ? "a hand path" : "a picture"));
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
      warn(text);
      showKeptWarnings(); // a window may stay for hours
      break;
    case HapticViewerObserver::Kind::Error:
      fail(text);
  }
}

/// Sends the viewer's messages to the terminal, and its settings to JSON files. @p options must outlive the
/// result.
HapticViewerObserver observerFor(const ViewCommand& options)
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
  {
    try
    {
      writeSettings(settingsOf(state), fileName);
    }
    catch (const Failure& failure)
    {
      message = failure.what();
    }
    return message.empty();
  };
  observer.program = "pointhaptics " POINTHAPTICS_VERSION;
  observer.describeState = [settingsOf](const HapticViewerState& state)
  { return jsonText(settingsOf(state)); };
  observer.rememberState = [settingsOf](const HapticViewerState& state)
  { rememberSettings(settingsOf(state)); };
  observer.keepUp = keepUp;
  observer.upOf = options.needsWindow() ? keptUp : decltype(observer.upOf)();
  return observer;
}

void reportTimes(const ViewCommand& options, HapticViewer& viewer)
{
  if (!options.config.empty())
  {
    say("settings from " + options.config);
  }
  const vtkIdType voxels = viewer.means()->GetNumberOfPoints();
  say(fmt::format("read in {:.2f} s{}", viewer.readSeconds(),
    voxels > 0 ? fmt::format(", resampled in {:.2f} s: {} active voxels", viewer.resampleSeconds(), voxels)
               : ""));
}

/// Shows the window, or writes the requested files.
bool show(const ViewCommand& options, HapticViewer& viewer)
{
  if (options.needsWindow())
  {
    rememberStopSignals(); // before a device that takes its time to start
    return viewer.run();
  }
  if (options.files.size() > 1 && !options.viewer.together)
  {
    warn(fmt::format("only the first of the {} files is shown; --together shows all", options.files.size()));
  }
  return (!options.viewer.followsFile() || viewer.feelPath()) &&
    (options.screenshot.empty() || viewer.renderToFile(options.screenshot));
}

/// @throws Failure where a file cannot be read: a picture of some of them is not the requested one.
void checkReadable(const ViewCommand& options)
{
  if (options.needsWindow() || options.skipsUnreadable || options.files.size() < 2)
  {
    return;
  }
  ReadOptions reading;
  reading.columns = options.viewer.columns;
  reading.salvage = options.viewer.salvage; // vertices or samples: both can be read or neither
  try
  {
    for (const std::string& file : options.files)
    {
      readCloud(file, reading);
    }
  }
  catch (const Failure& failure)
  {
    throw Failure(std::string(failure.what()) + "; --skip-unreadable shows the others");
  }
}

/// Sets the places where the viewer reads and writes: pipes are read once, and files that are not of a
/// session appear together.
void placeFiles(ViewCommand& options, Files& files)
{
  HapticViewerOptions& viewer = options.viewer;
  for (std::string& file : options.files)
  {
    const std::string given = file;
    file = files.input(file);
    viewer.passingFile = file != given ? file : viewer.passingFile;
  }
  viewer.path = files.input(viewer.path);
  // Outputs of a session appear when they are written: the session may last for hours.
  for (std::string* output : { &viewer.forceChart, &viewer.trace, &viewer.record })
  {
    if (!output->empty() && (!options.needsWindow() || *output == kStandardStream))
    {
      *output = files.output(*output);
    }
  }
}

} // namespace

int ViewCommand::run(Files& taken)
{
  if (!this->writeConfig.empty())
  {
    writeSettings(this->given, taken.output(this->writeConfig));
    taken.commit();
    printSummary("settings: " + this->writeConfig);
    return kSuccess;
  }
  checkDevice(*this);
  placeFiles(*this, taken);
  checkReadable(*this);
  HapticViewerObserver observer = observerFor(*this);
  if (!this->needsWindow())
  {
    observer.placeOf = [&taken](const std::string& name) { return taken.output(name); };
  }
  HapticViewer shown(this->viewer, observer);
  if (!shown.open(this->files))
  {
    fail(shown.message());
    return shown.isCancelled() ? kCancelled : kFailed;
  }
  reportTimes(*this, shown);
  printSummary(fmt::format("{}{}, {}", countOfPoints(shown.numberOfPoints()),
    ofThemInvalid(shown.numberOfInvalidPoints()), shown.scaleNote()));
  std::fflush(stdout);
  std::string message;
  require(!this->draws() || displayIsAvailable(message), message); // before a path is felt
  message = show(*this, shown) ? std::string() : shown.message();
  require(message.empty(), message);
  taken.commit();
  return stopIsRequested() ? stopExitCode() : kSuccess;
}

} // namespace pointhaptics::app
