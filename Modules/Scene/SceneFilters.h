/// @file
/// Filters that make the scene of a whole cloud, and its picture.
#pragma once

#include "SceneWorker.h"

#include "vtkNew.h"

#include <memory>

class vtkCallbackCommand;
class vtkMatrix4x4;

namespace pointhaptics
{

/// Filters of a thread. Their messages become BuiltScene::problem.
class SceneFilters
{
public:
  SceneFilters();
  ~SceneFilters();

  /// Sets the cloud, whose arrays are shared; null: there is none.
  void setCloud(vtkPointSet* cloud);
  /// Resamples the cloud and makes the scene of @p recipe; null where there is nothing to feel. @param
  /// findsLattice choose the lattice by chooseLattice().
  std::shared_ptr<const HapticScene> makeScene(
    const SceneOrigin& recipe, bool findsLattice, BuiltScene& built);
  /// Makes the arrays of the picture of @p scene, which makeScene() made last, and moves all of them into @p
  /// built.
  void makePicture(const SceneRequest& request, const HapticScene* scene, BuiltScene& built);

private:
  vtkSmartPointer<vtkPolyData> resample(const VoxelMeanSettings& voxels);

  vtkNew<vtkCallbackCommand> silent_;
  vtkNew<vtkMatrix4x4> matrix_;
  vtkNew<vtkVoxelMeanResampler> resampler_;
  vtkNew<vtkKernelBandwidthFilter> bandwidth_;
  vtkSmartPointer<vtkPolyData> means_; ///< Means of the newest scene, until its picture is made.
  vtkIdType numberOfPoints_ = 0;
};

} // namespace pointhaptics
