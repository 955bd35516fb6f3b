#include "Haptics/HapticScene.h"

#include "Core/Base/Boxes.h"
#include "Core/Neighbors/NeighborQuery.h"
#include "Core/Neighbors/SurfaceMidpoints.h"
#include "Core/Surface/FitRadius.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <numeric>

namespace pointhaptics
{
namespace
{

constexpr double kPi = 3.14159265358979323846;
/// Proxy radius in local spacings where the caller gives none.
constexpr double kRadiusInSpacings = 2.8;
/// The index cell is at least this part of the typical spacing: finer cells would be empty.
constexpr double kCellInSpacings = 0.8;
/// Longest fit radius in index cells.
constexpr double kLargestFitRadiusInCells = 18.0;
/// An index cell is kept while it differs by less than this factor from the one that the spacing asks for.
constexpr double kCellTolerance = 1.1;
/// Index cell of a cloud without any extent, metres.
constexpr double kCellWithoutExtent = 1e-3;
/// An index cell finer than the extent over this number is not tried.
constexpr double kMostCellsAcross = 1 << 20;
/// Points per cell up to which cells are as fine as the points.
constexpr double kPointsPerFineCell = 2.0;
/// Points per cell up to which a cloud counts as sparse, if its points are also kSparseInVoxels voxels apart.
constexpr double kPointsPerSparseCell = 1.4;
constexpr double kSparseInVoxels = 1.2;
/// Least radius of the ball over the index cell: with less it enters the gaps between the means of voxels.
constexpr double kLeastRadiusInCells = 2.0;
/// Clouds of fewer than kFewPoints have no surface: the least radius is at most kOfFewPoints of their extent.
constexpr std::size_t kFewPoints = 16;
constexpr double kOfFewPoints = 0.02;
/// Margin about the box of local scenes in which cells and fields are complete, in index cells.
constexpr double kSharedCells = 8.0;
/// Largest coordinate, metres. The ball of a cloud at 1e12 m is some 50 times as large as the cloud, and its
/// rounding errors push the hand.
constexpr double kFarthest = 1e9;
constexpr std::size_t kSpacingSamples = 500;
constexpr std::size_t kSpacingNeighbors = 6;
constexpr double kSpacingGrowth = 1.3;

bool lengthsAgree(const HapticSceneInput& input)
{
  const auto agrees = [&](std::size_t size) { return size == 0 || size == input.points.size(); };
  return agrees(input.counts.size()) && agrees(input.covariances.size()) && agrees(input.proxyRadii.size());
}

/// sqrt(pi / k) times the distance of the k-th distinct cell from @p center; 0 where there are fewer.
double localSpacing(
  const CellPyramid& pyramid, const Vec3& center, double extent, std::vector<double>& distances)
{
  double radius = pyramid.level(0).voxelSize;
  do
  {
    radius *= kSpacingGrowth;
    distances.clear();
    pyramid.visitBall(0, center, radius,
      [&](std::uint32_t, const Cell&, double d2)
      {
        // Duplicates say nothing about spacing.
        if (d2 > 0.0)
        {
          distances.push_back(d2);
        }
      });
  } while (distances.size() < kSpacingNeighbors && radius < 2.0 * extent);
  if (distances.empty())
  {
    return 0.0;
  }
  const std::size_t k = std::min(distances.size(), kSpacingNeighbors);
  std::nth_element(distances.begin(), distances.begin() + std::ptrdiff_t(k - 1), distances.end());
  return std::sqrt(distances[k - 1] * kPi / double(k));
}

/// Median of the local spacing over a sample of the cells.
double typicalSpacing(const CellPyramid& pyramid, double extent)
{
  const auto& cells = pyramid.level(0).cells;
  std::vector<double> spacings;
  std::vector<double> distances;
  const std::size_t step = std::max<std::size_t>(1, cells.size() / kSpacingSamples);
  for (std::size_t i = 0; i < cells.size(); i += step)
  {
    const double spacing = localSpacing(pyramid, cells[i].mean, extent, distances);
    if (spacing > 0.0)
    {
      spacings.push_back(spacing);
    }
  }
  if (spacings.empty())
  {
    return 0.0;
  }
  const auto middle = spacings.begin() + std::ptrdiff_t(spacings.size() / 2);
  std::nth_element(spacings.begin(), middle, spacings.end());
  return *middle;
}

/// Builds the pyramid with the requested cells, or with coarser ones where those would be empty between the
/// points.
Status buildPyramid(
  const std::vector<Cell>& cells, double asked, double extent, const Vec3* corner, CellPyramid& pyramid)
{
  const double guess = extent > 0.0 ? extent / std::sqrt(double(cells.size())) : kCellWithoutExtent;
  const double first = asked > 0.0 ? std::max(asked, extent / kMostCellsAcross) : guess;
  const Status status = pyramid.build(cells, first, corner);
  if (status != Status::Ok)
  {
    return status;
  }
  const double wanted = std::max(asked, kCellInSpacings * typicalSpacing(pyramid, extent));
  const bool fits = wanted <= kCellTolerance * first && (asked > 0.0 || wanted >= first / kCellTolerance);
  return fits || !(wanted > 0.0) ? Status::Ok : pyramid.build(cells, wanted, corner);
}

std::uint64_t nextCloudNumber()
{
  static std::atomic<std::uint64_t> last{ 0 };
  return ++last;
}

std::uint64_t nextSceneNumber()
{
  static std::atomic<std::uint64_t> last{ 0 };
  return ++last;
}

std::vector<Cell> finiteCells(const HapticSceneInput& input)
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
  }
  return cells;
}

