/// @file
/// Options and messages of the command `bandwidth`, in this program and in pointhaptics-mpi.
#pragma once

#include "Clouds/CloudToCloud.h"
#include "Options/BandwidthOptions.h"

#include <cmath>
#include <cstdint>
#include <string>

namespace CLI
{
class App;
}
class vtkPolyData;

namespace pointhaptics::app
{

struct BandwidthCommandOptions
{
  CloudToCloudOptions files;
  BandwidthOptions bandwidth;

  void addTo(CLI::App& command);
};

/// Figures of a cloud or a part of it. Points that are not finite have radius 0: they take no part.
struct BandwidthFigures
{
  double smallestRadius = INFINITY;
  double largestRadius = 0.0;
  std::int64_t points = 0;
  std::int64_t invalid = 0;
};

BandwidthFigures bandwidthFigures(vtkPolyData* cloud);
/// Joins the figures of two parts.
BandwidthFigures together(const BandwidthFigures& a, const BandwidthFigures& b);
/// Reason why there is no radius; empty where there is one.
std::string whyNone(const BandwidthCommandOptions& options, const BandwidthFigures& figures);
CloudResult resultOf(const BandwidthCommandOptions& options, const BandwidthFigures& figures);

} // namespace pointhaptics::app
