#include "Feel/FeltCloud.h"

#include "Clouds/Pipeline.h"

#include "FeelScenes.h"
#include "vtkVoxelMeanResampler.h"

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
    prepareForTouch(resampler, !options.noCovariance);
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

bool makeFeelScenes(const FeelOptions& options, vtkPolyData* cloud, FeelScenes& scenes, std::string& message)
{
  const vtkSmartPointer<vtkPolyData> prepared = preparedCloud(options, cloud, message);
  if (!prepared)
  {
    return false;
  }
  FeelSceneSettings settings;
  settings.bandwidth = options.bandwidth.settings;
  settings.workspace = options.lattice.workspace();
  settings.useCovariance = !options.noCovariance;
  settings.refineNearHand = options.refinesNearHand();
  if (const Status status = scenes.make(prepared, cloud->GetPoints(), settings); status != Status::Ok)
  {
    message = options.file + ": " + pointhaptics::message(status);
    return false;
  }
  return true;
}

} // namespace app
} // namespace pointhaptics
