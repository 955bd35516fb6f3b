/// @file
/// Filters that make the scene of a whole cloud, and its picture.
#pragma once

#include "SceneWorker.h"

#include "vtkNew.h"

#include <functional>
#include <memory>

class vtkCallbackCommand;
class vtkMatrix4x4;

namespace pointhaptics
{

struct LatticeChoice
{
  int dimension = 0; ///< Voxels on each axis.
  vtkSmartPointer<vtkPolyData> means;
};

/// Chooses 300; or 600 or 1200 where 300 leave fewer than 30,000 means of a cloud that finer voxels would
/// tell apart, such as a sweep of LiDAR over a street, dense near the scanner and thin at 80 m. @p resample
/// gives the means of the cloud with so many voxels an axis. Once @p goesOn answers false, the best choice so
/// far is taken.
POINTHAPTICSSCENE_EXPORT LatticeChoice chooseLattice(
  const std::function<vtkSmartPointer<vtkPolyData>(int)>& resample, const std::function<bool()>& goesOn);

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
