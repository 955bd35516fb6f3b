/// @file
/// Settings of bandwidth and radius at each point, as a plain struct: the properties of
/// vtkKernelBandwidthFilter.
#pragma once

#include "Core/Bandwidth/Bandwidth.h"
#include "Core/Base/SettingsMembers.h"
#include "Core/Base/Status.h"

#include <limits>
#include <tuple>

namespace pointhaptics
{

/// Settings of local bandwidths and proxy radii. Lengths are in the unit of the points.
struct LocalBandwidthSettings
{
  bool fixedRadius = false;   ///< Use a fixed neighbourhood in place of the k nearest points.
  int numberOfNeighbors = 16; ///< Besides the point itself; at least 1. More than there are: all.
  double radius = 0.001;      ///< Radius of the fixed neighbourhood, above 0.
  BandwidthRule rule = BandwidthRule::NormalReference;
  double radiusScale = 4.0;   ///< beta, above 0.
  double minimumRadius = 0.0; ///< r1; 0: kNoSinkSpacings local spacings.
  double maximumRadius = 0.0; ///< r2; 0: none.
  bool usePointCounts = true; ///< For voxel means: bandwidths and radii of the points they represent.
  Status check() const noexcept;

  static constexpr auto members()
  {
    using S = LocalBandwidthSettings;
    constexpr const char* kMetres = "METRES";
    constexpr NumberRange kLength{ 0.0, 1e300, true };
    return std::make_tuple(settingsMember("fixedRadius", &S::fixedRadius), // by --radius and --neighbors
      settingsMember("numberOfNeighbors", &S::numberOfNeighbors,
        { "--neighbors", "Nearest neighbours the spread is taken from; default 16", "N",
          { 1.0, double(std::numeric_limits<int>::max()) } }),
      settingsMember("radius", &S::radius,
        { "--radius", "All points in a ball of this radius, instead of --neighbors", kMetres, kLength }),
      settingsMember("rule", &S::rule, { "--rule", "From spread to bandwidth; default normal-reference" }),
      settingsMember("radiusScale", &S::radiusScale,
        { "--beta", "Proxy radius over bandwidth; default 4", "B", { 0.0, 1e6, true } }),
      settingsMember("minimumRadius", &S::minimumRadius,
        { "--r1", "Smallest proxy radius; default 2.2 local spacings", kMetres, kLength }),
      settingsMember("maximumRadius", &S::maximumRadius,
        { "--r2", "Largest proxy radius; default none", kMetres, kLength }),
      settingsMember("usePointCounts", &S::usePointCounts));
  }
};
static_assert(listsEveryMember<LocalBandwidthSettings>());

/// A bandwidth b is the kernel's standard deviation along each axis, whichever kernel it is: the rules then
/// apply to both.
enum class DensityKernel
{
  Gaussian,     ///< exp(-t^2 / 2), t the distance over b.
  Epanechnikov, ///< 1 - t^2 / w^2 for t < w and 0 beyond, w^2 = 5 on a line and 6 on a surface.
};

/// Local bandwidths and proxy radii, and which arrays are made of them.
struct BandwidthSettings : LocalBandwidthSettings
{
  DensityKernel densityKernel = DensityKernel::Gaussian;
  bool computeBandwidth = true;
  bool computeProxyRadius = true;
  bool computeDensity = false; ///< Costs five times the time of both.
  bool computeMeanBandwidth = false;

  static constexpr auto members()
  {
    using S = BandwidthSettings;
    return std::tuple_cat(LocalBandwidthSettings::members(),
      std::make_tuple(settingsMember("densityKernel", &S::densityKernel),
        settingsMember("computeBandwidth", &S::computeBandwidth),
        settingsMember("computeProxyRadius", &S::computeProxyRadius),
        settingsMember("computeDensity", &S::computeDensity),
        settingsMember("computeMeanBandwidth", &S::computeMeanBandwidth)));
  }
};
static_assert(listsEveryMember<BandwidthSettings, LocalBandwidthSettings>());

} // namespace pointhaptics
