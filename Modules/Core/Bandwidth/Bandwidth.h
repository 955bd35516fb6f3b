/// @file
/// Rules of kernel density estimation: from the spread of a sample to a kernel bandwidth.
#pragma once

#include "Core/Base/Status.h"

#include <cstdint>
#include <vector>

namespace pointhaptics
{

enum class BandwidthRule
{
  NormalReference,       ///< 1.06 s n^(-1/5): Silverman 1986, eq. 3.28; the paper's, its misprint corrected.
  SilvermanRobust,       ///< 0.9 min(s, IQR / 1.34) n^(-1/5): Silverman 1986, eq. 3.31; R's bw.nrd0.
  ScottMultivariate,     ///< s n^(-1/(d + 4)): Scott 1992.
  SilvermanMultivariate, ///< s (n (d + 2) / 4)^(-1/(d + 4)): Silverman 1986, section 4.3.
  SheatherJones, ///< Solve-the-equation, for univariate data: Sheather and Jones 1991, SheatherJones.h.
};

/// Sample standard deviation (n - 1) and quartiles (R's default, type 7) of a univariate sample.
struct SampleSpread
{
  std::int64_t count = 0; ///< Number of finite values.
  double standardDeviation = 0.0;
  double interquartileRange = 0.0;
  /// min(s, IQR / @p quartilesOfNormal), s alone where the quartiles coincide.
  double robustDeviation(double quartilesOfNormal) const noexcept;
};

/// Sorts @p values; those that are not finite are ignored and moved to the end. None: count 0 and zeros.
/// Relative error of s below 1e-12 as long as the differences of the values are finite, whatever their
/// offset and scale. Thread-safe; allocates nothing.
SampleSpread sampleSpread(std::vector<double>& values);

/// b from a standard deviation @p s per dimension of n points in @p dimensions (1 to 3), in the unit of s.
/// For SilvermanRobust pass the smaller of the two spreads. Within 1e-15 relative of the formula, above 0 and
/// finite. Errors, which leave @p result untouched: DegenerateSample when n < 2, or n or s is not finite, or
/// s is not above 0; InvalidParameter for other dimensions, and for SheatherJones, which needs the values
/// themselves. Thread-safe.
Status bandwidth(BandwidthRule rule, double s, double n, int dimensions, double& result) noexcept;

/// b of any @p rule (d = 1) for the @p count values of @p sample, in their unit; independent of their order.
/// For SilvermanRobust from min(s, IQR / 1.34), s alone where the quartiles coincide. @p scratch: memory of
/// the caller's, one for each thread; later samples of no greater size allocate nothing, but for
/// SheatherJones. Errors as for bandwidth(), and a value that is not finite is an InvalidParameter. Where the
/// equation of SheatherJones cannot be solved in double numbers: EquationUnsolved, and the bandwidth of
/// SilvermanRobust. Cost: a sort; for SheatherJones see there.
Status sampleBandwidth(
  BandwidthRule rule, const double* sample, std::int64_t count, std::vector<double>& scratch, double& result);

} // namespace pointhaptics
