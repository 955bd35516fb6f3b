#include "IO/Las/LasGrid.h"

#include "FileProblem.h"
#include "IO/Info/LengthUnit.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>

namespace pointhaptics::io
{

namespace
{

constexpr double kMost = std::numeric_limits<std::int32_t>::max();
constexpr double kTiny = std::numeric_limits<double>::min();

/// Coordinates along one axis, and their ends.
struct Axis
{
  std::vector<double> coordinates;
  double smallest = 0.0;
  double largest = 0.0;

  double half() const { return std::max(0.5 * largest - 0.5 * smallest, kTiny); }
  double center() const { return 0.5 * smallest + 0.5 * largest; }
  double farthest() const { return std::max({ std::abs(smallest), std::abs(largest), kTiny }); }
};

Axis makeAxis(ConstColumnView column, vtkIdType count)
{
  Axis axis;
  axis.coordinates.resize(static_cast<std::size_t>(count));
  copyStrided(
    column, { reinterpret_cast<char*>(axis.coordinates.data()), sizeof(double), VTK_DOUBLE }, count);
  const auto ends = std::minmax_element(axis.coordinates.begin(), axis.coordinates.end());
  axis.smallest = *ends.first;
  axis.largest = *ends.second;
  return axis;
}

/// The integers of the grid. @return false at the first coordinate for which @p accepts, which gets what the
/// grid gives back and what is wanted, says no.
template <typename Accepts>
bool place(const Axis& axis, const Accepts& accepts, LasGrid& grid)
{
  grid.integers.resize(axis.coordinates.size());
  grid.largestError = 0.0;
  for (std::size_t i = 0; i < axis.coordinates.size(); ++i)
  {
    const double wanted = axis.coordinates[i];
    const double steps = std::clamp(std::nearbyint((wanted - grid.offset) / grid.scale), -kMost, kMost);
    const double given = steps * grid.scale + grid.offset;
    if (!accepts(given, wanted))
    {
      return false;
    }
    grid.integers[i] = static_cast<std::int32_t>(steps);
    grid.largestError = std::max(grid.largestError, std::abs(given - wanted));
  }
  return true;
}

/// 10 to the power of @p exponent, the double next to it.
double powerOfTen(int exponent)
{
  return std::strtod(("1e" + std::to_string(exponent)).c_str(), nullptr);
}

/// True if @p offset is within reach of all coordinates.
bool spans(const Axis& axis, double scale, double offset)
{
  return axis.largest - offset <= scale * kMost && offset - axis.smallest <= scale * kMost;
}

/// The offset with the fewest digits from which the steps of @p grid span the axis: 0 where it can be.
void findRoundOffset(const Axis& axis, LasGrid& grid)
{
  constexpr int kMostDigits = 10;
  const int exponent = static_cast<int>(std::floor(std::log10(grid.scale)));
  for (int digits = kMostDigits; digits >= 0; --digits)
  {
    // A whole power of ten is a double, a fraction is not: what divides is exact.
    const int power = exponent + digits;
    const double unit = powerOfTen(std::abs(power));
    grid.offset =
      power < 0 ? std::nearbyint(axis.center() * unit) / unit : std::nearbyint(axis.center() / unit) * unit;
    if (spans(axis, grid.scale, grid.offset))
    {
      return;
    }
  }
}

/// True if the steps of @p grid span the axis, perhaps from another offset.
bool reaches(const Axis& axis, LasGrid& grid)
{
  spans(axis, grid.scale, grid.offset) ? void() : findRoundOffset(axis, grid);
  return spans(axis, grid.scale, grid.offset);
}

/// On the coarsest of some grids of whole decimals that gives each coordinate back. False: there is none.
template <typename Accepts>
bool placeOnDecimals(const Axis& axis, const Accepts& accepts, LasGrid& grid)
{
  for (const double scale : { 1.0, 0.1, 0.01, 0.001, 0.0001 })
  {
    for (const double offset : { 0.0, std::floor(axis.smallest), axis.smallest })
    {
      grid.scale = scale;
      grid.offset = offset;
      if (place(axis, accepts, grid))
      {
        return true;
      }
    }
  }
  return false;
}

/// False: the cloud is too small or too large for steps of the wanted scale.
bool takeWantedSteps(const Axis& axis, const WantedGrid& wanted, LasGrid& grid)
{
  if (!(wanted.extent >= LasGrid::kFewestSteps * wanted.scale))
  {
    return false;
  }
  grid.scale = wanted.scale;
  grid.offset = wanted.offset;
  return reaches(axis, grid);
}

/// False: the cloud is too long for them.
bool takeUsualSteps(const Axis& axis, const WantedGrid& wanted, LasGrid& grid)
{
  constexpr int kDigits = 5; // of the length of a small cloud
  grid.scale = wanted.usual;
  if (wanted.extent < LasGrid::kFewestSteps * wanted.usual && wanted.extent > LasGrid::kFewestSteps * kTiny)
  {
    grid.scale = powerOfTen(static_cast<int>(std::floor(std::log10(wanted.extent))) - kDigits);
  }
  grid.offset = 0.0;
  // Steps finer than the last digit of a far coordinate are none.
  return reaches(axis, grid) && grid.scale > std::ldexp(axis.farthest(), -52);
}

/// The finest steps of a power of ten that doubles can hold well.
void takeDecimalSteps(const Axis& axis, LasGrid& grid)
{
  constexpr int kLeastPower = -290;
  // The last digit of the farthest coordinate, and all steps in 32 bits.
  const double needed =
    std::max(axis.half() / (kMost - 1.0), std::ldexp(1.0, std::ilogb(axis.farthest()) - 52));
  int exponent = std::max(kLeastPower, static_cast<int>(std::floor(std::log10(needed))));
  while (powerOfTen(exponent) < needed)
  {
    ++exponent;
  }
  grid.scale = powerOfTen(exponent);
  findRoundOffset(axis, grid);
}

} // namespace

double LasGrid::usualStep(const std::string& unit, int axis)
{
  const std::string known = lengthUnitCalled(unit);
  return known == "mm" ? 0.1 : known == "cm" ? 0.01 : known == "deg" && axis < 2 ? 1e-7 : 0.0001;
}

LasGrid LasGrid::fit(ConstColumnView column, vtkIdType count, const WantedGrid& wanted)
{
  const Axis axis = makeAxis(column, count);
  const bool isWanted = wanted.scale > 0.0 && std::isfinite(wanted.scale) && std::isfinite(wanted.offset);
  // 17.31 of a text is not 1731 times 0.01, but next to it.
  const double lastDigits = 2.0 * std::numeric_limits<double>::epsilon() * axis.farthest();
  const auto isSame = [](double given, double coordinate) { return given == coordinate; };
  const auto isKept = [&](double given, double coordinate)
  {
    return std::abs(given - coordinate) <= lastDigits ||
      (column.type == VTK_FLOAT && static_cast<float>(given) == static_cast<float>(coordinate));
  };
  const auto isAny = [](double, double) { return true; };
  const bool isForced = wanted.forced > 0.0;
  LasGrid grid;
  grid.scale = isForced ? wanted.forced : wanted.scale;
  grid.offset = wanted.offset;
  failFormatIf(isForced && !reaches(axis, grid), "give larger ones, or none",
    "steps of {} do not span the cloud with 32 bits", grid.scale);
  const bool isExact = !isForced &&
    ((isWanted && place(axis, isSame, grid)) || placeOnDecimals(axis, isSame, grid) ||
      (!isWanted && placeOnDecimals(axis, isKept, grid)));
  if (isExact)
  {
    return grid;
  }
  const bool isTaken =
    isForced || (isWanted && takeWantedSteps(axis, wanted, grid)) || takeUsualSteps(axis, wanted, grid);
  isTaken ? void() : takeDecimalSteps(axis, grid);
  grid.rounds = !place(axis, isKept, grid);
  grid.rounds ? void(place(axis, isAny, grid)) : void();
  return grid;
}

} // namespace pointhaptics::io
