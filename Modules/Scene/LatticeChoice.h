/// @file
/// Chooses the number of voxels on an axis where nobody gave one.
#pragma once

#include "PointHapticsSceneModule.h" // For export macro

#include "vtkSmartPointer.h"

#include <functional>

class vtkPolyData;

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

} // namespace pointhaptics
