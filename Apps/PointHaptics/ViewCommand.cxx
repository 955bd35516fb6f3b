#include "Commands.h"

#include "Messages.h"
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

namespace pointhaptics
{
namespace app
{
namespace
{

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
  const Stopwatch opening;
  if (!scene.open(options.firstFiles(), options, message))
  {
    return fail("view", message);
  }
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
  const bool done =
    needsWindow(options) ? runWindow(scene, options, message) : makePicture(scene, options, message);
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
