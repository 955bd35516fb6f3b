#include "Commands/Commands.h"

#include "Clouds/CloudLoader.h"
#include "Options/ViewOptions.h"
#include "Terminal/Messages.h"
#include "Terminal/ProgressBar.h"
#include "Terminal/ViewDisplay.h"
#include "Viewer/ViewPicture.h"
#include "Viewer/ViewScene.h"
#include "Viewer/ViewSettings.h"
#include "Viewer/ViewWindow.h"

#include "vtkKernelBandwidthFilter.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <vtkPolyData.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace pointhaptics
{
namespace app
{
namespace
{

/// Seconds in which most files are read: a window with a bar would only flicker.
constexpr double kSilence = 0.2;
constexpr double kLookPeriod = 0.05;
/// As after Ctrl+C.
constexpr int kCancelled = 130;

/// Files that a path fills are written at once; without one a session is what fills them.
bool needsWindow(const ViewOptions& options)
{
  const bool writesTouch = !options.forceChart.empty() || !options.trace.empty();
  return options.screenshot.empty() && (options.path.empty() || !writesTouch);
}

bool draws(const ViewOptions& options)
{
  return needsWindow(options) || !options.screenshot.empty() || !options.forceChart.empty();
}

class Stopwatch
{
public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point begin_ = Clock::now();
};

/// Without a window the bar is on the terminal.
void awaitOnTerminal(const CloudLoader& loader)
{
  ProgressBar bar("reading");
  while (!loader.waitFor(kLookPeriod))
  {
    bar.show(loader.progress());
  }
}

/// The first of the clouds on the command line that can be read.
struct FirstCloud
{
  std::size_t index = 0; ///< For ViewOptions::filesOfCloud().
  LoadedCloud cloud;
  std::string news; ///< What was skipped before it; empty: nothing.
};

/// @p message with the name of the file where it does not have it.
std::string withTitle(const std::string& title, const std::string& message)
{
  return message.find(title) == std::string::npos ? title + ": " + message : message;
}

/// Reads cloud after cloud until one can be shown, and warns of those that cannot. Where it takes long and
/// @p options need a window, @p session opens it. @return an exit code: kSuccess, or what to end with.
int readFirst(
  const ViewOptions& options, ViewScene& scene, std::unique_ptr<ViewSession>& session, FirstCloud& first)
{
  const std::size_t count = options.numberOfClouds();
  CloudLoader loader;
  std::string message;
  for (first.index = 0; first.index < count; ++first.index)
  {
    const std::vector<std::string> files = options.filesOfCloud(first.index);
    const std::string title = titleOf(files);
    loader.start(options.cloudRequest(files));
    if (!session && !loader.waitFor(kSilence) && needsWindow(options) && displayIsAvailable(message))
    {
      session = std::make_unique<ViewSession>(scene, options);
    }
    if (session && !session->awaitCloud(loader, title))
    {
      fail("view", title + ": reading was stopped on request; nothing is shown");
      return kCancelled;
    }
    awaitOnTerminal(loader);
    loader.take(first.cloud, message);
    if (message.empty())
    {
      return kSuccess;
    }
    if (count == 1)
    {
      return fail("view", message);
    }
    message = withTitle(title, message);
    warn("view", "skipped: " + message);
    first.news = first.index == 0
      ? "skipped: " + message
      : fmt::format("{} files are skipped; the last: {}", first.index + 1, message);
  }
  return fail("view", fmt::format("none of the {} files can be shown; mend one of them, see above", count));
}

/// False: what the options ask for cannot be had, whatever the clouds are; @p message says why.
bool checkDevice(const ViewOptions& options, std::string& message)
{
  // Where the hand follows a path or is in no window, nothing else would notice.
  const bool opensFalcon = needsWindow(options) && options.path.empty();
  if (options.device == "falcon" && !opensFalcon && !falconIsUsable(message))
  {
    message = fmt::format("--device falcon: {}; {} does without a device: leave the option out, or give "
                          "--device none",
      message, options.path.empty() ? "a picture" : "a hand path");
    return false;
  }
  return true;
}

void reportTimes(const ViewOptions& options, ViewScene& scene, double reading, double building)
{
  if (!options.config.empty())
  {
    fmt::print(stderr, "view: settings from {}\n", options.config);
  }
  fmt::print(stderr, "view: read in {:.2f} s, resampled in {:.2f} s: {} active voxels\n", reading, building,
    scene.bandwidth()->GetOutput()->GetNumberOfPoints());
}

int runView(CLI::App& command, ViewOptions& options)
{
  collectVtkMessages();
  std::string message;
  if (!options.complete(command, message))
  {
    return fail("view", message);
  }
  if (!options.writeConfig.empty())
  {
    if (!writeSettings(options.given, options.writeConfig, message))
    {
      return fail("view", message);
    }
    fmt::print("settings: {}\n", options.writeConfig);
    return kSuccess;
  }
  if (!checkDevice(options, message))
  {
    return fail("view", message);
  }
  ViewScene scene;
  std::unique_ptr<ViewSession> session;
  FirstCloud first;
  const Stopwatch reading;
  if (const int code = readFirst(options, scene, session, first); code != kSuccess)
  {
    return code;
  }
  const double readSeconds = reading.seconds();
  scene.open(std::move(first.cloud), options);
  const Stopwatch building;
  if (!scene.build(options, message))
  {
    return fail("view", message);
  }
  if (options.verbose)
  {
    reportTimes(options, scene, readSeconds, building.seconds());
  }
  fmt::print("{} points, {}\n", scene.numberOfPoints(), scene.scaleNote());
  std::fflush(stdout);
  if (draws(options) && !displayIsAvailable(message))
  {
    return fail("view", message);
  }
  if (needsWindow(options) && !session)
  {
    session = std::make_unique<ViewSession>(scene, options);
  }
  const bool done =
    session ? session->run(first.index, first.news, message) : makePicture(scene, options, message);
  return done ? kSuccess : fail("view", message);
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
