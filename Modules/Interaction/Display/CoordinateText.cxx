#include "CoordinateText.h"

#include "PolyDataAccess.h"

#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace
{

constexpr int kLeastDecimals = 3;
/// Decimal digits that a double holds.
constexpr int kMostDigits = 15;
/// Digits of a distance between points that lie on no grid: at least, at most, and where the spacing is not
/// known.
constexpr int kFewestDigits = 2;
constexpr int kMostDistanceDigits = 4;
constexpr int kUsualDigits = 3;
/// Between these limits numbers with a fraction have decimals instead of six digits, and none has an
/// exponent.
constexpr double kLeastFixed = 1e5;
constexpr double kLargestFixed = 1e9;
/// Relative step between neighbouring numbers of single precision.
constexpr double kSinglePrecision = 1.2e-7;

int decimalsDownTo(double step)
{
  return int(std::ceil(std::min(-std::log10(step) - 1e-9, double(kMostDigits))));
}

/// Decimals of a distance, where the file has no grid.
int distanceDecimals(vtkPolyData* cloud, const Vec3& from, const Vec3& to, double spacing)
{
  const double distance = norm(to - from);
  int decimals = spacing > 0.0 ? decimalsDownTo(spacing) : kLeastDecimals;
  if (distance > 0.0)
  {
    const int before = 1 + int(std::floor(std::log10(distance))); // digits in front of the point
    const int digits = spacing > 0.0 ? before + decimals : kUsualDigits;
    decimals = std::clamp(digits, kFewestDigits, kMostDistanceDigits) - before;
  }
  double largest = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    largest = std::max({ largest, std::abs(from[axis]), std::abs(to[axis]) });
  }
  const bool isSingle = cloud->GetPoints() && cloud->GetPoints()->GetDataType() == VTK_FLOAT && largest > 0.0;
  const int held = isSingle ? int(std::floor(-std::log10(kSinglePrecision * largest))) : kMostDigits;
  return std::clamp(std::min(decimals, held), 0, kMostDigits);
}

} // namespace

std::string fixedText(double value, int decimals)
{
  const std::string text = fmt::format("{:.{}f}", value, decimals);
  const bool isZero = text.find_first_not_of("-0.") == std::string::npos;
  return isZero && text[0] == '-' ? text.substr(1) : text;
}

std::string valueText(double value)
{
  const double size = std::abs(value);
  return size >= kLeastFixed && size < kLargestFixed
    ? fixedText(value, value == std::round(value) ? 0 : kLeastDecimals)
    : fmt::format("{:.6g}", value);
}

std::string coordinateText(double value, double step)
{
  if (!(std::abs(value) < kLargestFixed))
  {
    return valueText(value);
  }
  const int wanted = step > 0.0 ? decimalsDownTo(step) : kLeastDecimals;
  const int whole = std::abs(value) < 1.0 ? 1 : 1 + int(std::log10(std::abs(value)));
  return fixedText(value, std::clamp(wanted, kLeastDecimals, std::max(kLeastDecimals, kMostDigits - whole)));
}

int gridDecimals(vtkPolyData* cloud, int axis, double largest)
{
  Vec3 scale;
  const bool isFixed = fieldValues(cloud, "LasScale", 3, &scale.x) && scale[axis] > 0.0 &&
    scale[axis] <= 1.0 && std::abs(largest) < kLargestFixed;
  return isFixed ? std::max(0, decimalsDownTo(scale[axis])) : -1;
}

std::vector<std::string> distanceText(
  vtkPolyData* cloud, const Vec3& from, const Vec3& to, const std::string& unit, double spacing)
{
  const Vec3 way = to - from;
  const int usual = distanceDecimals(cloud, from, to, spacing);
  int finest = -1;
  std::string parts;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int grid = gridDecimals(cloud, axis, std::max(std::abs(from[axis]), std::abs(to[axis])));
    finest = std::max(finest, grid);
    parts += std::string(axis > 0 ? "   " : "") + "d" + "xyz"[axis] + " " +
      fixedText(way[axis], grid < 0 ? usual : grid);
  }
  return { fixedText(norm(way), finest < 0 ? usual : finest) + " " + unit, parts + " " + unit };
}

} // namespace pointhaptics
