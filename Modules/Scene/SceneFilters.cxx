#include "SceneFilters.h"

#include "HapticSceneBuilder.h"
#include "PolyDataAccess.h"
#include "SurfaceArrays.h"
#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include "Core/Base/Lattice.h"

#include "vtkCallbackCommand.h"
#include "vtkMatrix4x4.h"
#include "vtkMatrixToLinearTransform.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"

#include <utility>

namespace pointhaptics
{
namespace
{

constexpr int kFinest = 4 * kDefaultLatticeDimension;
/// This many means show and feel a shape well.
constexpr vtkIdType kEnough = 30000;
/// Finer voxels that give less than this many times the means only repeat the points.
constexpr double kGain = 1.25;

} // namespace

LatticeChoice chooseLattice(
  const std::function<vtkSmartPointer<vtkPolyData>(int)>& resample, const std::function<bool()>& goesOn)
{
  LatticeChoice choice{ kDefaultLatticeDimension, resample(kDefaultLatticeDimension) };
  while (choice.dimension < kFinest && choice.means->GetNumberOfPoints() > 0 &&
    choice.means->GetNumberOfPoints() < kEnough && goesOn())
  {
    vtkSmartPointer<vtkPolyData> finer = resample(2 * choice.dimension);
    if (double(finer->GetNumberOfPoints()) < kGain * double(choice.means->GetNumberOfPoints()))
    {
      break;
    }
    choice = { 2 * choice.dimension, std::move(finer) };
  }
  return choice;
}

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

vtkSmartPointer<vtkPolyData> SceneFilters::resample(const VoxelMeanSettings& voxels)
{
  resampler_->SetSettings(voxels);
  resampler_->Update();
  auto means = vtkSmartPointer<vtkPolyData>::New();
  means->ShallowCopy(resampler_->GetOutput());
  return means;
}

std::shared_ptr<const HapticScene> SceneFilters::makeScene(
  const SceneOrigin& recipe, bool findsLattice, BuiltScene& built)
{
  built.modelToWorkspace = recipe.modelToWorkspace;
  built.numberOfPoints = numberOfPoints_;
  setElements(matrix_, recipe.modelToWorkspace);
  VoxelMeanSettings voxels = recipe.voxels;
  const auto with = [&](int dimension)
  {
    voxels.lattice.dimensions = { dimension, dimension, dimension };
    return this->resample(voxels);
  };
  means_ = nullptr;
  if (numberOfPoints_ > 0 && findsLattice)
  {
    const LatticeChoice choice = chooseLattice(with, [] { return true; });
    built.latticeDimension = choice.dimension;
    voxels.lattice.dimensions.fill(choice.dimension);
    means_ = choice.means;
  }
  else if (numberOfPoints_ > 0)
  {
    means_ = this->resample(voxels);
  }
  // After an error there are no means.
  built.problem = means_ && means_->GetNumberOfPoints() == 0 ? resampler_->GetErrorMessage() : "";
  std::shared_ptr<const HapticScene> scene =
    makeHapticScene(means_, built.status, recipe.useCovariance, recipe.bandwidth, &voxels);
  built.empty = scene == nullptr;
  return scene;
}

void SceneFilters::makePicture(const SceneRequest& request, const HapticScene* scene, BuiltScene& built)
{
  built.means = means_ ? std::move(means_) : vtkSmartPointer<vtkPolyData>::New();
  if (numberOfPoints_ > 0 && request.arrays)
  {
    bandwidth_->SetInputData(built.means);
    bandwidth_->SetSettings(*request.arrays);
    bandwidth_->Update();
    built.means = vtkSmartPointer<vtkPolyData>::New();
    built.means->ShallowCopy(bandwidth_->GetOutput());
    built.problem += bandwidth_->GetErrorMessage();
    bandwidth_->SetInputData(nullptr);
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