double pointsPerCell(const CellPyramid& pyramid)
{
  const std::vector<Cell>& cells = pyramid.level(0).cells;
  const double points = std::accumulate(
    cells.begin(), cells.end(), 0.0, [](double sum, const Cell& cell) { return sum + cell.count; });
  return points / double(cells.size());
}

/// Finds one radius per cell of @p nodes: that of the point of @p input nearest to the cell's mean (ties: the
/// smaller index), taken from input.proxyRadii, or, where those are empty, computed by input.bandwidth for
/// these points alone; the result is the same bit for bit.
Status nodeRadii(const CellPyramid::Level& nodes, const HapticSceneInput& input, std::vector<double>& radii,
  const Executor& executor)
{
  const PointView points(input.points.data(), std::int64_t(input.points.size()));
  NeighborQuery query;
  query.build(points, executor);
  std::vector<std::int64_t> slots(nodes.cells.size(), 0);
  forEachIndex(executor, std::int64_t(slots.size()),
    [&](std::int64_t i)
    {
      Neighbor nearest;
      if (query.nearestSlots(nodes.cells[std::size_t(i)].mean, 1, &nearest) == 1)
      {
        slots[std::size_t(i)] = NeighborQuery::slotOf(nearest);
      }
    });
  if (input.proxyRadii.empty())
  {
    return localRadiiAt(points, input.counts, query, *input.bandwidth, slots, radii, executor);
  }
  for (const std::int64_t slot : slots)
  {
    radii.push_back(input.proxyRadii[std::size_t(query.index(slot))]);
  }
  return Status::Ok;
}

/// Computes the fields at their nodes.
Status newScales(const HapticSceneInput& input, const CellPyramid& pyramid, double extent,
  const Executor& executor, std::vector<LocalScale>& scales)
{
  const double size = pyramid.level(0).voxelSize;
  const CellPyramid::Level& nodes = pyramid.level(RadiusField::nodeLevel(pyramid));
  std::vector<double> radii;
  if (input.proxyRadii.empty() && !input.bandwidth)
  {
    std::vector<double> distances;
    for (const Cell& node : nodes.cells)
    {
      const double spacing = localSpacing(pyramid, node.mean, extent, distances);
      radii.push_back(kRadiusInSpacings * std::max(spacing, size));
    }
  }
  else
  {
    const Status status = nodeRadii(nodes, input, radii, executor);
    if (status != Status::Ok)
    {
      return status;
    }
  }
  FitNeeds needs = input.local ? FitNeeds::ofFineCells() : FitNeeds();
  // Finer cells do not exist.
  needs.finerWhereShaped = !input.local && pointsPerCell(pyramid) <= kPointsPerFineCell;
  const double largest = std::max(extent, kLargestFitRadiusInCells * size);
  scales = fitScales(pyramid, largest, kLargestFitRadiusInCells * size, executor, needs, input.instructions);
  for (std::size_t i = 0; i < radii.size(); ++i)
  {
    scales[i].proxyRadius = radii[i];
  }
  return Status::Ok;
}

}

