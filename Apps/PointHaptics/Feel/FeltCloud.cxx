#include "Feel/FeelCommand.h"

#include "Terminal/Messages.h"
#include "Terminal/ProgressBar.h"
#include "Terminal/StopSignals.h"

#include "ClippedCloud.h"
#include "HapticSceneBuilder.h"
#include "LoadedCloud.h"
#include "ResampledCloud.h"

#include "Core/Base/Boxes.h"
#include "Core/Base/QuantityText.h"

#include <fmt/format.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <memory>
#include <utility>

namespace pointhaptics::app
{
namespace
{

/// The finite points of @p cloud in the workspace frame, inside --workspace where that is given, in double
/// precision, without arrays.
vtkSmartPointer<vtkPolyData> rawPoints(const FeelCommand& options, vtkPolyData* cloud)
{
  const Bounds box = options.lattice.workspace();
  vtkNew<vtkPoints> inside;
  inside->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    Vec3 p;
    cloud->GetPoint(i, &p.x);
    p = options.viewer.transform.apply(p);
    const bool isInside =
      box.empty() || (contains(box, p) && p.x < box.maximum.x && p.y < box.maximum.y && p.z < box.maximum.z);
    if (isFinite(p) && isInside)
    {
      inside->InsertNextPoint(&p.x);
    }
  }
  auto moved = vtkSmartPointer<vtkPolyData>::New();
  moved->SetPoints(inside);
  return moved;
}

/// @throws Failure that says why nothing can be felt, unless @p canBeFelt.
void requirePoints(bool canBeFelt, const FeelCommand& options, vtkPolyData* cloud)
{
  if (!canBeFelt)
  {
    throw Failure(extentOf(cloud).all.empty() ? noFinitePoint(options.file, cloud->GetNumberOfPoints())
                                              : options.file +
          ": no finite point lies in the workspace; leave out --workspace, or mend the transform");
  }
}

/// Makes the scene of the whole cloud, as the viewer does.
std::shared_ptr<const HapticScene> resampledScene(const FeelCommand& options, vtkPolyData* cloud)
{
  ProgressBar bar("resampling");
  CloudRequest request({ options.file }, options.viewer);
  request.makesScene = true;
  request.isFeltOnly = true;
  LoadedCloud loaded;
  loaded.cloud = cloud;
  loaded.title = options.file;
  findBounds(request, loaded);
  requirePoints(!loaded.bounds.empty(), options, cloud);
  placeCloud(request, loaded);
  std::string message;
  const auto progress = [&bar](const char*, double part)
  {
    bar.show(part);
    return !stopIsRequested();
  };
  const bool isMade = resampleCloud(request, progress, loaded, message);
  if (isMade)
  {
    noteNoReturns(request, loaded);
  }
  for (const std::string& note : loaded.notes)
  {
    warn(note);
  }
  const std::vector<std::string> errors = takeVtkErrors();
  require(errors.empty(), errors.empty() ? "" : errors.front());
  require(isMade, message);
  requirePoints(loaded.scene || loaded.means->GetNumberOfPoints() > 0, options, cloud);
  require(loaded.scene != nullptr, options.file + ": " + pointhaptics::message(loaded.sceneStatus));
  return loaded.scene;
}

} // namespace

void FeelCommand::makeScenes(vtkPolyData* cloud, FeelScenes& scenes) const
{
  const auto clipped = [this, cloud] { return clippedCloud(cloud, clipBox(this->viewer.clip, cloud)); };
  if (!this->raw)
  {
    auto whole = resampledScene(*this, cloud);
    // Where the user asked neither for other voxels nor for none. After the memory of the resampling.
    const bool refines = !this->lattice.voxelsAreGiven && !this->noCovariance;
    scenes.adopt(std::move(whole), refines ? clipped()->GetPoints() : nullptr);
    return;
  }
  const vtkSmartPointer<vtkPolyData> felt = clipped();
  const vtkSmartPointer<vtkPolyData> prepared = rawPoints(*this, felt);
  requirePoints(prepared->GetNumberOfPoints() > 0, *this, cloud);
  const Bounds box = this->lattice.workspace();
  const std::int64_t noReturns = extentOf(felt).noReturns;
  if (noReturns > 0 && (box.empty() || contains(box, this->viewer.transform.apply(Vec3()))))
  {
    warn(fmt::format("{}: {} are felt", this->file, noReturnsText(noReturns)));
  }
  Status status = Status::Ok;
  auto whole = makeHapticScene(prepared, status, !this->noCovariance, this->bandwidth.settings);
  scenes.adopt(std::move(whole), nullptr);
  require(status == Status::Ok, this->file + ": " + message(status));
}

} // namespace pointhaptics::app
