/// @file
/// A chart as a PNG, drawn off the screen by vtkChartXY. Needs an X display, as every window of Debian's VTK.
#pragma once

#include <string>
#include <vector>

namespace pointhaptics
{
namespace bench
{

struct ChartAxis
{
  std::string title; ///< With the unit in brackets.
  bool logarithmic = true;
  std::vector<double> ticks = {}; ///< Where there are labels; empty: at round numbers.
};

/// Points with values that are not finite, or not above 0 on a logarithmic axis, are left out.
struct Series
{
  std::string name; ///< In the legend.
  std::vector<double> x;
  std::vector<double> y;
  bool line = true; ///< Join the points, which are marked unless there are very many.
};

struct Chart
{
  std::string fileName; ///< Without folder and extension.
  std::string title;
  ChartAxis x;
  ChartAxis y;
  std::vector<Series> series; ///< Up to eight; colours that colour-blind people tell apart.
  bool isMap = false;         ///< A unit is as long on both axes, which are linear, and need not begin at 0.
};

/// Adds a point to the series of that name, which is made at the end where there is none.
void addPoint(std::vector<Series>& series, const std::string& name, double x, double y);

/// Writes @p fileName. Crashes without a display: ask first. False: the file cannot be written, or there is
/// nothing to draw.
bool writePng(const Chart& chart, const std::string& fileName, int width = 1000, int height = 640);

} // namespace bench
} // namespace pointhaptics
