#include "Feel/FeelScenes.h"

#include "Clouds/Pipeline.h"

#include "HapticSceneBuilder.h"
#include "PolyDataAccess.h"
#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include <vtkAlgorithm.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <vector>

namespace pointhaptics
{
namespace app
{
namespace
{

/// The points of @p cloud in the workspace frame that are inside --workspace where one is given.
vtkSmartPointer<vtkPolyData> rawPoints(const FeelOptions& options, vtkPolyData* cloud)
{
  std::int64_t invalid = 0;
  vtkSmartPointer<vtkPolyData> moved = transformedPoints(cloud, options.lattice.transform(), invalid);
  const std::vector<double>& box = options.lattice.workspace;
  if (box.empty())
  {
    return moved;
  }
  vtkNew<vtkPoints> inside;
  inside->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < moved->GetNumberOfPoints(); ++i)
  {
    double p[3];
    moved->GetPoint(i, p);
    if (p[0] >= box[0] && p[0] < box[1] && p[1] >= box[2] && p[1] < box[3] && p[2] >= box[4] && p[2] < box[5])
    {
      inside->InsertNextPoint(p);
    }
  }
  moved->SetPoints(inside);
  return moved;
}

/// The cloud as the proxy will feel it: resampled or raw.
vtkSmartPointer<vtkPolyData> preparedCloud(
  const FeelOptions& options, vtkPolyData* cloud, std::string& message)
{
  vtkSmartPointer<vtkPolyData> prepared;
  if (options.raw)
  {
    prepared = rawPoints(options, cloud);
  }
  else
  {
    vtkNew<vtkVoxelMeanResampler> resampler;
    resampler->SetInputData(cloud);
    resampler->SetPassAttributes(false);
    resampler->SetComputeCovariance(!options.noCovariance);
    resampler->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
    options.lattice.configure(resampler);
    if (!updateFilter(resampler, "resampling", message))
    {
      return nullptr;
    }
    prepared = resampler->GetOutput();
  }
  if (prepared->GetNumberOfPoints() == 0)
  {
    message =
      options.file + ": no finite point lies in the workspace; leave out --workspace, or mend the transform";
    return nullptr;
  }
  return prepared;
}

} // namespace

bool FeelScenes::make(const FeelOptions& options, vtkPolyData* cloud, std::string& message)
{
  const vtkSmartPointer<vtkPolyData> prepared = preparedCloud(options, cloud, message);
  if (!prepared)
  {
    return false;
  }
  Status status = Status::Ok;
  // No picture is drawn: the scene computes the few radii it needs.
  vtkNew<vtkKernelBandwidthFilter> bandwidth;
  options.bandwidth.configure(bandwidth);
  whole_ = makeHapticScene(prepared, status, !options.noCovariance, bandwidth->GetSettings());
  if (!whole_)
  {
    message = options.file + ": " + pointhaptics::message(status);
    return false;
  }
  if (options.refinesNearHand() &&
    builder_.setCloud(PointAccess(cloud->GetPoints()).view(), SmpExecutor()) == Status::Ok)
  {
    builder_.setBandwidth(bandwidth->GetSettings());
    builder_.setWorkspace(options.lattice.workspaceBounds());
    follower_.emplace(builder_, whole_);
  }
  return true;
}

} // namespace app
} // namespace pointhaptics
