/// @file
/// Orientation of a cloud: its up axis, and the direction from which a person expects to see it.
#pragma once

#include "Core/Base/PointView.h"

#include "PointHapticsRenderingModule.h" // For export macro

#include <string>

class vtkPolyData;

namespace pointhaptics
{

/// Unit vectors in the frame of the cloud.
struct CloudOrientation
{
  Vec3 up{ 0.0, 0.0, 1.0 };
  Vec3 front{ 0.0, -1.0, 0.0 }; ///< From the cloud towards the person who looks at it.
  bool isGuess = false;         ///< True where little speaks for this up axis.
  bool fromSensor = false;      ///< True for one view of a sensor: look along its axis, not from aside.
};

/// A guess without guarantee, in this order: field data "OrganizedDimensions" of more than one row or a
/// "Viewpoint" other than the identity, and all points at z > 0, or all at z < 0: a depth camera's frame,
/// seen as the camera saw it (z forward and y down, or z backward and y up). An object (no axis is more than
/// 4 times another, centre within ten of its own lengths of the origin) in a mesh format (PLY, OBJ, STL)
/// whose y extent is the largest, or whose y starts near 0 while x and z straddle it: y up, seen from +z. The
/// same of an object in an E57 file that is shorter than 2 m, with all y at 0 or above. Everything else (LAS,
/// PCD, terrain): z up, from -y. Where the shape speaks against that, but in surveys (LAS, E57), upByShape()
/// decides, and it is a guess.
/// @param format Name or extension of the file format, any case: "ply", "LAS", ...
POINTHAPTICSRENDERING_EXPORT CloudOrientation guessCloudOrientation(
  vtkPolyData* cloud, const std::string& format);

/// The orientation for an up axis the user named: "x", "-x", "y", "-y", "z" or "-z" (anything else: z).
POINTHAPTICSRENDERING_EXPORT CloudOrientation orientationForUpAxis(const std::string& axis);

/// Name of the axis that is nearest to @p up: x, -x, ... -z.
POINTHAPTICSRENDERING_EXPORT std::string axisName(const Vec3& up);

} // namespace pointhaptics
