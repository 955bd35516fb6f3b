#include "FeelScenes.h"

#include "HapticSceneBuilder.h"
#include "PolyDataAccess.h"
#include "vtkVoxelMeanResampler.h"

#include "vtkPoints.h"
#include "vtkPolyData.h"

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
  if (whole_ && settings.refineNearHand && cloud &&
    builder_.setCloud(PointAccess(cloud).view(), SmpExecutor()) == Status::Ok)
  {
    builder_.setBandwidth(settings.bandwidth);
    builder_.setWorkspace(settings.workspace);
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

} // namespace pointhaptics
