/// @file
/// Writes a picture as a file that appears when it is complete.
#pragma once

#include "PointHapticsInteractionModule.h" // For export macro

#include <string>

class vtkImageData;

namespace pointhaptics
{

/// Writes @p image as @p fileName. False: @p message names the file, what the system says and the cure.
POINTHAPTICSINTERACTION_EXPORT bool writePng(
  vtkImageData* image, const std::string& fileName, std::string& message);

} // namespace pointhaptics
