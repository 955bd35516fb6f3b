#include "Haptics/LocalScene.h"

#include "Core/Base/Boxes.h"
#include "Core/Surface/SurfaceFit.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pointhaptics
{
namespace
{

constexpr double kPi = 3.14159265358979323846;
/// Margin of points about the covered box, in cells: the reach of a field's nodes and of their fits.
constexpr double kMarginCells = 18.0;
/// A cloud is smooth up to kSmooth, the RMS distance of its points from the fits, and noisy from kThick on,
/// the thickness within a voxel; both over the voxel. Distances above kShapeOverNoise times the thickness are
/// shape.
constexpr double kSmooth = 1e-3;
/// Limit as kSmooth for fits kWide times as wide, which take all cells.
constexpr double kSmoothWide = 8e-3;
constexpr double kWide = 2.0;
constexpr double kThick = 0.1;
constexpr double kShapeOverNoise = 2.0;
/// Points that determine a voxel's thickness (a plane takes three), and voxels that must have so many.
constexpr double kPointsForThickness = 6.0;
constexpr double kPointsOfPlane = 3.0;
constexpr std::size_t kCellsForThickness = 5;
constexpr int kThicknessLevels = 2;
/// Levels whose cells show edges and second sheets.
constexpr int kMixedLevels = 2;
/// A finer scene is worth it only if its cell is at most this part of the global one.
constexpr double kCoarsest = 0.75;
/// A global fit radius of more cells than this gains nothing by finer ones.
constexpr double kCellsInFit = 16.0;

/// RMS residual, metres, of one surface through all cells within @p radius of the cell nearest to @p place.
/// The residual is near zero on a smooth surface. At an edge or between two sheets it is large, where a fit
/// of one sheet would see nothing of the other.
double residualOfAll(const CellPyramid& pyramid, const Vec3& place, double radius, FitCells& memory)
{
  double distance = 0.0;
  const std::int64_t seed = pyramid.nearest(0, place, 2.0 * radius, distance);
  Vec3 normal;
  if (seed < 0)
  {
    return INFINITY;
  }
  SurfaceFrame frame;
  frame.origin = pyramid.level(0).cells[std::size_t(seed)].mean;
  if (!principalNormal(pyramid, frame.origin, radius, memory, normal))
  {
    return INFINITY;
  }
  frame.turnTo(normal);
  FitSettings settings;
  settings.radius = radius;
  const SurfaceFit fit = fitSurface(pyramid, frame, settings, memory);
  return fit.quality == FitQuality::Quadric ? fit.residual : INFINITY;
}

/// Median thickness, metres, of the voxels within @p reach of @p seed: of the finest voxels that hold enough
/// points to have one. Negative: too few do. Noise of more than a cell leaves a point or two in each
/// finest voxel, and shows in the next ones.
double thicknessOf(const CellPyramid& pyramid, const Vec3& seed, double reach)
{
  for (int level = 0; level < std::min(kThicknessLevels, pyramid.numberOfCellLevels()); ++level)
  {
    std::vector<double> thicknesses;
    pyramid.visitBall(level, seed, reach,
      [&](std::uint32_t, const Cell& cell, double)
      {
        if (cell.count >= kPointsForThickness)
        {
          const double variance = std::max(0.0, symmetricEigen(cell.covariance).values[0]);
          thicknesses.push_back(std::sqrt(variance * cell.count / (cell.count - kPointsOfPlane)));
        }
      });
    if (thicknesses.size() >= kCellsForThickness)
    {
      const auto middle = thicknesses.begin() + std::ptrdiff_t(thicknesses.size() / 2);
      std::nth_element(thicknesses.begin(), middle, thicknesses.end());
      return *middle;
    }
  }
  return -1.0;
}

/// True if smaller fits would resolve more within @p reach of @p seed. Points lie on the fits of the global
/// scene where it is smooth, and off them by their noise where it is noisy. Noise is as large within a voxel
/// as in a whole fit; a larger distance in a fit than in its voxels is shape.
bool hasFineShape(const HapticScene& global, const Vec3& seed, double reach)
{
  const CellPyramid& pyramid = global.pyramid();
  const double edge = global.cellSize();
  const double thickness = thicknessOf(pyramid, seed, reach);
  if (thickness < 0.0 || !(thickness < kThick * edge))
  {
    return thickness < 0.0;
  }
  bool isMixed = false;
  for (int level = 1; level <= std::min(kMixedLevels, pyramid.numberOfCellLevels() - 1); ++level)
  {
    pyramid.visitBall(
      level, seed, reach, [&](std::uint32_t, const Cell& cell, double) { isMixed |= cell.mixed; });
  }
  const double noise = kShapeOverNoise * thickness;
  const auto memory = std::make_unique<FitCells>();
  bool isShaped = isMixed;
  const int nodes = RadiusField::nodeLevel(pyramid);
  pyramid.visitBall(nodes, seed, reach + pyramid.level(nodes).voxelSize,
    [&](std::uint32_t, const Cell& node, double)
    {
      const double wide = kWide * global.fitScale(node.mean).countRadius;
      isShaped = isShaped || global.noise(node.mean) > std::max(kSmooth * edge, noise) ||
        residualOfAll(pyramid, node.mean, wide, *memory) > std::max(kSmoothWide * edge, noise);
    });
  return isShaped;
}

/// The voxels of @p lattice about @p box, in whole cells of the levels that a fit may see there; none where
/// the box is outside.
Lattice partOf(const Lattice& lattice, const Bounds& box)
{
  constexpr double kBlock = 4.0;
  Lattice part = lattice;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double block = kBlock * lattice.spacing[axis];
    const double dimension = double(lattice.dimensions[std::size_t(axis)]);
    const auto blocks = [&](double place) { return (place - lattice.origin[axis]) / block; };
    const double first = std::max(0.0, kBlock * std::floor(blocks(box.minimum[axis])));
    const double end = std::min(dimension, kBlock * std::ceil(blocks(box.maximum[axis])));
    part.origin[axis] = lattice.origin[axis] + first * lattice.spacing[axis];
    part.dimensions[std::size_t(axis)] = std::int64_t(end - first);
    part.end[axis] = lattice.end[axis] - first;
  }
  return part;
}

/// Edge of the cells in a scene about @p hand (workspace), metres of the lattice frame of @p global; 0: the
/// global cells are fine enough.
double cellSizeNear(const Bounds& hand, const HapticScene& global) noexcept
{
  const CellPyramid& pyramid = global.pyramid();
  const double coarse = global.cellSize();
  const Vec3 place = global.toLattice(hand.center());
  const double reach = (LocalSceneBuilder::kReach + 0.5 * norm(hand.extent())) / global.latticeScale();
  const LocalScale scale = global.fitScale(place);
  double distance = 0.0;
  const std::int64_t nearest = pyramid.nearest(0, place, 2.0 * reach, distance);
  if (nearest < 0)
  {
    return 0.0;
  }
  const Vec3 seed = pyramid.level(0).cells[std::size_t(nearest)].mean;
  double points = 0.0;
  pyramid.visitBall(
    0, seed, scale.countRadius, [&](std::uint32_t, const Cell& cell, double) { points += cell.count; });
  const double spacing = scale.countRadius * std::sqrt(kPi / std::max(1.0, points));
  if (!hasFineShape(global, seed, reach))
  {
    return 0.0;
  }
  // The cell is a whole fraction of the global one, so that scenes of neighbouring places share their cells.
  const double finest = std::max(LocalSceneBuilder::kFinest * coarse, scale.radius / kCellsInFit);
  const double most = std::max(2.0, std::floor(coarse / finest));
  const double parts = std::min(std::floor(coarse / spacing + 0.5), most);
  return parts * kCoarsest >= 1.0 ? coarse / parts : 0.0;
}

/// Lattice from which all scenes with cells of @p cell beside @p global are cut, metres of the workspace. An
/// empty @p workspace: it is about all points.
Lattice latticeOf(const HapticScene& global, const Bounds& workspace, double cell)
{
  Bounds box = workspace;
  if (box.empty())
  {
    box = boxOfCorners(global.bounds(), [&](const Vec3& p) { return global.toWorkspace(p); });
    // Points lie within a voxel of their mean.
    box = grown(box, std::sqrt(3.0) * global.latticeScale() * global.cellSize());
  }
  Lattice lattice;
  for (int axis = 0; axis < 3; ++axis)
  {
    lattice.origin[axis] = box.minimum[axis];
    lattice.spacing[axis] = cell;
    lattice.end[axis] = (box.maximum[axis] - box.minimum[axis]) / cell;
    lattice.dimensions[std::size_t(axis)] = std::int64_t(std::max(1.0, std::ceil(lattice.end[axis])));
  }
  return lattice;
}

/// Origin of a scene about @p hand beside @p global.
std::shared_ptr<SceneOrigin> originOf(const Bounds& hand, const HapticScene& global)
{
  const LatticeSettings& lattice = global.origin()->voxels.lattice;
  auto origin = std::make_shared<SceneOrigin>();
  origin->voxels.lattice.automaticWorkspace = lattice.automaticWorkspace;
  origin->voxels.lattice.workspace = lattice.automaticWorkspace ? Bounds() : lattice.workspace;
  origin->bandwidth = global.origin()->bandwidth;
  origin->modelToWorkspace = global.modelToWorkspace();
  origin->hand = hand;
  origin->globalCloud = global.cloudNumber();
  origin->global = global.origin();
  return origin;
}

} // namespace

