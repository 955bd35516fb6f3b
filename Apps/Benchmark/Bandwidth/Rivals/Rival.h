/// @file
/// One way to find the bandwidth and the radius of every point: ours or a loop over another library's search.
#pragma once

#include "Core/Base/PointView.h"

#include <string>
#include <vector>

class vtkPolyData;

namespace pointhaptics::bench::bandwidth
{

/// beta, and r1 in local spacings: the defaults of vtkKernelBandwidthFilter.
constexpr double kRadiusScale = 4.0;
constexpr double kSmallestRadiusInSpacings = 2.2;

/// The task of every contestant.
struct BandwidthTask
{
  vtkPolyData* cloud = nullptr; ///< Float points. Stays the caller's.
  PointView points;             ///< The points of @p cloud.
  int neighbors = 16;           ///< Besides the point itself.
};

struct BandwidthAnswer
{
  std::vector<double> bandwidths;
  std::vector<double> radii;
};

/// Use: load once, then any number of runs, then answer.
class Rival
{
public:
  virtual ~Rival() = default;
  virtual std::string name() const = 0;
  virtual bool isOurs() const { return false; }
  /// Copies the cloud into the rival's own form. Not timed.
  virtual void load(const BandwidthTask& task) = 0;
  /// Builds the tree and finds everything. @param parallel: the loop over the points on VTK's threads, else
  /// on the calling one.
  virtual void run(bool parallel) = 0;
  virtual BandwidthAnswer answer() const = 0;
};

} // namespace pointhaptics::bench::bandwidth
