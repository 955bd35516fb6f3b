/// @file
/// How fine a lattice a cloud wants that nobody chose one for.
#pragma once

#include <functional>

class vtkPolyData;

namespace pointhaptics
{

/// Voxels along an edge of the cube about @p cloud: 300, as everywhere, or 600 or 1200
/// where 300 leave fewer than 30,000 means of a cloud that finer voxels would tell apart: a sweep of LiDAR
/// over a street, dense near the scanner and thin at 80 m. Costs one resampling of the points, two more for
/// such a cloud.
/// @param goesOn is asked now and then; once it answers false, 300 it is.
int chooseLatticeDimension(vtkPolyData* cloud, const std::function<bool()>& goesOn);

} // namespace pointhaptics
