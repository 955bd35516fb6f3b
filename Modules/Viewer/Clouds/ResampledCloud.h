/// @file
/// The voxel means of a cloud that was just read, and the scene of them, for its first picture. Any thread.
#pragma once

#include "LoadedCloud.h"

#include <string>

class vtkKernelBandwidthFilter;
class vtkVoxelMeanResampler;

namespace pointhaptics
{

/// Fills in LoadedCloud::placement and model, from the bounds and @p request.
POINTHAPTICSVIEWER_EXPORT void placeCloud(const CloudRequest& request, LoadedCloud& loaded);

/// Sets on the filters all that @p options and @p loaded say, input and transform aside.
void configureFilters(const HapticViewerOptions& options, const LoadedCloud& loaded,
  vtkVoxelMeanResampler* resampler, vtkKernelBandwidthFilter* bandwidth);

/// Resamples the placed cloud, and fills in means and workspace, and the scene where @p request wants it. It
/// runs once, or as often as chooseLattice() needs where nobody chose a lattice. False: @p progress ended it,
/// @p message says so.
POINTHAPTICSVIEWER_EXPORT bool resampleCloud(
  const CloudRequest& request, const LoadProgress& progress, LoadedCloud& loaded, std::string& message);

/// Fills in the workspace of a cloud that is resampled later, without means.
void resampleLater(const CloudRequest& request, LoadedCloud& loaded);

} // namespace pointhaptics
