/// @file
/// From the properties and arrays of a bandwidth filter to Core's values and back.
#pragma once

#include "Core/Bandwidth/BandwidthSettings.h"
#include "Core/Base/Status.h"

#include <cstdint>
#include <string>
#include <vector>

class vtkPointSet;
class vtkPolyData;

namespace pointhaptics
{

/// VoxelPointCount; empty where it is missing, of no use, or not to be used. @p problem: why it is of no use.
std::vector<double> voxelCounts(vtkPointSet* cloud, bool use, std::string& problem);

/// A sentence about @p invalid of @p all points that are not finite; empty where there is none.
std::string invalidPoints(std::int64_t invalid, std::int64_t all);

/// The points and their arrays: a vtkPolyData as it is, others with a vertex each.
void passCloud(vtkPointSet* cloud, vtkPolyData* output);

/// Why settings.check() gave @p status.
std::string bandwidthProblem(const BandwidthSettings& settings, Status status);

/// Adds the arrays that the settings ask for, in their order.
void addBandwidthArrays(vtkPolyData* output, const BandwidthSettings& settings,
  const std::vector<double>& densities, const std::vector<double>& ofMeans,
  const std::vector<double>& bandwidths, const std::vector<double>& radii);

} // namespace pointhaptics
