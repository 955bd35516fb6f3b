/// @file
/// Bandwidths, proxy radii and densities of a cloud whose points lie on several ranks.
#pragma once

#include "Core/Bandwidth/BandwidthSettings.h"
#include "Core/Base/Executor.h"
#include "Core/Base/PointView.h"
#include "Core/Base/Status.h"
#include "Core/Distributed/Ranks.h"

#include <vector>

namespace pointhaptics
{

/// One number for each point of this rank; those that were not asked for are empty.
struct BandwidthsOfPoints
{
  std::vector<double> bandwidths;
  std::vector<double> radii;
  std::vector<double> ofMeans; ///< Bandwidths of voxel means themselves.
  std::vector<double> densities;
};

/// Computes the arrays of vtkKernelBandwidthFilter at each of this rank's @p points, from the points of all
/// ranks. The result is bit for bit that of one rank with all points, in the order of ranks. @p counts:
/// points of each voxel mean, or empty, on all ranks alike.
///
/// Ranks exchange points for slabs of space, with about as many points each. A rank finds how far the
/// neighbourhoods of its slab reach, gets the points of other slabs in that range (ghosts), and sees whether
/// each neighbourhood lies in what it has; where not it asks again, with a range that is certain to do.
/// Densities reach further and ask for their own range. A rank has its points twice, its
/// slab and the ghosts; what is sent is in proportion to the points, 40 bytes each, and to those near the
/// faces of slabs. Errors, on all ranks alike: those of settings.check(), InvalidParameter (more points in
/// all than a NeighborQuery takes, counts of another size).
Status sharedBandwidths(Ranks& ranks, const PointView& points, const std::vector<double>& counts,
  const BandwidthSettings& settings, BandwidthsOfPoints& result, const Executor& executor = {});

} // namespace pointhaptics
