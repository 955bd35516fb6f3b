#include "LasGrid.h"

#include "NumericType.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace pointhaptics::io
{

namespace
{

double coordinateAt(ConstColumnView view, vtkIdType i)
{
  const char* at = view.first + i * view.stride;
  if (view.type == VTK_DOUBLE)
  {
    double value;
    std::memcpy(&value, at, sizeof(value));
    return value;
  }
  double value = 0.0;
  copyStrided({ at, 0, view.type }, { reinterpret_cast<char*>(&value), 0, VTK_DOUBLE }, 1);
  return value;
}

/// The integers of the grid. @return false at the first coordinate it does not give back, when @p exactly.
bool place(ConstColumnView coordinates, vtkIdType count, bool exactly, LasGrid& grid)
{
  constexpr double kMost = std::numeric_limits<std::int32_t>::max();
  grid.integers.resize(static_cast<std::size_t>(count));
  grid.largestError = 0.0;
  for (vtkIdType i = 0; i < count; ++i)
  {
    const double wanted = coordinateAt(coordinates, i);
    const double steps = std::clamp(std::nearbyint((wanted - grid.offset) / grid.scale), -kMost, kMost);
    const double given = steps * grid.scale + grid.offset;
    if (exactly && given != wanted)
    {
      return false;
    }
    grid.integers[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(steps);
    grid.largestError = std::max(grid.largestError, std::abs(given - wanted));
  }
  return true;
}

} // namespace

LasGrid LasGrid::fit(ConstColumnView coordinates, vtkIdType count, double wantedScale, double wantedOffset)
{
  LasGrid grid;
  grid.scale = wantedScale;
  grid.offset = wantedOffset;
  if (wantedScale > 0.0 && std::isfinite(wantedScale) && std::isfinite(wantedOffset) &&
    place(coordinates, count, true, grid))
  {
    return grid;
  }
  double smallest = std::numeric_limits<double>::infinity();
  double largest = -smallest;
  for (vtkIdType i = 0; i < count; ++i)
  {
    const double value = coordinateAt(coordinates, i);
    smallest = std::min(smallest, value);
    largest = std::max(largest, value);
  }
  for (const double scale : { 1.0, 0.1, 0.01, 0.001, 0.0001 })
  {
    for (const double offset : { 0.0, std::floor(smallest) })
    {
      grid.scale = scale;
      grid.offset = offset;
      if (place(coordinates, count, true, grid))
      {
        return grid;
      }
    }
  }
  // At most 2^31 steps to either side of a centre that is itself a multiple of the step.
  const double half = std::max(0.5 * largest - 0.5 * smallest, std::numeric_limits<double>::min());
  grid.scale = std::ldexp(1.0, std::max(std::ilogb(half) + 1 - 31, -1022));
  grid.offset = grid.scale * std::nearbyint((0.5 * smallest + 0.5 * largest) / grid.scale);
  place(coordinates, count, false, grid);
  return grid;
}

} // namespace pointhaptics::io
