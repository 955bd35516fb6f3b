/// @file
/// From the properties and arrays of a bandwidth filter to Core's values and back.
#pragma once

#include "Core/Bandwidth/BandwidthSettings.h"
#include "Core/Base/Status.h"

#include <string>
#include <vector>

class vtkPolyData;

namespace pointhaptics
{

/// VoxelPointCount; empty where it is missing, has another shape, or is not to be used.
std::vector<double> voxelCounts(vtkPolyData* cloud, bool use);

/// Why settings.check() gave @p status.
std::string bandwidthProblem(const BandwidthSettings& settings, Status status);

/// Adds the arrays that the settings ask for, in their order.
void addBandwidthArrays(vtkPolyData* output, const BandwidthSettings& settings,
  const std::vector<double>& densities, const std::vector<double>& ofMeans,
  const std::vector<double>& bandwidths, const std::vector<double>& radii);

} // namespace pointhaptics