Status HapticScene::Cloud::index(const HapticSceneInput& input, std::vector<Cell> cells)
{
  number = nextCloudNumber();
  origin = input.origin;
  modelToLattice = input.modelToWorkspace;
  for (const Cell& cell : cells)
  {
    bounds.include(cell.mean);
  }
  const auto merged = [](const Cell& cell) { return cell.count > 1.0; };
  const bool ofVoxels = std::any_of(cells.begin(), cells.end(), merged);
  exactMoments = !input.covariances.empty() || !ofVoxels;
  const Vec3 above = input.corner ? bounds.minimum - *input.corner : Vec3{ -1.0, -1.0, -1.0 };
  const bool isAligned = above.x >= 0.0 && above.y >= 0.0 && above.z >= 0.0;
  const Vec3* const corner = isAligned ? &*input.corner : nullptr;
  if (norm(bounds.minimum) > kFarthest || norm(bounds.maximum) > kFarthest)
  {
    return Status::PointsTooFar;
  }
  // Local scenes have cells of one size: cells of neighbouring places must not differ.
  const Status status = input.local && input.cellSize > 0.0
    ? pyramid.build(cells, input.cellSize, corner)
    : buildPyramid(cells, input.cellSize, norm(bounds.extent()), corner, pyramid);
  leastCovering = ofVoxels && status == Status::Ok ? kRadiusInSpacings * pyramid.level(0).voxelSize : 0.0;
  return status;
}

bool HapticScene::Cloud::isSparse(double asked) const
{
  return asked > 0.0 && pointsPerCell(pyramid) <= kPointsPerSparseCell &&
    typicalSpacing(pyramid, norm(bounds.extent())) >= kSparseInVoxels * asked;
}

void HapticScene::Cloud::refineContact(double asked, const Executor& executor)
{
  std::vector<Cell> cells = pyramid.level(0).cells;
  std::vector<Vec3> points(cells.size());
  std::transform(cells.begin(), cells.end(), points.begin(), [](const Cell& cell) { return cell.mean; });
  const PointView view(points.data(), std::int64_t(points.size()));
  const std::vector<Vec3> middles = surfaceMidpoints(view, kSparseInVoxels * asked, executor);
  if (middles.empty())
  {
    return;
  }
  for (const Vec3& middle : middles)
  {
    Cell cell;
    cell.mean = middle;
    cell.count = 1.0;
    cells.push_back(cell);
  }
  contact = std::make_unique<CellPyramid>();
  const Vec3 corner = pyramid.corner();
  if (contact->build(cells, std::max(asked, 0.5 * pyramid.level(0).voxelSize), &corner) != Status::Ok)
  {
    contact.reset();
  }
}

void HapticScene::Cloud::buildField(const HapticSceneInput& input, const Executor& executor)
{
  const CellPyramid& points = contact ? *contact : pyramid;
  SheetFieldSettings settings;
  settings.leastRadius = kLeastRadiusInCells * points.level(0).voxelSize;
  const double extent = norm(bounds.extent());
  if (points.level(0).cells.size() < kFewPoints && extent > 0.0)
  {
    settings.leastRadius = std::min(settings.leastRadius, kOfFewPoints * extent);
  }
  if (input.bandwidth)
  {
    settings.leastRadius = std::max(settings.leastRadius, input.bandwidth->minimumRadius);
    settings.mostRadius = input.bandwidth->maximumRadius;
  }
  Bounds felt = input.local ? input.local->covered : Bounds();
  felt = felt.empty() ? felt : grown(felt, kSharedCells * pyramid.level(0).voxelSize);
  const HapticScene* const global = input.local ? input.local->global.get() : nullptr;
  std::function<double(const Vec3&)> coarser;
  if (global)
  {
    const double globalScale = global->latticeScale();
    Bounds box;
    box.include(global->toLattice(felt.minimum));
    box.include(global->toLattice(felt.maximum));
    if (global->contactField().isSparseNear(grown(box, norm(felt.extent()) / globalScale)))
    {
      coarser = [global, globalScale, this](const Vec3& place)
      {
        const double search = kSharedCells * pyramid.level(0).voxelSize / globalScale;
        return globalScale * global->contactField().sparseRadiusAt(global->toLattice(place), search);
      };
    }
  }
  field.build(points, settings, felt, executor, coarser);
}

