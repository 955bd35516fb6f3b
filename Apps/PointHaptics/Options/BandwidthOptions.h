/// @file
/// --neighbors --radius --rule --beta --r1 --r2 --smooth: the same wherever a proxy radius is computed.
#pragma once

#include <cstdint>

namespace CLI
{
class App;
}
class vtkKernelBandwidthFilter;

namespace pointhaptics
{
namespace app
{

/// Options as given; a value of 0 (and rule -1) means "not given": the filter's default rules.
struct BandwidthOptions
{
  std::int64_t neighbors = 0; ///< Neighbours of each point, itself not counted; excludes radius.
  double radius = 0.0;        ///< Metres: all points in a ball instead of the nearest ones.
  int rule = -1;              ///< vtkKernelBandwidthFilter::RuleType.
  double beta = 0.0;          ///< Proxy radius over bandwidth.
  double minimumRadius = 0.0; ///< r1, metres.
  double maximumRadius = 0.0; ///< r2, metres.
  bool smooth = false;        ///< Radii without jumps.

  /// Adds the options to @p command; bad values, r1 > r2 among them, end the parse with a usage error.
  void addTo(CLI::App& command);
  /// Sets on @p filter those that were given.
  void configure(vtkKernelBandwidthFilter* filter) const;
};

} // namespace app
} // namespace pointhaptics