void takeVoxels(const VoxelResampler& voxels, const VoxelRequest& request, HapticSceneInput& input)
{
  const std::size_t size = std::size_t(voxels.size());
  const PointView means =
    voxels.floats() ? PointView(voxels.floats(), voxels.size()) : PointView(voxels.doubles(), voxels.size());
  input.points.resize(size);
  for (std::size_t i = 0; i < size; ++i)
  {
    input.points[i] = means[std::int64_t(i)];
  }
  input.counts.assign(voxels.counts(), voxels.counts() + size);
  if (request.covariances)
  {
    input.covariances.assign(voxels.covariances(), voxels.covariances() + size);
  }
  const Vec3& spacing = request.lattice.spacing;
  input.cellSize = std::max({ spacing.x, spacing.y, spacing.z });
  input.corner = request.lattice.origin;
  input.modelToWorkspace = request.transform;
}

bool isFinerNear(const Bounds& hand, const HapticScene& global) noexcept
{
  return !hand.empty() && isFinite(hand.extent()) && cellSizeNear(hand, global) > 0.0;
}

std::shared_ptr<const HapticScene> LocalSceneBuilder::build(
  const Bounds& hand, const std::shared_ptr<const HapticScene>& global, const Executor& executor)
{
  const bool mayBe = index_ && global && global->origin() && !hand.empty() && isFinite(hand.extent());
  const double cell = mayBe ? global->latticeScale() * cellSizeNear(hand, *global) : 0.0;
  if (!(cell > 0.0))
  {
    return nullptr;
  }
  const std::shared_ptr<const SceneOrigin> origin = originOf(hand, *global);
  HapticSceneInput input;
  input.local.emplace();
  input.local->covered = grown(hand, kReach);
  input.local->global = global;
  const Lattice lattice = latticeOf(*global, origin->voxels.lattice.workspace, cell);
  const Lattice part = partOf(lattice, grown(input.local->covered, kMarginCells * cell));
  VoxelRequest request;
  request.lattice = lattice;
  request.part = part;
  request.points = index_->points();
  request.index = index_.get();
  request.transform = global->modelToWorkspace();
  request.covariances = true;
  if (lattice.check() != Status::Ok || part.check() != Status::Ok ||
    resampler_.run(request, executor) != Status::Ok || resampler_.size() == 0)
  {
    return nullptr;
  }
  takeVoxels(resampler_, request, input);
  // Voxels beside the part may lack points.
  const Bounds whole = part.bounds();
  std::replace_if(
    input.points.begin(), input.points.end(), [&](const Vec3& mean) { return !contains(whole, mean); },
    Vec3{ NAN, NAN, NAN });
  input.bandwidth = origin->bandwidth;
  input.origin = origin;
  Status status = Status::Ok;
  return HapticScene::create(std::move(input), status, executor);
}

