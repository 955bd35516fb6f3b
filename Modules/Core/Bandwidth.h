/// @file
/// Rules of kernel density estimation: from the spread of a sample to a kernel bandwidth.
#pragma once

#include "Core/Executor.h"
#include "Core/NeighborQuery.h"
#include "Core/PointView.h"
#include "Core/Status.h"

#include <cstdint>
#include <vector>

namespace pointhaptics
{

enum class BandwidthRule
{
  NormalReference,       ///< 1.06 s n^(-1/5): Silverman 1986, eq. 3.28; the paper's, its misprint mended.
  SilvermanRobust,       ///< 0.9 min(s, IQR / 1.34) n^(-1/5): Silverman 1986, eq. 3.31; R's bw.nrd0.
  ScottMultivariate,     ///< s n^(-1/(d + 4)): Scott 1992.
  SilvermanMultivariate, ///< s (n (d + 2) / 4)^(-1/(d + 4)): Silverman 1986, section 4.3.
};

/// Mean, sample standard deviation (n - 1) and quartiles (R's default, type 7) of a univariate sample.
struct SampleSpread
{
  std::int64_t count = 0;
  double mean = 0.0;
  double standardDeviation = 0.0;
  double interquartileRange = 0.0;
};

/// Sorts @p values. Empty: count 0 and zeros.
SampleSpread sampleSpread(std::vector<double>& values);

/// b of @p rule for a univariate sample (d = 1) of the given spread. DegenerateSample when n < 2 or the
/// spread is zero (for SilvermanRobust: min(s, IQR / 1.34), s alone where the IQR is zero); @p bandwidth is
/// then 0.
Status univariateBandwidth(BandwidthRule rule, const SampleSpread& spread, double& bandwidth) noexcept;

/// b from a standard deviation @p s per dimension of n points in @p dimensions (1 to 3). For SilvermanRobust
/// pass the smaller of the two spreads. DegenerateSample when n < 2 or s is not above 0.
Status bandwidth(BandwidthRule rule, double s, double n, int dimensions, double& result) noexcept;

/// How local bandwidths and proxy radii are found.
struct LocalBandwidthSettings
{
  bool fixedRadius = false;   ///< Else the k nearest.
  int numberOfNeighbors = 16; ///< Besides the point itself; at least 1.
  double radius = 0.001;      ///< Of the fixed neighbourhood, above 0.
  BandwidthRule rule = BandwidthRule::NormalReference;
  double radiusScale = 4.0;   ///< beta, above 0.
  double minimumRadius = 0.0; ///< r1; 0: kNoSinkSpacings local spacings.
  double maximumRadius = 0.0; ///< r2; 0: none.
  Status check() const noexcept;
};

/// The widest gap of a random sample of up to 1e5 points is 2.2 spacings: a smaller sphere falls through.
constexpr double kNoSinkSpacings = 2.2;

/// b and r_p = clamp(beta b, r1, r2) at each of @p points (both outputs are resized). s = sqrt(trace(C) / 2),
/// C the sample covariance of the neighbourhood with the point itself; for SilvermanRobust the univariate
/// spread of the neighbours' distances. Local spacing = sqrt(pi / k) times the distance of the k-th
/// neighbour. A neighbourhood without spread gets r1 (automatic: the smallest radius found elsewhere, or 1e-3
/// of the cloud's extent, or 1e-3) and b = r1 / beta. Points that are not finite get 0. Independent of @p
/// executor. @p query must be built on @p points.
Status localBandwidths(const PointView& points, const NeighborQuery& query,
  const LocalBandwidthSettings& settings, std::vector<double>& bandwidths, std::vector<double>& radii,
  const Executor& executor = {});

} // namespace pointhaptics
