#include "FeelScenes.h"

#include "HapticSceneBuilder.h"
#include "PolyDataAccess.h"
#include "vtkVoxelMeanResampler.h"

#include "vtkPoints.h"
#include "vtkPolyData.h"

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
  follower_.reset();
  Status status = Status::Ok;
  // No picture is drawn: the scene computes the few radii it needs.
  whole_ = makeHapticScene(felt, status, settings.useCovariance, settings.bandwidth);
  if (whole_ && settings.refineNearHand && cloud &&
    builder_.setCloud(PointAccess(cloud).view(), SmpExecutor()) == Status::Ok)
  {
    builder_.setBandwidth(settings.bandwidth);
    builder_.setWorkspace(settings.workspace);
    follower_.emplace(builder_, whole_);
  }
  return status;
}

void FeelScenes::restart()
{
  if (follower_)
  {
    follower_.emplace(builder_, whole_);
  }
}

} // namespace pointhaptics
