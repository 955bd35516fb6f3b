#include "FeelScenes.h"

#include "HapticSceneBuilder.h"
#include "PolyDataAccess.h"
#include "vtkVoxelMeanResampler.h"

#include "Core/Base/Host/OutOfMemory.h"

#include "vtkCallbackCommand.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <new>
#include <utility>

namespace pointhaptics
{

void prepareForTouch(vtkVoxelMeanResampler* resampler, bool useCovariance)
{
  resampler->SetPassAttributes(false);
  resampler->SetComputeCovariance(useCovariance);
  resampler->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
}

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
  // The input is a copy, as the original may belong to a pipeline that would update again.
  auto input = vtkSmartPointer<vtkPointSet>::Take(cloud->NewInstance());
  input->ShallowCopy(cloud);
  prepareForTouch(resampler, settings.useCovariance);
  resampler->SetInputData(input);
  // The caller reports errors and warnings of the resampler.
  vtkNew<vtkCallbackCommand> silence;
  resampler->AddObserver(vtkCommand::ErrorEvent, silence);
  resampler->AddObserver(vtkCommand::WarningEvent, silence);
  resampler->Update();
  resampler->RemoveObserver(silence);
  resampler->SetInputData(nullptr);
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
  settings.workspace = Bounds();
  if (!resampler->GetAutomaticWorkspace())
  {
    const double* b = resampler->GetWorkspaceBounds();
    settings.workspace.include({ b[0], b[2], b[4] });
    settings.workspace.include({ b[1], b[3], b[5] });
  }
  const Status status = this->make(felt, cloud->GetPoints(), settings);
  message = pointhaptics::message(status);
  resampler->ReleaseScratch();
  return status;
}

} // namespace pointhaptics
