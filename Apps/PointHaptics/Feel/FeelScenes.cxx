#include "Feel/FeelScenes.h"

#include "Clouds/Pipeline.h"

#include "HapticSceneBuilder.h"
#include "PolyDataAccess.h"
#include "vtkVoxelMeanResampler.h"

#include <vtkAlgorithm.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

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
    options.lattice.configure(resampler);
    resampler->SetPassAttributes(false);
    resampler->SetComputeCovariance(!options.noCovariance);
    resampler->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
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
  whole_ = makeHapticScene(prepared, status, !options.noCovariance, options.bandwidth.settings);
  if (!whole_)
  {
    message = options.file + ": " + pointhaptics::message(status);
    return false;
  }
  if (options.refinesNearHand() &&
    builder_.setCloud(PointAccess(cloud->GetPoints()).view(), SmpExecutor()) == Status::Ok)
  {
    builder_.setBandwidth(options.bandwidth.settings);
    builder_.setWorkspace(options.lattice.workspace());
    follower_.emplace(builder_, whole_);
  }
  return true;
}

} // namespace app
} // namespace pointhaptics