bool LocalSceneFollower::update(const Bounds& hand, double seconds, const Executor& executor)
{
  const bool moves = seconds > 0.0 && !hand.empty() && !lastHand_.empty();
  const Vec3 velocity = moves ? (hand.center() - lastHand_.center()) / seconds : Vec3();
  lastHand_ = hand;
  // Box of the hand now and after @p later seconds.
  const auto withAhead = [&](double later)
  {
    const double way = later * norm(velocity);
    const double part = way > kMostAhead ? kMostAhead / way : 1.0;
    Bounds box = hand;
    if (moves)
    {
      box.include(hand.center() + (part * later) * velocity);
    }
    return box;
  };
  const Bounds soon = withAhead(kDueAhead);
  const auto inside = [&soon](const Bounds& box)
  { return contains(box, soon.minimum) && contains(box, soon.maximum); };
  if ((local_ && inside(grown(local_->covered(), -LocalSceneBuilder::kNearEnd))) || inside(failed_))
  {
    return false;
  }
  failed_ = Bounds();
  std::shared_ptr<const HapticScene> next = builder_.build(withAhead(kCoveredAhead), global_, executor);
  const bool changes = next || local_;
  if (next)
  {
    ++numberOfScenes_;
    finestCell_ = std::min(finestCell_, next->cellSize());
  }
  else
  {
    failed_ = grown(soon, LocalSceneBuilder::kNearEnd);
  }
  last_ = std::move(local_);
  local_ = std::move(next);
  return changes;
}

const HapticScene* LocalSceneFollower::at(const Vec3& hip, const Vec3& touched, const Executor& executor)
{
  Bounds hand;
  hand.include(hip);
  hand.include(touched);
  update(hand, 0.0, executor);
  return scene().get();
}

} // namespace pointhaptics
