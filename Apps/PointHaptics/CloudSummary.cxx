#include "CloudSummary.h"

#include "Core/Lattice.h"
#include "Core/NeighborQuery.h"

#include <fmt/format.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pointhaptics
{
namespace app
{
namespace
{

constexpr std::size_t kSamples = 1000;
/// Points in one search tree; larger clouds are searched piece by piece.
constexpr std::int64_t kPiece = 4'000'000;
/// A duplicate is no neighbour: how many of them are looked past.
constexpr int kNeighbors = 16;
/// Part of the workspace's edge the suggested scale fills.
constexpr double kFilledPart = 0.9;
/// Longest side of a cloud that needs no hint, in edges of the workspace.
constexpr double kSmallest = 0.2;
constexpr double kLargest = 5.0;

struct Unit
{
  const char* name;
  double metres;
  double fromSize; ///< The longest side from which a cloud may well be in this unit.
  double toSize;
};
constexpr Unit kUnits[] = { { "cm", 1e-2, 2.0, 20.0 }, { "mm", 1e-3, 20.0, 500.0 },
  { "um", 1e-6, 2e4, 5e5 } };

std::vector<Vec3> finitePoints(vtkPolyData* cloud)
{
  std::vector<Vec3> points;
  points.reserve(static_cast<std::size_t>(cloud->GetNumberOfPoints()));
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    Vec3 p;
    cloud->GetPoint(i, &p.x);
    if (isFinite(p))
    {
      points.push_back(p);
    }
  }
  return points;
}

double medianSpacing(const std::vector<Vec3>& points)
{
  const std::size_t samples = std::min(kSamples, points.size());
  std::vector<double> nearest(samples, std::numeric_limits<double>::infinity());
  Neighbor neighbors[kNeighbors];
  for (std::int64_t begin = 0; begin < std::int64_t(points.size()); begin += kPiece)
  {
    NeighborQuery query;
    query.build(PointView(points.data() + begin, std::min(kPiece, std::int64_t(points.size()) - begin)));
    for (std::size_t i = 0; i < samples; ++i)
    {
      const Vec3& center = points[i * (points.size() / samples)];
      const int found = query.nearest(center, kNeighbors, neighbors);
      const Neighbor* other = std::find_if(neighbors, neighbors + found,
        [](const Neighbor& neighbor) { return neighbor.squaredDistance > 0.0; });
      if (other != neighbors + found)
      {
        nearest[i] = std::min(nearest[i], std::sqrt(other->squaredDistance));
      }
    }
  }
  nearest.erase(
    std::remove_if(nearest.begin(), nearest.end(), [](double d) { return std::isinf(d); }), nearest.end());
  if (nearest.empty())
  {
    return 0.0;
  }
  std::nth_element(nearest.begin(), nearest.begin() + std::ptrdiff_t(nearest.size() / 2), nearest.end());
  return nearest[nearest.size() / 2];
}

std::vector<ArraySummary> arraysOf(vtkPolyData* cloud)
{
  std::vector<ArraySummary> result;
  vtkPointData* data = cloud->GetPointData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* abstract = data->GetAbstractArray(i);
    ArraySummary summary;
    summary.name = abstract->GetName() ? abstract->GetName() : "(no name)";
    summary.type = abstract->GetDataTypeAsString();
    summary.components = abstract->GetNumberOfComponents();
    if (vtkDataArray* array = vtkDataArray::SafeDownCast(abstract))
    {
      for (int component = 0; component < summary.components; ++component)
      {
        double range[2];
        array->GetFiniteRange(range, component);
        if (range[0] <= range[1])
        {
          summary.minima.push_back(range[0]);
          summary.maxima.push_back(range[1]);
        }
      }
    }
    result.push_back(summary);
  }
  return result;
}

void suggest(CloudSummary& summary)
{
  const Vec3 size = summary.bounds.extent();
  const double longest = std::max({ size.x, size.y, size.z });
  if (!(longest > 0.0) || !std::isfinite(longest))
  {
    return;
  }
  summary.suggestedScale = std::stod(fmt::format("{:.3g}", kFilledPart * kDefaultWorkspaceEdge / longest));
  if (longest >= kSmallest * kDefaultWorkspaceEdge && longest <= kLargest * kDefaultWorkspaceEdge)
  {
    return;
  }
  summary.hint = fmt::format(
    "read as metres the longest side is {:.4g} m, the workspace {} m;", longest, kDefaultWorkspaceEdge);
  for (const Unit& unit : kUnits)
  {
    if (longest >= unit.fromSize && longest < unit.toSize)
    {
      summary.hint += fmt::format(" --unit {} if it is in {},", unit.name, unit.name);
    }
  }
  summary.hint += fmt::format(" --scale {} to fill the workspace", summary.suggestedScale);
}

} // namespace

CloudSummary summarize(const Cloud& cloud)
{
  CloudSummary summary;
  summary.format = cloud.format;
  summary.points = cloud.points->GetNumberOfPoints();
  const std::vector<Vec3> points = finitePoints(cloud.points);
  summary.invalid = summary.points - std::int64_t(points.size());
  for (const Vec3& p : points)
  {
    summary.bounds.include(p);
  }
  summary.spacing = medianSpacing(points);
  summary.arrays = arraysOf(cloud.points);
  suggest(summary);
  return summary;
}

} // namespace app
} // namespace pointhaptics
