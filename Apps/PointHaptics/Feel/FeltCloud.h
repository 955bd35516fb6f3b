/// @file
/// Makes the felt scenes from the options of `feel`.
#pragma once

#include "Feel/FeelOptions.h"

#include <string>

class vtkPolyData;

namespace pointhaptics
{

class FeelScenes;

namespace app
{

/// Resamples @p cloud, or the part that --clip leaves, or takes its points as they are (--raw), and makes the
/// @p scenes. False: @p message says why there is nothing to feel.
bool makeFeelScenes(const FeelOptions& options, vtkPolyData* cloud, FeelScenes& scenes, std::string& message);

} // namespace app
} // namespace pointhaptics
