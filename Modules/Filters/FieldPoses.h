/// @file
/// The poses of sensors in field data, which go with the points they saw.
#pragma once

#include "Core/Base/AffineTransform.h"

#include <string>

class vtkFieldData;

namespace pointhaptics
{

/// "Viewpoint" and "ScanPoses" of vtkPointCloudReader (tx ty tz qw qx qy qz) of points that @p transform has
/// moved: positions are mapped, orientations turned. Where it mirrors, shears or stretches there is no such
/// turn, and they are removed. A viewpoint that is the identity says nothing, as in most PCD files, and
/// stays; so do arrays of another shape. Arrays are replaced, not written to.
/// @return a sentence that names the arrays removed and says why; empty where none is.
std::string movePoses(const AffineTransform& transform, vtkFieldData* field);

} // namespace pointhaptics
