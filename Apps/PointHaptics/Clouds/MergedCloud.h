/// @file
/// Several clouds as one.
#pragma once

#include "Clouds/Pipeline.h"

#include <string>
#include <vector>

namespace pointhaptics
{
namespace app
{

/// All points of @p clouds, in their order, with every array of each; points of a cloud that lacks one have
/// NaN there, or 0 where it holds integers. An array that differs in its type becomes one of doubles; one
/// that differs in its components gets a name of its own. Of the field data that stays which is the same in
/// all. @p notes gets what was made up or left out.
vtkSmartPointer<vtkPolyData> mergeClouds(const std::vector<Cloud>& clouds, std::vector<std::string>& notes);

} // namespace app
} // namespace pointhaptics
