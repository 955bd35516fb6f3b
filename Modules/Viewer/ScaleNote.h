/// @file
/// How large the model is in the hand, in words.
#pragma once

#include "PointHapticsViewerModule.h" // For export macro

#include <string>

class vtkMatrix4x4;

namespace pointhaptics
{

/// "scale 0.52 (1 m of the cloud is 0.52 m in the hand)": the scale is 1 where the hand feels the cloud as
/// large as it is, with @p unit taken for the file's; the mean one where the axes differ. The
/// length in the hand has the file's unit where it is 0.1 to 1000 of it, else km, m, mm or um.
/// @param modelMatrix from the coordinates of the file to metres of the workspace. @param unit a name for @p
/// metresPerUnit.
POINTHAPTICSVIEWER_EXPORT std::string describeScale(
  vtkMatrix4x4* modelMatrix, const std::string& unit, double metresPerUnit);

} // namespace pointhaptics
