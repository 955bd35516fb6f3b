#include "Viewer/ViewPicture.h"

#include "Feel/PathTicks.h"
#include "Viewer/ViewScene.h"
#include "Viewer/ViewTouch.h"

#include "vtkHapticChart.h"
#include "vtkHapticProps.h"

#include "Devices/HipPath.h"

#include <cmath>
#include <memory>

#include <fmt/format.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

namespace pointhaptics
{
namespace app
{
namespace
{

constexpr double kRateHz = 1000.0;
/// Samples of a path are kept for the picture: about 200 bytes each.
constexpr double kMostTicks = 2e6;

/// Feels along --path; writes trace and chart. @p shown is the tick for the picture.
bool feelAlongPath(ViewScene& scene, const ViewOptions& options, ServoSample& shown, std::string& message)
{
  HipPath path;
  if (readHipPath(options.path, path, message) != Status::Ok)
  {
    return false;
  }
  std::int64_t ticks = 0;
  if (!countTicks(path, options.path, kRateHz, kMostTicks, ticks, message))
  {
    return false;
  }
  Status status = Status::Ok;
  const auto snapshot = scene.makeScene(!options.noCovariance, status);
  if (!snapshot)
  {
    message = fmt::format("the cloud cannot be felt: {}", pointhaptics::message(status));
    return false;
  }
  const std::vector<ServoSample> samples =
    feelPath(*snapshot, path, ticks, options.hapticParameters(), kRateHz);
  shown = mostTelling(samples);
  if (!options.trace.empty())
  {
    TraceFile trace;
    if (!trace.open(options.trace, message))
    {
      return false;
    }
    trace.add(samples);
    if (!trace.close(message))
    {
      return false;
    }
    fmt::print("trace: {} ({} ticks)\n", options.trace, samples.size());
  }
  if (!options.forceChart.empty())
  {
    vtkNew<vtkHapticChart> chart;
    const std::shared_ptr<IdealForce> ideal = idealFor(scene, options);
    for (const ServoSample& sample : samples)
    {
      chart->AddSample(sample.timeSeconds, norm(sample.state.force), sample.state.radius,
        ideal ? idealForce(*ideal, scene, sample.state.hip, options.contact.stiffness) : NAN);
    }
    if (!chart->WriteImage(options.forceChart.c_str()))
    {
      message = fmt::format(
        "{}: cannot be written; check that its folder exists and can be written", options.forceChart);
      return false;
    }
    fmt::print("force chart: {}\n", options.forceChart);
  }
  return true;
}

} // namespace

bool makePicture(ViewScene& scene, const ViewOptions& options, std::string& message)
{
  ServoSample shown;
  const bool feels = !options.path.empty();
  if (feels && !feelAlongPath(scene, options, shown, message))
  {
    return false;
  }
  if (options.screenshot.empty())
  {
    return true;
  }
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(0);
  window->SetSize(options.width, options.height);
  window->AddRenderer(scene.renderer());
  if (feels)
  {
    scene.props()->Update(shown.state);
  }
  scene.showAmbient(options.ambient);
  scene.completeMeans(!options.noCovariance);
  scene.showAxes(options.axes);
  scene.showFigure(options.figure);
  scene.placeAxes(scene.modelMatrix());
  scene.placeCamera(feels ? &shown.state : nullptr);
  applyCamera(options, scene.renderer());
  window->Render();
  if (!writePicture(window, options.screenshot, message))
  {
    return false;
  }
  fmt::print("screenshot: {} ({}x{})\n", options.screenshot, options.width, options.height);
  if (feels)
  {
    fmt::print("  shows t = {:.3f} s: {}, force {:.3f} N, proxy radius {:.3f} mm\n", shown.timeSeconds,
      shown.state.contact ? "in contact" : "no contact along the whole path", norm(shown.state.force),
      1e3 * shown.state.radius);
  }
  return true;
}

} // namespace app
} // namespace pointhaptics
