/// @file
/// Several clouds as one.
#pragma once

#include "PointHapticsIOModule.h" // For export macro

#include "vtkSmartPointer.h"

#include <string>
#include <vector>

class vtkPolyData;

namespace pointhaptics::io
{

/// All points of @p clouds, of which there is one at least, in their order, with every array of each; points
/// of a cloud that lacks one have NaN there, or 0 where it holds integers. An array that differs in its type
/// becomes one of doubles; one that differs in its components gets a name of its own. Of the field data that
/// stays which is the same in all. Clouds that say another unit of length than the first one that says one
/// are converted to that. @p notes gets what was made up, converted or left out.
/// @return null where some are in degrees and others in lengths: the last of @p notes says so.
POINTHAPTICSIO_EXPORT vtkSmartPointer<vtkPolyData> mergeClouds(
  const std::vector<vtkPolyData*>& clouds, std::vector<std::string>& notes);

} // namespace pointhaptics::io
