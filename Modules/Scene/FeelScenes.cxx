#include "FeelScenes.h"

#include "HapticSceneBuilder.h"
#include "PolyDataAccess.h"
#include "vtkVoxelMeanResampler.h"

#include "Core/Base/Host/OutOfMemory.h"
#include "Core/Base/Lattice.h"
#include "Core/Distributed/FarPoints.h"
#include "Core/Resample/TransformedBounds.h"

#include "vtkCallbackCommand.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"

#include <new>
#include <utility>

namespace pointhaptics
{

namespace
{

/// Gives the resampler the lattice of feel and view: about the cloud without the points that are far from all
/// others. Finer scenes are counted from its corner. @return note on the far points; empty where there are
/// none.
std::string setLattice(vtkPoints* cloud, vtkVoxelMeanResampler* resampler)
{
  VoxelMeanSettings settings = resampler->GetSettings();
  AffineTransform transform;
  if (!cloud || !settings.lattice.automaticWorkspace ||
    !readTransform(resampler->GetTransform(), transform).empty())
  {
    return {};
  }
  const PointAccess points(cloud);
  const FarPoints far =
    findFarPoints(points.view(), transformedBounds(points.view(), transform, SmpExecutor()), transform);
  Lattice lattice;
  if (makeLattice(settings.lattice, far.others, lattice) != Status::Ok)
  {
    return {};
  }
  settings.lattice.workspace = lattice.bounds();
  settings.lattice.automaticWorkspace = false;
  resampler->SetSettings(settings);
  return far.count > 0 ? far.note() : std::string();
}

} // namespace

Status FeelScenes::make(vtkPolyData* felt, vtkPoints* cloud, const FeelSceneSettings& settings)
{
  Status status = Status::Ok;
  // No picture is drawn: the scene computes the few radii it needs.
  this->adopt(makeHapticScene(felt, status, settings.useCovariance, settings.bandwidth), cloud, settings);
  return status;
}

void FeelScenes::adopt(
  std::shared_ptr<const HapticScene> whole, vtkPoints* cloud, const FeelSceneSettings& settings)
{
  follower_.reset();
  whole_ = std::move(whole);
  settings_ = settings;
  builder_.setCloud(nullptr);
  if (whole_ && settings.refineNearHand && cloud)
  {
    // No finer scenes are made without an index.
    static_cast<void>(builder_.setCloud(PointAccess(cloud).view(), SmpExecutor()));
  }
  this->follow();
}

FeelScenes::FeelScenes(const FeelScenes& shared)
  : settings_(shared.settings_)
  , whole_(shared.whole_)
{
  builder_.setCloud(shared.builder_.index());
  this->follow();
}

void FeelScenes::follow()
{
  if (builder_.index())
  {
    builder_.setBandwidth(settings_.bandwidth);
    builder_.setWorkspace(settings_.workspace);
    follower_.emplace(builder_, whole_);
  }
}

void FeelScenes::restart()
{
  if (follower_)
  {
    follower_.emplace(builder_, whole_);
  }
}

Status FeelScenes::resample(
  vtkPointSet* cloud, vtkVoxelMeanResampler* resampler, FeelSceneSettings settings, std::string& message)
{
  auto* unit = vtkStringArray::SafeDownCast(cloud->GetFieldData()->GetAbstractArray("LengthUnit"));
  if (unit && unit->GetNumberOfValues() == 1 && unit->GetValue(0).rfind("deg", 0) == 0)
  {
    message =
      "x and y are degrees of longitude and latitude, which are no lengths; let the reader give local "
      "metres, or project the cloud";
    return Status::InvalidParameter;
  }
  // The input is a copy, as the original may belong to a pipeline that would update again.
  auto input = vtkSmartPointer<vtkPointSet>::Take(cloud->NewInstance());
  input->ShallowCopy(cloud);
  resampler->SetPassAttributes(false);
  resampler->SetComputeCovariance(settings.useCovariance);
  resampler->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  note_ = setLattice(cloud->GetPoints(), resampler);
  const LatticeSettings lattice = resampler->GetSettings().lattice;
  resampler->SetInputData(input);
  // The caller reports the errors of the resampler and note().
  vtkNew<vtkCallbackCommand> silence;
  resampler->AddObserver(vtkCommand::ErrorEvent, silence);
  resampler->AddObserver(vtkCommand::WarningEvent, silence);
  resampler->Update();
  vtkPolyData* felt = resampler->GetOutput();
  message = resampler->GetErrorMessage();
  message.erase(message.find_last_not_of(" .") + 1);
  if (resampler->GetErrorCode() == kOutOfMemoryCode)
  {
    throw std::bad_alloc();
  }
  if (!message.empty())
  {
    return Status::InvalidParameter;
  }
  if (resampler->GetAbortExecute())
  {
    message = pointhaptics::message(Status::Aborted);
    return Status::Aborted;
  }
  if (felt->GetNumberOfPoints() == 0)
  {
    message = "no finite point lies in the workspace; mend points that are NaN, leave out the workspace, or "
              "mend the transform";
    return Status::Empty;
  }
  settings.refineNearHand = settings.refineNearHand && settings.useCovariance;
  settings.workspace = lattice.automaticWorkspace ? Bounds() : lattice.workspace;
  const Status status = this->make(felt, cloud->GetPoints(), settings);
  message = pointhaptics::message(status);
  return status;
}

} // namespace pointhaptics
