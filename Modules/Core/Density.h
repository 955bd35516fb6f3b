/// @file
/// Kernel density estimates.
#pragma once

#include "Core/Executor.h"
#include "Core/NeighborQuery.h"
#include "Core/PointView.h"

#include <cstdint>
#include <vector>

namespace pointhaptics
{

/// Kernels beyond this many bandwidths are left out by surfaceDensities: each is below exp(-18) = 1.6e-8 of
/// its height.
constexpr double kDensityCutoff = 6.0;

/// Univariate Gaussian estimate f_b(x) = 1/(n b sqrt(2 pi)) sum_i exp(-(x - x_i)^2 / (2 b^2)), every term
/// summed. 0 for an empty sample or a bandwidth not above 0.
double gaussianDensity(double x, const double* sample, std::int64_t count, double bandwidth) noexcept;

/// Gaussian estimate on a surface (two dimensions) at each point with that point's own bandwidth:
/// f_b(x) = 1/(N 2 pi b^2) sum_i exp(-|x - x_i|^2 / (2 b^2)), per squared unit of the coordinates, N =
/// query.size(). Points that are not finite, or whose bandwidth is not above 0, get 0. Independent of @p
/// executor.
void surfaceDensities(const PointView& points, const NeighborQuery& query,
  const std::vector<double>& bandwidths, std::vector<double>& densities, const Executor& executor = {});

} // namespace pointhaptics
