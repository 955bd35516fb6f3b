#include "LasGrid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pointhaptics::io
{

namespace
{

std::vector<double> asDoubles(ConstColumnView column, vtkIdType count)
{
  std::vector<double> values(static_cast<std::size_t>(count));
  copyStrided(column, { reinterpret_cast<char*>(values.data()), sizeof(double), VTK_DOUBLE }, count);
  return values;
}

/// The integers of the grid. @return false at the first coordinate it does not give back, when @p exactly.
bool place(const std::vector<double>& coordinates, bool exactly, LasGrid& grid)
{
  constexpr double kMost = std::numeric_limits<std::int32_t>::max();
  grid.integers.resize(coordinates.size());
  grid.largestError = 0.0;
  for (std::size_t i = 0; i < coordinates.size(); ++i)
  {
    const double wanted = coordinates[i];
    const double steps = std::clamp(std::nearbyint((wanted - grid.offset) / grid.scale), -kMost, kMost);
    const double given = steps * grid.scale + grid.offset;
    if (exactly && given != wanted)
    {
      return false;
    }
    grid.integers[i] = static_cast<std::int32_t>(steps);
    grid.largestError = std::max(grid.largestError, std::abs(given - wanted));
  }
  return true;
}

} // namespace

LasGrid LasGrid::fit(ConstColumnView column, vtkIdType count, double wantedScale, double wantedOffset)
{
  const std::vector<double> coordinates = asDoubles(column, count);
  LasGrid grid;
  grid.scale = wantedScale;
  grid.offset = wantedOffset;
  if (wantedScale > 0.0 && std::isfinite(wantedScale) && std::isfinite(wantedOffset) &&
    place(coordinates, true, grid))
  {
    return grid;
  }
  const auto ends = std::minmax_element(coordinates.begin(), coordinates.end());
  const double smallest = *ends.first;
  const double largest = *ends.second;
  for (const double scale : { 1.0, 0.1, 0.01, 0.001, 0.0001 })
  {
    for (const double offset : { 0.0, std::floor(smallest), smallest })
    {
      grid.scale = scale;
      grid.offset = offset;
      if (place(coordinates, true, grid))
      {
        return grid;
      }
    }
  }
  // At most 2^31 steps to either side of a centre that is itself a multiple of the step, and one of fewer
  // than 2^53 steps: else it would be no double.
  constexpr double kTiny = std::numeric_limits<double>::min();
  const double half = std::max(0.5 * largest - 0.5 * smallest, kTiny);
  const double farthest = std::max({ std::abs(smallest), std::abs(largest), kTiny });
  grid.scale = std::ldexp(1.0, std::max({ std::ilogb(half) + 1 - 31, std::ilogb(farthest) - 51, -1021 }));
  grid.offset = grid.scale * std::nearbyint((0.5 * smallest + 0.5 * largest) / grid.scale);
  place(coordinates, false, grid);
  return grid;
}

} // namespace pointhaptics::io
