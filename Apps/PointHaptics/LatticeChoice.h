/// @file
/// How fine a lattice a cloud wants that nobody chose one for.
#pragma once

class vtkPolyData;

namespace pointhaptics
{
namespace app
{

/// Voxels along an edge of the cube about @p cloud: 300, as everywhere, or 600 or 1200
/// where 300 leave fewer than 30,000 means of a cloud that finer voxels would tell apart: a sweep of LiDAR
/// over a street, dense near the scanner and thin at 80 m. Costs one resampling of the points, two more for
/// such a cloud.
int chooseLatticeDimension(vtkPolyData* cloud);

} // namespace app
} // namespace pointhaptics
