#include "Commands.h"

#include "CloudLoader.h"
#include "Messages.h"
#include "ProgressBar.h"
#include "ViewDisplay.h"
#include "ViewOptions.h"
#include "ViewPicture.h"
#include "ViewScene.h"
#include "ViewSettings.h"
#include "ViewWindow.h"

#include "vtkKernelBandwidthFilter.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <vtkPolyData.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>

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
  ViewScene scene;
  std::unique_ptr<ViewSession> session;
  const Stopwatch opening;
  CloudLoader loader;
  loader.start(options.cloudRequest(options.firstFiles()));
  if (!loader.waitFor(kSilence) && needsWindow(options) && displayIsAvailable(message))
  {
    session = std::make_unique<ViewSession>(scene, options);
    if (!session->awaitCloud(loader))
    {
      fail("view", titleOf(options.firstFiles()) + ": reading was stopped on request; nothing is shown");
      return kCancelled;
    }
  }
  LoadedCloud cloud;
  awaitOnTerminal(loader);
  loader.take(cloud, message);
  if (!message.empty())
  {
    return fail("view", message);
  }
  scene.open(std::move(cloud), options);
  const Stopwatch building;
  if (!scene.build(options, message))
  {
    return fail("view", message);
  }
  if (options.verbose)
  {
    if (!options.config.empty())
    {
      fmt::print(stderr, "view: settings from {}\n", options.config);
    }
    fmt::print(stderr, "view: read in {:.2f} s, resampled in {:.2f} s: {} active voxels\n",
      opening.seconds() - building.seconds(), building.seconds(),
      scene.bandwidth()->GetOutput()->GetNumberOfPoints());
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
  const bool done = session ? session->run(message) : makePicture(scene, options, message);
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
