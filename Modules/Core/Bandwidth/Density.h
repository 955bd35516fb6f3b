/// @file
/// Kernel density estimates.
#pragma once

#include "Core/Bandwidth/BandwidthSettings.h"
#include "Core/Base/Executor.h"
#include "Core/Base/PointView.h"
#include "Core/Base/Status.h"
#include "Core/Neighbors/NeighborQuery.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace pointhaptics
{

constexpr double kEpanechnikovReachOnSurface = 2.44948974278317809820; ///< w = sqrt(6) bandwidths.

/// Gaussian kernels beyond this many bandwidths are left out by surfaceDensities: each is below exp(-18) =
/// 1.6e-8 of its height.
constexpr double kDensityCutoff = 6.0;

/// Gaussian estimate on a surface (two dimensions) at each point with that point's own bandwidth:
/// f_b(x) = 1/(N 2 pi b^2) sum_i exp(-|x - x_i|^2 / (2 b^2)), per squared unit of the coordinates, N the
/// finite points, cut off at kDensityCutoff; or with the Epanechnikov kernel 1/(N pi/2 w^2 b^2) sum_i
/// (1 - |x - x_i|^2 / (w b)^2) over the points closer than w b, where nothing is cut off. Points that are not
/// finite, or whose bandwidth is not above 0, get 0; points at one place get the density of the first of
/// them. Independent of @p executor, and of the order in which the query has the points: terms are summed as
/// whole multiples of 2^-60 of a kernel's height.
/// @p counts, for voxel means: the density of the points that these represent, each kernel times its voxel's
/// count (one per point; empty: 1 each), N the sum of the counts. The bandwidths are to be those of the
/// means: narrower kernels would leave gaps between them.
/// @p total, for a part of a cloud, given with the points nearby: N of the whole cloud, totalWeight() of its
/// parts together. Points whose density is not wanted have bandwidth 0.
void surfaceDensities(const PointView& points, const std::vector<double>& counts, const NeighborQuery& query,
  const std::vector<double>& bandwidths, std::vector<double>& densities, const Executor& executor = {},
  DensityKernel kernel = DensityKernel::Gaussian, std::optional<double> total = {});
/// The sum of the counts of finite points, each at least 1; without counts how many there are. Exact, where
/// counts are whole numbers below 2^53 in all.
double totalWeight(const PointView& points, const std::vector<double>& counts);
/// As far as the kernel of a point with bandwidth 1 is summed.
double densityReach(DensityKernel kernel);

} // namespace pointhaptics
