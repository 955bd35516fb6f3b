#include "Feel/FeltCloud.h"

#include "Clouds/Pipeline.h"
#include "Terminal/Messages.h"
#include "Terminal/ProgressBar.h"
#include "Terminal/StopSignals.h"

#include "ClippedCloud.h"
#include "FeelScenes.h"
#include "HapticViewerOptions.h"
#include "LoadedCloud.h"
#include "ResampledCloud.h"

#include "Core/Base/Boxes.h"
#include "Core/Base/QuantityText.h"

#include <fmt/format.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace pointhaptics::app
{
namespace
{

/// Points of @p cloud in the workspace frame, inside --workspace where that is given.
vtkSmartPointer<vtkPolyData> rawPoints(const FeelOptions& options, vtkPolyData* cloud)
{
  vtkSmartPointer<vtkPolyData> moved = transformedPoints(cloud, options.lattice.transform());
  const Bounds box = options.lattice.workspace();
  if (box.empty())
  {
    return moved;
  }
  vtkNew<vtkPoints> inside;
  inside->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < moved->GetNumberOfPoints(); ++i)
  {
    Vec3 p;
    moved->GetPoint(i, &p.x);
    if (p.x >= box.minimum.x && p.x < box.maximum.x && p.y >= box.minimum.y && p.y < box.maximum.y &&
      p.z >= box.minimum.z && p.z < box.maximum.z)
    {
      inside->InsertNextPoint(&p.x);
    }
  }
  moved->SetPoints(inside);
  return moved;
}

/// Reason why nothing can be felt.
std::string whyEmpty(const FeelOptions& options, vtkPolyData* cloud)
{
  return extentOf(cloud).all.empty()
    ? noFinitePoint(options.file, cloud->GetNumberOfPoints())
    : options.file + ": no finite point lies in the workspace; leave out --workspace, or mend the transform";
}

/// Makes the scene of the whole cloud, as the viewer does; @p box gets the felt part of the workspace. Null:
/// @p message says why.
std::shared_ptr<const HapticScene> resampledScene(
  const FeelOptions& options, vtkPolyData* cloud, Bounds& box, std::string& message)
{
  HapticViewerOptions viewer;
  viewer.transform = options.lattice.transform();
  viewer.fitsWorkspace = options.fit;
  viewer.clip = options.clip;
  viewer.names.clip = "--clip";
  viewer.voxels = options.lattice.voxels;
  if (!options.lattice.voxelsAreGiven)
  {
    viewer.voxels.lattice.dimensions = { 0, 0, 0 }; // as the viewer chooses
  }
  viewer.voxels.computeCovariance = !options.noCovariance;
  viewer.voxels.passAttributes = false;
  viewer.bandwidth = options.bandwidth.settings;
  ProgressBar bar("resampling");
  CloudRequest request = CloudRequest::of({ options.file }, viewer);
  request.makesScene = true;
  request.isFeltOnly = true;
  request.working = [&bar](const char*, double part) { bar.show(part); };
  LoadedCloud loaded;
  loaded.cloud = cloud;
  loaded.title = options.file;
  findBounds(request, loaded);
  if (loaded.bounds.empty())
  {
    message = whyEmpty(options, cloud);
    return nullptr;
  }
  placeCloud(request, loaded);
  const bool isMade = resampleCloud(
    request, [] { return !stopIsRequested(); }, loaded, message);
  if (isMade)
  {
    noteNoReturns(request, loaded);
  }
  for (const std::string& note : loaded.notes)
  {
    warn("feel", note);
  }
  if (const std::vector<std::string> errors = takeVtkErrors(); !errors.empty())
  {
    message = errors.front();
    return nullptr;
  }
  if (isMade && !loaded.scene)
  {
    message = loaded.means->GetNumberOfPoints() == 0
      ? whyEmpty(options, cloud)
      : options.file + ": " + pointhaptics::message(loaded.sceneStatus);
  }
  box = loaded.voxels.lattice.automaticWorkspace ? Bounds() : loaded.voxels.lattice.workspace;
  return isMade ? loaded.scene : nullptr;
}

} // namespace

bool makeFeelScenes(const FeelOptions& options, vtkPolyData* cloud, FeelScenes& scenes, std::string& message)
{
  FeelSceneSettings settings;
  settings.bandwidth = options.bandwidth.settings;
  settings.useCovariance = !options.noCovariance;
  settings.refineNearHand = options.refinesNearHand();
  if (!options.raw)
  {
    auto whole = resampledScene(options, cloud, settings.workspace, message);
    const bool isMade = whole != nullptr;
    scenes.adopt(std::move(whole), clippedCloud(cloud, clipBox(options.clip, cloud))->GetPoints(), settings);
    return isMade;
  }
  const vtkSmartPointer<vtkPolyData> felt = clippedCloud(cloud, clipBox(options.clip, cloud));
  const vtkSmartPointer<vtkPolyData> prepared = rawPoints(options, felt);
  if (prepared->GetNumberOfPoints() == 0)
  {
    message = whyEmpty(options, cloud);
    return false;
  }
  settings.workspace = options.lattice.workspace();
  const std::int64_t noReturns = extentOf(felt).noReturns;
  if (noReturns > 0 &&
    (settings.workspace.empty() || contains(settings.workspace, options.lattice.transform().apply(Vec3()))))
  {
    warn("feel", fmt::format("{}: {} are felt", options.file, noReturnsText(noReturns)));
  }
  if (const Status status = scenes.make(prepared, felt->GetPoints(), settings); status != Status::Ok)
  {
    message = options.file + ": " + pointhaptics::message(status);
    return false;
  }
  return true;
}

} // namespace pointhaptics::app