Status HapticScene::Cloud::measure(HapticSceneInput input, const Executor& executor)
{
  std::vector<LocalScale> scales;
  // With few points a fit may grow over the whole cloud.
  const Status status = newScales(input, pyramid, norm(bounds.extent()), executor, scales);
  if (status != Status::Ok)
  {
    return status;
  }
  input = HapticSceneInput(); // its memory is needed for the field
  scale.build(pyramid, std::move(scales));
  pyramid.reclassifyMixedCells([this](const Vec3& place) { return scale.noiseAt(pyramid, place); });
  // Beyond a node's reach no cell of its voxel is nearer than the reach less the voxel's diagonal.
  const int nodeLevel = RadiusField::nodeLevel(pyramid);
  clearance = scale.reach() - std::sqrt(3.0) * pyramid.level(nodeLevel).voxelSize;
  return Status::Ok;
}

HapticScene::HapticScene()
  : number_(nextSceneNumber())
{
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
  std::vector<Cell> cells = finiteCells(input);
  if (cells.empty())
  {
    status = Status::Empty;
    return nullptr;
  }
  const auto cloud = std::make_shared<Cloud>();
  const std::optional<HapticSceneInput::Local> local = input.local;
  status = cloud->index(input, std::move(cells));
  // A local scene has cells as fine as its points.
  if (status == Status::Ok && !local && cloud->isSparse(input.cellSize))
  {
    cloud->refineContact(input.cellSize, executor);
  }
  if (status == Status::Ok)
  {
    cloud->buildField(input, executor);
    status = cloud->measure(std::move(input), executor);
  }
  if (status != Status::Ok)
  {
    return nullptr;
  }
  std::shared_ptr<HapticScene> scene(new HapticScene());
  scene->modelToWorkspace_ = cloud->modelToLattice;
  if (local)
  {
    cloud->covered = local->covered;
    scene->fallback_ = local->global->moved(cloud->modelToLattice, status);
    if (!scene->fallback_)
    {
      return nullptr;
    }
  }
  scene->cloud_ = cloud;
  return scene;
}

std::shared_ptr<const HapticScene> HapticScene::moved(
  const AffineTransform& modelToWorkspace, Status& status) const
{
  status = modelToWorkspace.check();
  if (status != Status::Ok)
  {
    return nullptr;
  }
  std::shared_ptr<HapticScene> scene(new HapticScene());
  scene->cloud_ = cloud_;
  scene->modelToWorkspace_ = modelToWorkspace;
  scene->isMoved_ = !(modelToWorkspace == modelToLattice());
  if (scene->isMoved_)
  {
    scene->latticeToWorkspace_ = modelToWorkspace * modelToLattice().inverse();
    scene->workspaceToLattice_ = scene->latticeToWorkspace_.inverse();
    if (!scene->latticeToWorkspace_.isSimilarity(scene->scale_))
    {
      status = Status::InvalidParameter;
      return nullptr;
    }
  }
  if (fallback_)
  {
    scene->fallback_ = fallback_->moved(modelToWorkspace, status);
  }
  return status == Status::Ok ? scene : nullptr;
}

Bounds HapticScene::sharedWith(const HapticScene& other) const noexcept
{
  const bool isShared = fallback_ && other.fallback_ && globalCloudNumber() == other.globalCloudNumber() &&
    modelToLattice() == other.modelToLattice() && cellSize() == other.cellSize() &&
    pyramid().corner() == other.pyramid().corner();
  return isShared ? grown(intersection(covered(), other.covered()), kSharedCells * cellSize()) : Bounds();
}

bool HapticScene::isNear(const Vec3& position) const noexcept
{
  return pyramid().anyWithin(
    RadiusField::nodeLevel(pyramid()), position, cloud_->scale.reach(), [](const Cell&) { return true; });
}

bool HapticScene::covers(const Vec3& p) const noexcept
{
  return cloud_->covered.empty() || contains(cloud_->covered, p);
}

} // namespace pointhaptics
