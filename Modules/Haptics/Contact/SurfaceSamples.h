/// @file
/// Distances of points from the surface that is felt, and its normals there: for pictures.
#pragma once

#include "Core/Base/Executor.h"
#include "Core/Base/PointView.h"
#include "Haptics/HapticScene.h"

namespace pointhaptics
{

/// For each of @p points, places in the workspace on or near the cloud of @p scene, such as the voxel means
/// it was made of: the distance to the nearest point of the surface that ProxyMethod::SurfaceFit follows (the
/// same fits, radii and gates), and the unit normal there. Without a side: the distance is not below 0, the
/// normal is either of the two. @p distances, metres of the workspace: NaN where there is no fit, and for
/// points that are not finite. @p normals, three numbers a point: zero there.
///
/// Cost: about 10 us a point and thread. The result does not depend on the executor. Allocates half a
/// megabyte a thread.
void sampleSurface(const HapticScene& scene, const PointView& points, const Executor& executor,
  float* distances, float* normals);

} // namespace pointhaptics
