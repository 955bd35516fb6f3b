#include "Haptics/HapticScene.h"

#include "Core/FitRadius.h"
#include "Core/NeighborQuery.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace
{

constexpr double kPi = 3.14159265358979323846;
/// Proxy radius in local spacings where the caller gives none.
constexpr double kRadiusInSpacings = 2.8;
/// The index cell is at least this part of the typical spacing: finer ones would be empty.
constexpr double kCellInSpacings = 0.8;
/// Longest fit radius in index cells.
constexpr double kLargestFitRadiusInCells = 15.0;
constexpr std::int64_t kSpacingSamples = 2000;
constexpr int kSpacingNeighbors = 6;

bool lengthsAgree(const HapticSceneInput& input)
{
  const auto agrees = [&](std::size_t size) { return size == 0 || size == input.points.size(); };
  return agrees(input.counts.size()) && agrees(input.covariances.size()) && agrees(input.proxyRadii.size());
}

/// Median over a sample of points of sqrt(pi / k) times the distance of the k-th distinct neighbour.
double typicalSpacing(const std::vector<Cell>& cells)
{
  std::vector<Vec3> points;
  points.reserve(cells.size());
  for (const Cell& cell : cells)
  {
    points.push_back(cell.mean);
  }
  NeighborQuery query;
  query.build(PointView(points.data(), std::int64_t(points.size())));
  std::vector<double> spacings;
  const std::int64_t step = std::max<std::int64_t>(1, query.size() / kSpacingSamples);
  for (std::int64_t i = 0; i < query.size(); i += step)
  {
    // Duplicates say nothing about spacing: look further until there is a distance.
    for (int k = kSpacingNeighbors; k <= 1024; k *= 4)
    {
      std::vector<Neighbor> found(std::size_t(k) + 1);
      const int count = query.nearest(points[std::size_t(i)], k + 1, found.data());
      const double reach = count > 1 ? std::sqrt(found[std::size_t(count) - 1].squaredDistance) : 0.0;
      if (reach > 0.0)
      {
        spacings.push_back(reach * std::sqrt(kPi / double(count - 1)));
        break;
      }
    }
  }
  if (spacings.empty())
  {
    return 0.0;
  }
  std::nth_element(spacings.begin(), spacings.begin() + std::ptrdiff_t(spacings.size() / 2), spacings.end());
  return spacings[spacings.size() / 2];
}

double medianOf(std::vector<double> values)
{
  std::nth_element(values.begin(), values.begin() + std::ptrdiff_t(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// Edge of the finest index cell for a cloud of this extent and spacing.
double indexCellSize(double asked, double spacing, double extent)
{
  double size = std::max(asked, kCellInSpacings * spacing);
  if (!(size > 0.0))
  {
    size = extent > 0.0 ? 1e-3 * extent : 1e-3;
  }
  return size;
}

/// Node values: the mean of the cells' radii about each node.
std::vector<LocalScale> averageRadii(
  const CellPyramid& pyramid, int nodeLevel, const std::vector<double>& radii)
{
  const auto& nodes = pyramid.level(nodeLevel);
  std::vector<LocalScale> values(nodes.cells.size());
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    double sum = 0.0;
    double count = 0.0;
    double reach = nodes.voxelSize;
    while (count == 0.0)
    {
      pyramid.visitBall(0, nodes.cells[i].mean, reach,
        [&](std::uint32_t cell, const Cell&, double)
        {
          sum += radii[cell];
          count += 1.0;
        });
      reach *= 2.0;
    }
    values[i].radius = sum / count;
  }
  return values;
}

std::vector<Cell> finiteCells(const HapticSceneInput& input, std::vector<double>& radii)
{
  std::vector<Cell> cells;
  cells.reserve(input.points.size());
  for (std::size_t i = 0; i < input.points.size(); ++i)
  {
    if (!isFinite(input.points[i]))
    {
      continue;
    }
    Cell cell;
    cell.mean = input.points[i];
    cell.count = input.counts.empty() ? 1.0 : std::max(1.0, input.counts[i]);
    if (!input.covariances.empty() && isFinite(input.covariances[i]))
    {
      cell.covariance = input.covariances[i];
    }
    cells.push_back(cell);
    if (!input.proxyRadii.empty())
    {
      radii.push_back(input.proxyRadii[i]);
    }
  }
  return cells;
}

}

std::shared_ptr<const HapticScene> HapticScene::create(
  HapticSceneInput input, Status& status, const Executor& executor)
{
  if (!lengthsAgree(input) || !(input.cellSize >= 0.0) || !std::isfinite(input.cellSize))
  {
    status = Status::InvalidParameter;
    return nullptr;
  }
  status = input.modelToWorkspace.check();
  if (status != Status::Ok)
  {
    return nullptr;
  }
  std::vector<double> radii;
  std::vector<Cell> cells = finiteCells(input, radii);
  if (cells.empty())
  {
    status = Status::Empty;
    return nullptr;
  }
  std::shared_ptr<HapticScene> scene(new HapticScene());
  scene->modelToWorkspace_ = input.modelToWorkspace;
  for (const Cell& cell : cells)
  {
    scene->bounds_.include(cell.mean);
  }
  const double extent = norm(scene->bounds_.extent());
  const double spacing = radii.empty() ? typicalSpacing(cells) : medianOf(radii) / kRadiusInSpacings;
  const double size = indexCellSize(input.cellSize, spacing, extent);
  input = HapticSceneInput();

  std::vector<std::uint32_t> source;
  status = scene->pyramid_.build(std::move(cells), size, source);
  if (status != Status::Ok)
  {
    return nullptr;
  }
  const int nodeLevel = RadiusField::nodeLevel(scene->pyramid_);
  const std::size_t nodes = scene->pyramid_.level(nodeLevel).cells.size();
  std::vector<LocalScale> proxyRadii(nodes, LocalScale{ kRadiusInSpacings * std::max(spacing, size), 0.0 });
  if (!radii.empty())
  {
    std::vector<double> sorted(radii.size());
    for (std::size_t i = 0; i < sorted.size(); ++i)
    {
      sorted[i] = radii[source[i]];
    }
    proxyRadii = averageRadii(scene->pyramid_, nodeLevel, sorted);
  }
  scene->radius_.build(scene->pyramid_, std::move(proxyRadii));
  const double largest = std::max(extent, kLargestFitRadiusInCells * size);
  scene->fitScale_.build(
    scene->pyramid_, fitScales(scene->pyramid_, largest, kLargestFitRadiusInCells * size, executor));
  // Beyond a node's reach no cell of its voxel can be nearer than the reach less the voxel's diagonal.
  const double diagonal = std::sqrt(3.0) * scene->pyramid_.level(nodeLevel).voxelSize;
  scene->clearance_ = scene->fitScale_.reach() - diagonal;
  return scene;
}

double HapticScene::proxyRadius(const Vec3& position) const noexcept
{
  return radius_.at(pyramid_, position).radius;
}

LocalScale HapticScene::fitScale(const Vec3& position) const noexcept
{
  return fitScale_.at(pyramid_, position);
}

bool HapticScene::isNear(const Vec3& position) const noexcept
{
  bool found = false;
  pyramid_.visitBall(RadiusField::nodeLevel(pyramid_), position, fitScale_.reach(),
    [&](std::uint32_t, const Cell&, double) { found = true; });
  return found;
}

} // namespace pointhaptics
