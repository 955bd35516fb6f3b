/// @file
/// Lengths that vary smoothly over the cloud: the radius of the proxy, the radius and gate of the surface
/// fit.
#pragma once

#include "Core/Surface/CellPyramid.h"
#include "Core/Surface/FitKernel.h"

#include <iterator>
#include <vector>

namespace pointhaptics
{

/// The values of a field at a position; metres.
struct LocalScale
{
  double radius = 0.0;      ///< Radius of the surface fit.
  double gate = 0.0;        ///< Depth of the fit's gate.
  double countRadius = 0.0; ///< Smallest radius with enough points for a fit.
  double proxyRadius = 0.0; ///< Radius of the proxy sphere.
  double noise = 0.0;       ///< Standard deviation of the points about the surface.
  double cubic = 0.0;       ///< Weight of the fit's cubic terms, 0 to 1.
};

/// The values of a field in the order of FieldBlock.
constexpr double LocalScale::*kScaleValues[] = { &LocalScale::radius, &LocalScale::gate,
  &LocalScale::countRadius, &LocalScale::proxyRadius, &LocalScale::noise, &LocalScale::cubic };
static_assert(std::size(kScaleValues) == simd::kFieldValues);

/// One set of values per cell of a coarse pyramid level, blended between cells by a smooth kernel of compact
/// support. Radii of fit and proxy are cut so that neighbours differ by at most half their distance. The
/// values depend on the position only, not on any proxy. Immutable after build(); any number of threads may
/// read.
class RadiusField
{
public:
  /// Level whose cells carry the values: 8 finest voxels apart, or the coarsest there is.
  static int nodeLevel(const CellPyramid& pyramid);

  /// @param values one per cell of nodeLevel(pyramid), radii above 0, in that order. Keeps a pointer to
  /// nothing.
  void build(const CellPyramid& pyramid, std::vector<LocalScale> values);

  /// Blended values at @p position, typical() where no node is within reach(). @p pyramid
  /// is the one of build().
  LocalScale at(const CellPyramid& pyramid, const Vec3& position) const noexcept;

  /// As at(pyramid, position), with the gradient of the radius; zero where there is no node.
  LocalScale at(const CellPyramid& pyramid, const Vec3& position, Vec3& radiusGradient) const noexcept;

  /// The noise at the node nearest to @p position; 0 where there is none within reach().
  double noiseAt(const CellPyramid& pyramid, const Vec3& position) const noexcept;

  /// The nodes within @p reach of @p center. False: more than a block holds.
  bool gather(
    const CellPyramid& pyramid, const Vec3& center, double reach, simd::FieldBlock& block) const noexcept;
  /// Values of at() from the sums over the nodes near a place.
  LocalScale scaleFrom(const simd::FieldSums& sums, Vec3& radiusGradient) const noexcept;

  /// Distance from a node beyond which it has no weight.
  double reach() const { return reach_; }
  /// Medians of the values, for places far from the cloud.
  const LocalScale& typical() const { return typical_; }

private:
  /// Bound between two nodes: the first one's value is at most rise above the other's.
  struct Link
  {
    std::uint32_t node;
    std::uint32_t neighbor;
    double rise;
  };
  std::vector<Link> neighborLinks(const CellPyramid& pyramid) const;
  void limitSlope(const std::vector<Link>& links, double LocalScale::*radius);
  double median(double LocalScale::*member) const;

  std::vector<LocalScale> values_;
  LocalScale typical_;
  double reach_ = 0.0;
  int level_ = 0;
};

} // namespace pointhaptics
