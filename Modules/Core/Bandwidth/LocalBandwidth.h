/// @file
/// Bandwidth and proxy radius at every point of a cloud, from its neighbourhood.
#pragma once

#include "Core/Bandwidth/BandwidthSettings.h"
#include "Core/Base/Executor.h"
#include "Core/Base/PointView.h"
#include "Core/Base/Status.h"
#include "Core/Neighbors/NeighborQuery.h"

#include <vector>

namespace pointhaptics
{

/// The widest gap of a random sample of up to 1e5 points is 2.2 spacings: a smaller sphere falls through.
constexpr double kNoSinkSpacings = 2.2;

/// b and r_p = clamp(beta b, r1, r2) at each of @p points (both outputs are resized). s = sqrt(trace(C) / 2),
/// C the sample covariance of the neighbourhood with the point itself; for SilvermanRobust and SheatherJones
/// the sample is the neighbours' distances
/// (SilvermanRobust's answer stands in where the equation of SheatherJones has none). Local spacing = sqrt(pi
/// / k) times the distance of the k-th neighbour. A neighbourhood without spread, or with squared distances
/// out of range (lengths beyond 1e150 or below 1e-150), gets r1 (automatic: the
/// smallest radius found elsewhere, or 1e-3 of the cloud's extent, or 1e-3) and b = r1 / beta. Points that
/// are not finite get 0. Neighbours are places: points at one place have one neighbourhood, and count once in
/// those of others.
/// @p query must be built on @p points. Errors: those of settings.check(), InvalidParameter for more points
/// than NeighborQuery takes.
/// Cost: for the k nearest, k up to 71, about 200 ns a point at k = 16; else that of a query for each point.
/// Results are the same bit for bit for every @p executor, and for float and double points of equal values; b
/// is within 1e-9 relative of the definition (LocalBandwidthTest), and scales with the cloud.
///
/// @p counts, for means of voxels: bandwidths and radii of the points in them. @p points are the means,
/// @p counts the number of points in each. The paper takes the bandwidth from the density of the
/// points, so that the proxy is large where they are sparse and small where they are dense. Means do not show
/// that density: on a surface they stand about a voxel apart wherever there are points, and a cloud of 3.9:1
/// in spacing has means of 1.6:1.
///
/// k nearest: N means represent c N points if each stands for c. So the spacing of the points, and with it s,
/// the sample of distances and the automatic r1, is that of the means over sqrt(c). c is the mean of the
/// neighbours' counts with weights 1 - (d / d_k)^2, d_k the distance of the k-th: voxels that the surface
/// only touches at a corner have few points, and many of them together the right number. n stays k + 1. So
/// that a sparse region keeps its radius beside a dense one, no count is taken for more than
/// 4 times the same mean with weights (1 - (d / d_k)^2)^4.
/// Ball: the spread is that of the means, and n the number of points.
///
/// Where all counts are 1 nothing is changed, not a bit; the factor is a continuous function of counts and
/// places as long as the neighbours are the same. Accuracy against the radii of the raw points: 5 % larger in
/// the median (they are less even than means), and as near to them as the radii of a random sample are to
/// their own mean (LocalBandwidthCountsTest). What changes within two voxels is blurred.
/// @param counts one per point, or empty: 1 each, as without settings.usePointCounts. What is below 1 or NaN
/// counts as 1. Another size is an InvalidParameter.
Status localBandwidths(const PointView& points, const std::vector<double>& counts, const NeighborQuery& query,
  const LocalBandwidthSettings& settings, std::vector<double>& bandwidths, std::vector<double>& radii,
  const Executor& executor = {});

/// Neighbourhoods of a part of a cloud: see partialBandwidths().
struct PartialBandwidths
{
  std::vector<double> bandwidths; ///< 0 where the neighbourhood has no spread.
  std::vector<double> radii;      ///< Radius; 0 where the neighbourhood has no spread.
  std::vector<double> reaches;    ///< Distance of the last neighbour; of a ball's, its radius.
  bool isComplete = false;        ///< Each neighbourhood that was read has spread.
};

/// The first step of localBandwidths, for processes that each have a part of a cloud: @p points are that
/// part, and others nearby, so that no point is missing in the neighbourhoods of those that matter.
Status partialBandwidths(const PointView& points, const std::vector<double>& counts,
  const NeighborQuery& query, const LocalBandwidthSettings& settings, PartialBandwidths& result,
  const Executor& executor = {});
/// The second step: gives the finite points of @p part that have no radius theirs. @p smallestRadius: of the
/// whole cloud, infinite where none has one; @p box: about its finite points.
void completeBandwidths(const PointView& points, const LocalBandwidthSettings& settings,
  double smallestRadius, const Bounds& box, PartialBandwidths& part);

/// The radii of the points at @p slots of @p query alone, in that order: those of localBandwidths, bit for
/// bit, without its work for all the others. For a few of many points: about 2 us each at k = 16. All points
/// are processed only where one of the neighbourhoods has no spread. Errors as for localBandwidths.
/// Independent of @p executor.
Status localRadiiAt(const PointView& points, const std::vector<double>& counts, const NeighborQuery& query,
  const LocalBandwidthSettings& settings, const std::vector<std::int64_t>& slots, std::vector<double>& radii,
  const Executor& executor = {});

} // namespace pointhaptics
