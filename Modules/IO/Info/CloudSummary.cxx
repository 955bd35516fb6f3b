#include "IO/Info/CloudSummary.h"

#include "IO/Info/CloudExtent.h"
#include "IO/Info/FieldText.h"
#include "IO/Info/LengthUnit.h"

#include "Core/Base/Boxes.h"
#include "Core/Base/Lattice.h"
#include "Core/Distributed/FarPoints.h"
#include "Core/Neighbors/NeighborQuery.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace pointhaptics
{
namespace
{

constexpr std::size_t kSamples = 10000;
/// A surface with a point every spacing has four in a voxel of twice that.
constexpr double kSpacingsPerVoxel = 2.0;
/// Points in one search tree; larger clouds are searched piece by piece.
constexpr std::int64_t kPiece = 4'000'000;
/// A place and the nearest other one; a few more where squares of tiny distances underflow.
constexpr int kNeighbors = 16;
/// Part of the workspace's edge the suggested scale fills.
constexpr double kFilledPart = 0.9;
/// Longest side of a cloud that needs no hint, in edges of the workspace.
constexpr double kSmallest = 0.2;
constexpr double kLargest = 5.0;

struct Unit
{
  const char* name;
  double fromSize; ///< The longest side from which a cloud may well be in this unit.
  double toSize;
};
constexpr Unit kUnits[] = { { "cm", 2.0, 20.0 }, { "mm", 20.0, 500.0 }, { "um", 2e4, 5e5 } };

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

/// The point behind sample @p i: all of them where they are few. Every k-th would meet the rings of a scanner
/// in step; a multiplicative hash does not.
std::size_t sampled(std::size_t i, std::size_t samples, std::size_t points)
{
  return samples == points ? i : std::size_t((i * 0x9e3779b97f4a7c15u >> 11) % points);
}

/// Every place once, in order.
std::vector<Vec3> placesOf(std::vector<Vec3> points)
{
  std::sort(points.begin(), points.end(),
    [](const Vec3& a, const Vec3& b) { return a.x != b.x ? a.x < b.x
                                         : a.y != b.y    ? a.y < b.y
                                                         : a.z < b.z; });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

/// What each of kSpacingPercents of the @p distances does not exceed.
std::array<double, 5> percentilesOf(std::vector<double> distances)
{
  std::sort(distances.begin(), distances.end());
  std::array<double, 5> result{};
  for (std::size_t i = 0; i < result.size() && !distances.empty(); ++i)
  {
    result[i] = distances[(distances.size() - 1) * std::size_t(kSpacingPercents[i]) / 100];
  }
  return result;
}

/// The median of the @p distances of the @p samples about some of them. Of points at random the
/// distance to the nearest one varies 8 : 1 by chance; the median varies where the density does.
/// @param query of the samples.
std::vector<double> smoothed(
  const NeighborQuery& query, const std::vector<Vec3>& samples, const std::vector<double>& distances)
{
  constexpr std::size_t kMost = 128;
  constexpr std::size_t kPlaces = 300; // each sample is about four of them
  constexpr std::size_t kPart = 50;    // no more than this part of the samples are about one
  const std::size_t count = std::clamp<std::size_t>(samples.size() / kPart, 1, kMost);
  std::vector<Neighbor> about(count);
  std::vector<double> medians;
  std::vector<double> values(count);
  for (std::size_t i = 0; i < samples.size(); i += 1 + samples.size() / kPlaces)
  {
    const auto found = std::size_t(query.nearest(samples[i], int(count), about.data()));
    const auto middle = values.begin() + std::ptrdiff_t(found / 2);
    const auto end = std::transform(about.begin(), about.begin() + std::ptrdiff_t(found), values.begin(),
      [&](const Neighbor& neighbor) { return distances[std::size_t(neighbor.index)]; });
    std::nth_element(values.begin(), middle, end);
    medians.push_back(*middle);
  }
  return medians;
}

/// The spacing that 95 percent of the surface do not exceed, over that of 5 percent. Each of the @p spacings
/// stands for an area of its square: where points are sparse, few of them cover as much.
double variationOf(std::vector<double> spacings)
{
  constexpr double kEnd = 0.05;
  std::sort(spacings.begin(), spacings.end());
  double area = 0.0;
  for (const double spacing : spacings)
  {
    area += spacing * spacing;
  }
  double low = 0.0;
  double high = 0.0;
  double below = 0.0;
  for (const double spacing : spacings)
  {
    low = below <= kEnd * area ? spacing : low;
    high = below <= (1.0 - kEnd) * area ? spacing : high;
    below += spacing * spacing;
  }
  return low > 0.0 ? high / low : 0.0;
}

/// Lowers each of @p nearest to the distance of its sample of @p places from the nearest other one in @p
/// query.
void takeNearest(const NeighborQuery& query, const std::vector<Vec3>& places, std::vector<double>& nearest)
{
  const std::size_t samples = nearest.size();
  Neighbor neighbors[kNeighbors];
  for (std::size_t i = 0; i < samples; ++i)
  {
    const Neighbor* end =
      neighbors + query.nearest(places[sampled(i, samples, places.size())], kNeighbors, neighbors);
    const Neighbor* other = std::find_if<const Neighbor*>(
      neighbors, end, [](const Neighbor& each) { return each.squaredDistance > 0.0; });
    nearest[i] = other != end ? std::min(nearest[i], std::sqrt(other->squaredDistance)) : nearest[i];
  }
}

/// Sets spacing and densityVariation. @param places of the points, each once: how often a point stands there
/// tells nothing of a surface.
void addSpacing(const std::vector<Vec3>& places, CloudSummary& summary)
{
  const std::size_t samples = std::min(kSamples, places.size());
  std::vector<double> nearest(samples, std::numeric_limits<double>::infinity());
  NeighborQuery query;
  for (std::int64_t begin = 0; begin < std::int64_t(places.size()); begin += kPiece)
  {
    query.build(PointView(places.data() + begin, std::min(kPiece, std::int64_t(places.size()) - begin)));
    takeNearest(query, places, nearest);
  }
  std::vector<Vec3> centers;
  std::vector<double> distances;
  for (std::size_t i = 0; i < samples; ++i)
  {
    if (!std::isinf(nearest[i]))
    {
      centers.push_back(places[sampled(i, samples, places.size())]);
      distances.push_back(nearest[i]);
    }
  }
  if (centers.size() < places.size())
  {
    query.build(PointView(centers.data(), std::int64_t(centers.size())));
  }
  summary.spacing = percentilesOf(distances);
  summary.densityVariation = variationOf(smoothed(query, centers, distances));
}

double numberIn(vtkPolyData* cloud, const char* name, vtkIdType row = 0, int component = 0)
{
  vtkDataArray* array = cloud->GetFieldData()->GetArray(name);
  const bool isThere =
    array && row < array->GetNumberOfTuples() && component < array->GetNumberOfComponents();
  return isThere ? array->GetComponent(row, component) : 0.0;
}

std::vector<ScanSummary> scansOf(vtkPolyData* cloud)
{
  std::vector<ScanSummary> scans;
  vtkAbstractArray* names = cloud->GetFieldData()->GetAbstractArray("ScanNames");
  for (vtkIdType row = 0; names && row < names->GetNumberOfTuples(); ++row)
  {
    ScanSummary scan;
    scan.name = io::fieldText(cloud->GetFieldData(), "ScanNames", row);
    scan.points = std::int64_t(numberIn(cloud, "ScanPoints", row));
    for (std::size_t i = 0; i < scan.pose.size(); ++i)
    {
      scan.pose[i] = numberIn(cloud, "ScanPoses", row, int(i));
    }
    scans.push_back(scan);
  }
  return scans;
}

/// Mean and standard deviation of the finite values of a component, by Welford's sums.
void addStatistics(vtkDataArray* array, int component, ArraySummary& summary)
{
  double mean = 0.0;
  double squares = 0.0;
  std::int64_t count = 0;
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    const double value = array->GetComponent(i, component);
    if (std::isfinite(value))
    {
      const double before = value - mean;
      mean += before / double(++count);
      squares += before * (value - mean);
    }
  }
  const double none = std::numeric_limits<double>::quiet_NaN();
  summary.means.push_back(count > 0 ? mean : none);
  summary.deviations.push_back(count > 0 ? std::sqrt(squares / double(count)) : none);
}

ArraySummary summaryOf(vtkAbstractArray* abstract, bool statistics)
{
  ArraySummary summary;
  summary.name = abstract->GetName() ? abstract->GetName() : "(no name)";
  summary.type = abstract->GetDataTypeAsString();
  summary.components = abstract->GetNumberOfComponents();
  vtkDataArray* array = vtkDataArray::SafeDownCast(abstract);
  for (int component = 0; array && component < summary.components; ++component)
  {
    double range[2];
    array->GetFiniteRange(range, component);
    const bool isEmpty = !(range[0] <= range[1]);
    const double none = std::numeric_limits<double>::quiet_NaN();
    summary.minima.push_back(isEmpty ? none : range[0]);
    summary.maxima.push_back(isEmpty ? none : range[1]);
    if (statistics)
    {
      addStatistics(array, component, summary);
    }
  }
  return summary;
}

/// @param known: what the coordinates are measured in, as far as the file and its points tell.
void suggest(const LengthUnit& known, const Bounds& bounds, CloudSummary& summary)
{
  const Vec3 size = bounds.extent();
  const double longest = std::max({ size.x, size.y, size.z });
  if (!(longest > 0.0) || !std::isfinite(longest))
  {
    return;
  }
  if (known.name == "deg")
  {
    summary.hint = std::string("degrees") + (known.evidence == UnitEvidence::File ? "" : ", as guessed,") +
      " are no lengths: spacing, voxel and bandwidth mean nothing before the cloud is "
      "projected to metres";
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
    if (known.evidence == UnitEvidence::None && longest >= unit.fromSize && longest < unit.toSize)
    {
      summary.hint += fmt::format(" --unit {} if it is in {},", unit.name, unit.name);
    }
  }
  if (known.evidence != UnitEvidence::None && known.name != "m")
  {
    const char* const evidence = (known.evidence == UnitEvidence::File) ? "as the file says" : "by its size";
    summary.hint += fmt::format(" --unit {} {},", known.name, evidence);
  }
  summary.hint += fmt::format(
    "{} --scale {} to fill the workspace", summary.hint.back() == ',' ? " or" : "", summary.suggestedScale);
}

} // namespace

CloudSummary summarize(vtkPolyData* cloud, const std::string& format, bool statistics)
{
  CloudSummary summary;
  summary.format = format;
  summary.generator = io::fieldText(cloud->GetFieldData(), "Generator");
  summary.chunks = std::int64_t(numberIn(cloud, "Chunks"));
  summary.scans = scansOf(cloud);
  summary.points = cloud->GetNumberOfPoints();
  summary.isFloat = cloud->GetPoints() && cloud->GetPoints()->GetDataType() == VTK_FLOAT;
  std::vector<Vec3> points = finitePoints(cloud);
  if (statistics && cloud->GetPoints())
  {
    vtkNew<vtkDoubleArray> finite;
    finite->SetNumberOfComponents(3);
    finite->SetArray(&points.data()->x, 3 * vtkIdType(points.size()), 1);
    summary.coordinates = summaryOf(finite, true);
    summary.coordinates.type = cloud->GetPoints()->GetData()->GetDataTypeAsString();
  }
  const CloudExtent extent = extentOf(cloud);
  summary.invalid = extent.invalid;
  summary.bounds = extent.all;
  summary.noReturns = extent.noReturns;
  const FarPoints far = findFarPoints(PointView(points.data(), std::int64_t(points.size())), summary.bounds);
  std::vector<Vec3> places = placesOf(points);
  summary.duplicates = std::int64_t(points.size() - places.size());
  if (summary.noReturns > 0)
  {
    places.erase(std::find_if(places.begin(), places.end(), isAtZero));
  }
  if (summary.duplicates == 0)
  {
    places = std::vector<Vec3>(); // the points serve as well, and the memory is wanted
  }
  addSpacing(summary.duplicates > 0 ? places : points, summary);
  const Vec3 steps = summary.isFloat && !far.others.empty() ? floatSteps(far.others) : Vec3();
  summary.suggestedVoxel = std::max({ kSpacingsPerVoxel * summary.spacing[2], steps.x, steps.y, steps.z });
  summary.coordinateSystem = io::fieldText(cloud->GetFieldData(), "CoordinateSystem");
  const std::string said = io::fieldText(cloud->GetFieldData(), "LengthUnit");
  summary.unit = lengthUnitCalled(said).empty() ? said : lengthUnitCalled(said);
  summary.unitIsGuess = said.empty();
  summary.farPoints = far.count > 0 ? far.note() : "";
  const LengthUnit unit =
    looksLikeDegrees(cloud) ? LengthUnit{ "deg", 1.0, UnitEvidence::Shape } : lengthUnitOf(cloud, far.others);
  if (summary.unitIsGuess && !summary.bounds.empty())
  {
    summary.unit = unit.name;
    summary.unitIsTold = unit.evidence != UnitEvidence::None;
  }
  for (int i = 0; i < cloud->GetPointData()->GetNumberOfArrays(); ++i)
  {
    summary.arrays.push_back(summaryOf(cloud->GetPointData()->GetAbstractArray(i), statistics));
  }
  suggest(unit, far.others, summary);
  return summary;
}

} // namespace pointhaptics
