#include "SceneFilters.h"

#include "HapticSceneBuilder.h"
#include "LatticeChoice.h"
#include "PolyDataAccess.h"
#include "SurfaceArrays.h"
#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include "vtkCallbackCommand.h"
#include "vtkMatrix4x4.h"
#include "vtkMatrixToLinearTransform.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

namespace pointhaptics
{

SceneFilters::SceneFilters()
{
  for (const auto event : { vtkCommand::ErrorEvent, vtkCommand::WarningEvent })
  {
    resampler_->AddObserver(event, silent_);
    bandwidth_->AddObserver(event, silent_);
  }
  vtkNew<vtkMatrixToLinearTransform> transform;
  transform->SetInput(matrix_);
  resampler_->SetTransform(transform);
  bandwidth_->SetInputConnection(resampler_->GetOutputPort());
}

SceneFilters::~SceneFilters() = default;

void SceneFilters::setCloud(vtkPointSet* cloud)
{
  vtkSmartPointer<vtkPointSet> own;
  if (cloud)
  {
    own.TakeReference(cloud->NewInstance());
    own->ShallowCopy(cloud);
  }
  resampler_->SetInputDataObject(own);
  numberOfPoints_ = cloud ? cloud->GetNumberOfPoints() : 0;
}

/// Updates the resampler, whose settings are @p voxels.
void SceneFilters::resample(bool findsLattice, VoxelMeanSettings& voxels, BuiltScene& built)
{
  const auto with = [&](int dimension)
  {
    voxels.lattice.dimensions = { dimension, dimension, dimension };
    resampler_->SetSettings(voxels);
    resampler_->Update();
    auto means = vtkSmartPointer<vtkPolyData>::New();
    means->ShallowCopy(resampler_->GetOutput());
    return means;
  };
  if (!findsLattice)
  {
    resampler_->Update();
    return;
  }
  const LatticeChoice choice = chooseLattice(with, [] { return true; });
  built.latticeDimension = choice.dimension;
  if (!choice.isNewest)
  {
    with(choice.dimension);
  }
}

std::shared_ptr<const HapticScene> SceneFilters::makeScene(
  const SceneOrigin& recipe, bool findsLattice, BuiltScene& built)
{
  built.modelToWorkspace = recipe.modelToWorkspace;
  built.numberOfPoints = numberOfPoints_;
  setElements(matrix_, recipe.modelToWorkspace);
  VoxelMeanSettings voxels = recipe.voxels;
  resampler_->SetSettings(voxels);
  std::shared_ptr<const HapticScene> scene;
  if (numberOfPoints_ > 0)
  {
    this->resample(findsLattice, voxels, built);
    built.problem = resampler_->GetErrorMessage();
    scene =
      makeHapticScene(resampler_->GetOutput(), built.status, recipe.useCovariance, recipe.bandwidth, &voxels);
  }
  built.empty = scene == nullptr;
  return scene;
}

void SceneFilters::makePicture(const SceneRequest& request, const HapticScene* scene, BuiltScene& built)
{
  built.means = vtkSmartPointer<vtkPolyData>::New();
  if (numberOfPoints_ > 0)
  {
    vtkPolyData* result = resampler_->GetOutput();
    if (request.arrays)
    {
      bandwidth_->SetSettings(*request.arrays);
      bandwidth_->Update();
      result = bandwidth_->GetOutput();
      built.problem += bandwidth_->GetErrorMessage();
    }
    built.means->ShallowCopy(result);
  }
  if (scene)
  {
    addSurfaceArrays(built.means, *scene, request.hasResiduals, request.hasNormals);
  }
  // Others own the output now; the next scene has new arrays.
  bandwidth_->GetOutput()->ReleaseData();
  resampler_->GetOutput()->ReleaseData();
}

} // namespace pointhaptics
