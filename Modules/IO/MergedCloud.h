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
/// of a cloud that lacks one have NaN there, as doubles where the others have integers, or 0 in labels,
/// fields of LAS and colours, where that means none. An array that differs in its type becomes one of
/// doubles; one that differs in its components gets a name of its own. Of the field data that stays which is
/// the same in all. Clouds that say another unit of length than the first one that says one are converted to
/// that.
/// @param names what @p notes calls the clouds: it gets what was made up, converted or left out.
/// @return null where some are in degrees and others in lengths, or heights are in another unit: the last of
/// @p notes says so.
POINTHAPTICSIO_EXPORT vtkSmartPointer<vtkPolyData> mergeClouds(const std::vector<vtkPolyData*>& clouds,
  const std::vector<std::string>& names, std::vector<std::string>& notes);

} // namespace pointhaptics::io
