#include "Commands/Commands.h"

#include "Clouds/Pipeline.h"
#include "Terminal/CommandLine.h"
#include "Terminal/Messages.h"
#include "Terminal/ProgressBar.h"
#include "Terminal/StandardStreams.h"
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
#include <optional>
#include <string>
#include <vector>

namespace pointhaptics
{
namespace app
{
namespace
{

constexpr const char* kViewCommand = "view";
/// As after Ctrl+C.
constexpr int kCancelled = 130;

/// False: what the options ask for cannot be had, whatever the clouds are; @p message says why.
bool checkDevice(const ViewOptions& options, std::string& message)
{
  // Where the hand follows a path or is in no window, nothing else would notice.
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

/// What comes by standard input, in a file that lasts as long as this.
class StandardInput
{
public:
  /// Puts the file in the place of "-". False: @p message.
  bool take(std::vector<std::string>& files, std::string& message)
  {
    const auto place = std::find(files.begin(), files.end(), kStandardStream);
    if (place == files.end())
    {
      return true;
    }
    folder_.emplace();
    *place = this->fileName();
    return copyStandardInput(*place, message);
  }
  /// Empty where nothing came by it.
  std::string fileName() const
  {
    return folder_ ? folder_->path("standard input") : std::string(); // the name is the title, too
  }
  /// @p text without the folder of the file.
  std::string shown(std::string text) const
  {
    const std::string folder = folder_ ? folder_->path("") : std::string();
    for (std::size_t at = 0; folder_ && (at = text.find(folder, at)) != std::string::npos;)
    {
      text.erase(at, folder.size());
    }
    return text;
  }

private:
  std::optional<TemporaryFolder> folder_;
};

void showMessage(HapticViewerObserver::Kind kind, const std::string& text)
{
  switch (kind)
  {
    case HapticViewerObserver::Kind::Note:
      printNow(stdout, text + "\n");
      break;
    case HapticViewerObserver::Kind::Warning:
      warn(kViewCommand, text);
      break;
    case HapticViewerObserver::Kind::Error:
      fail(kViewCommand, text);
  }
}

/// What the viewer says goes to the terminal, what it keeps to JSON files. @p options and @p input must
/// outlive the result.
HapticViewerObserver observerFor(const ViewOptions& options, const StandardInput& input)
{
  HapticViewerObserver observer;
  observer.message = [&input](HapticViewerObserver::Kind kind, const std::string& text)
  { showMessage(kind, input.shown(text)); };
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
  return observer;
}

void reportTimes(const ViewOptions& options, HapticViewer& viewer)
{
  if (!options.config.empty())
  {
    fmt::print(stderr, "view: settings from {}\n", options.config);
  }
  const vtkIdType voxels = viewer.means()->GetNumberOfPoints();
  fmt::print(stderr, "view: read in {:.2f} s{}\n", viewer.readSeconds(),
    voxels > 0 ? fmt::format(", resampled in {:.2f} s: {} active voxels", viewer.resampleSeconds(), voxels)
               : "");
}

/// The window, or the files that are asked for instead.
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

int runView(CLI::App& command, ViewOptions& options)
{
  collectVtkMessages();
  std::string message;
  if (!options.complete(command, message))
  {
    return fail(kViewCommand, message);
  }
  if (!options.writeConfig.empty())
  {
    if (!writeSettings(options.given, options.writeConfig, message))
    {
      return fail(kViewCommand, message);
    }
    fmt::print("settings: {}\n", options.writeConfig);
    return kSuccess;
  }
  if (!checkDevice(options, message))
  {
    return fail(kViewCommand, message);
  }
  StandardInput input;
  if (!input.take(options.files, message))
  {
    return fail(kViewCommand, message);
  }
  options.viewer.passingFile = input.fileName();
  HapticViewer viewer(options.viewer, observerFor(options, input));
  if (!viewer.open(options.files))
  {
    fail(kViewCommand, input.shown(viewer.message()));
    return viewer.isCancelled() ? kCancelled : kFailed;
  }
  if (options.verbose)
  {
    reportTimes(options, viewer);
  }
  printNow(stdout,
    fmt::format("{}{}, {}\n", countOfPoints(viewer.numberOfPoints()),
      ofThemInvalid(viewer.numberOfInvalidPoints()), viewer.scaleNote()));
  if (options.draws() && !displayIsAvailable(message)) // before a path is felt
  {
    return fail(kViewCommand, message);
  }
  return show(options, viewer) ? kSuccess : fail(kViewCommand, input.shown(viewer.message()));
}

} // namespace

void addViewCommand(CLI::App& program, int& exitCode)
{
  CLI::App* command = program.add_subcommand("view", "Show point clouds and feel them (the default command)");
  auto options = std::make_shared<ViewOptions>();
  options->addTo(*command);
  command->callback([command, options, &exitCode] { exitCode = runView(*command, *options); });
}

} // namespace app
} // namespace pointhaptics
