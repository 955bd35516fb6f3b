/// @file
/// Size of the model in the hand, in words.
#pragma once

#include "PointHapticsViewerModule.h" // For export macro

#include <string>

class vtkMatrix4x4;

namespace pointhaptics
{

/// "1 : 12,200; 1 mm in the hand is 12 m": as on a map, then the length in the scanned thing of a millimetre
/// under the hand; "1 : 1, as large as it is" within half a percent. The mean scale where the axes differ.
/// The length is told in feet or inches where @p unit is one of them and that can be read, else in km, m, mm
/// or um. @param modelMatrix from the coordinates of the file to metres of the workspace. @param unit a name
/// for
/// @p metresPerUnit.
POINTHAPTICSVIEWER_EXPORT std::string describeScale(
  vtkMatrix4x4* modelMatrix, const std::string& unit, double metresPerUnit);

} // namespace pointhaptics
