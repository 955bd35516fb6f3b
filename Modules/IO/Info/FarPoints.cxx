#include "IO/Info/FarPoints.h"

#include "Core/Base/Boxes.h"
#include "Core/Base/QuantityText.h"
#include "Core/Distributed/SharedVoxels.h"

#include "vtkPolyData.h"
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace pointhaptics
{
namespace
{

constexpr vtkIdType kLookedAt = 10000;
constexpr vtkIdType kFewest = 100;      ///< Of fewer points none is called far.
constexpr std::int64_t kUsualCut = 100; ///< One in so many is cut off at each end of an axis, at least.
constexpr double kMostLength = 0.1;     ///< Of the others' longest side over that of all.

/// What files have in the place of coordinates that were not measured.
bool isNoData(const Vec3& p)
{
  constexpr double kNoData[] = { -9999.0, -99999.0, -32768.0 };
  bool result = isAtZero(p);
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const double value : kNoData)
    {
      result = result || std::abs(p[axis] - value) <= 1e-9 * -value; // LAS: a multiple of a step
    }
  }
  return result;
}

double longestSide(const Bounds& bounds)
{
  const Vec3 size = bounds.extent();
  return std::max({ size.x, size.y, size.z });
}

/// Some of the points, as many whatever the ranks, with those of all of them.
void sample(vtkPolyData* part, Ranks& ranks, std::vector<double> (&values)[3])
{
  const std::int64_t count = part->GetNumberOfPoints();
  const std::int64_t before = sumBefore(ranks, count);
  const std::int64_t step = std::max<std::int64_t>(1, commonSum(ranks, count) / kLookedAt);
  Vec3 p;
  for (vtkIdType i = (step - before % step) % step; i < count; i += step)
  {
    part->GetPoint(i, &p.x);
    for (int axis = 0; axis < 3 && isFinite(p) && !isNoData(p); ++axis)
    {
      values[axis].push_back(p[axis]);
    }
  }
  for (std::vector<double>& ofAxis : values)
  {
    const std::vector<std::string> ofRanks = ranks.gather(bytesOfValues(ofAxis));
    ofAxis.clear();
    for (const std::string& bytes : ofRanks)
    {
      const std::vector<double> more = valuesOfBytes<double>(bytes);
      ofAxis.insert(ofAxis.end(), more.begin(), more.end());
    }
  }
}

/// Some measured points without one in @p cut at each end on each axis, and by as much as its longest side
/// beyond.
Bounds boxOfMost(vtkPolyData* part, Ranks& ranks, std::size_t cut)
{
  std::vector<double> values[3];
  sample(part, ranks, values);
  Bounds box;
  for (int axis = 0; axis < 3 && !values[axis].empty(); ++axis)
  {
    std::sort(values[axis].begin(), values[axis].end());
    const std::size_t last = values[axis].size() - 1;
    box.minimum[axis] = values[axis][last / cut];
    box.maximum[axis] = values[axis][last - last / cut];
  }
  return box.empty() ? box : grown(box, longestSide(box));
}

} // namespace

std::string FarPoints::text() const
{
  return fmt::format(
    "{} of {} points {} far from all others", countText(count), countText(of), count == 1 ? "is" : "are");
}

std::string FarPoints::clip() const
{
  // Digits enough for the margin, also of map coordinates: they may not cut.
  const double margin = 0.001 * longestSide(others);
  const Bounds box = grown(others, margin);
  const int digits = int(std::clamp(std::ceil(-std::log10(margin)), 0.0, 17.0));
  return fmt::format("{0:.{6}f},{1:.{6}f},{2:.{6}f},{3:.{6}f},{4:.{6}f},{5:.{6}f}", box.minimum.x,
    box.maximum.x, box.minimum.y, box.maximum.y, box.minimum.z, box.maximum.z, digits);
}

FarPoints findFarPoints(vtkPolyData* cloud, const Bounds& bounds, std::int64_t mostPart)
{
  Ranks alone;
  return findFarPoints(cloud, bounds, alone, mostPart);
}

FarPoints findFarPoints(vtkPolyData* part, const Bounds& bounds, Ranks& ranks, std::int64_t mostPart)
{
  FarPoints none;
  none.others = commonBounds(ranks, bounds);
  if (commonSum(ranks, part->GetNumberOfPoints()) < kFewest)
  {
    return none;
  }
  const double longest = longestSide(none.others);
  const Bounds box = boxOfMost(part, ranks, static_cast<std::size_t>(std::min(mostPart, kUsualCut)));
  if (box.empty() || !(longestSide(box) > 0.0) || longestSide(box) > 3.0 * kMostLength * longest)
  {
    return none;
  }
  FarPoints found;
  std::int64_t stray = 0; // but for those without data
  Vec3 p;
  for (vtkIdType i = 0; i < part->GetNumberOfPoints(); ++i)
  {
    part->GetPoint(i, &p.x);
    if (isFinite(p))
    {
      ++found.of;
      if (contains(box, p))
      {
        found.others.include(p);
        continue;
      }
      ++found.count;
      stray += isNoData(p) ? 0 : 1;
    }
  }
  found.of = commonSum(ranks, found.of);
  found.count = commonSum(ranks, found.count);
  found.others = commonBounds(ranks, found.others);
  stray = commonSum(ranks, stray);
  const bool areFew = found.count > 0 && stray * mostPart <= std::max(found.of, mostPart);
  return areFew && longestSide(found.others) <= kMostLength * longest ? found : none;
}

} // namespace pointhaptics
