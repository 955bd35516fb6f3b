/// @file
/// From the options of `feel` to the scenes that are felt.
#pragma once

#include "Feel/FeelOptions.h"

#include <string>

class vtkPolyData;

namespace pointhaptics
{

class FeelScenes;

namespace app
{

/// Resamples @p cloud, or what --clip leaves of it, or takes its points as they are (--raw), and makes @p
/// scenes of that. False: @p message says why there is nothing to feel.
bool makeFeelScenes(const FeelOptions& options, vtkPolyData* cloud, FeelScenes& scenes, std::string& message);

} // namespace app
} // namespace pointhaptics
