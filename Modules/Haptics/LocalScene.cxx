#include "Haptics/LocalScene.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace
{

constexpr double kPi = 3.14159265358979323846;
/// Points beyond what is covered, in cells: the reach of a field's nodes and of their fits.
constexpr double kMarginCells = 24.0;
/// The finer cell is at most this part of the global one, or it is not worth it.
constexpr double kCoarsest = 0.75;

Bounds grown(const Bounds& box, double margin)
{
  const Vec3 by(margin, margin, margin);
  Bounds result = box;
  result.minimum -= by;
  result.maximum += by;
  return result;
}

bool contains(const Bounds& box, const Vec3& p)
{
  return !box.empty() && p.x >= box.minimum.x && p.y >= box.minimum.y && p.z >= box.minimum.z &&
    p.x <= box.maximum.x && p.y <= box.maximum.y && p.z <= box.maximum.z;
}

} // namespace

Status LocalSceneBuilder::setCloud(const PointView& points, const Executor& executor)
{
  const Status status = index_.build(points, executor);
  isIndexed_ = status == Status::Ok;
  return status;
}

/// Edge of the cells near @p place (lattice frame of @p global), metres of that frame; 0: the global ones
/// will do.
double LocalSceneBuilder::cellSize(const Vec3& place, const HapticScene& global) const noexcept
{
  const CellPyramid& pyramid = global.pyramid();
  const double coarse = global.cellSize();
  const LocalScale scale = global.fitScale(place);
  double distance = 0.0;
  const std::int64_t nearest = pyramid.nearest(0, place, 2.0 * kReach / global.latticeScale(), distance);
  if (nearest < 0)
  {
    return 0.0;
  }
  const Vec3 seed = pyramid.level(0).cells[std::size_t(nearest)].mean;
  double points = 0.0;
  pyramid.visitBall(
    0, seed, scale.countRadius, [&](std::uint32_t, const Cell& cell, double) { points += cell.count; });
  const double spacing = scale.countRadius * std::sqrt(kPi / std::max(1.0, points));
  // A whole fraction of the global cell, so that scenes of neighbouring places share their cells.
  const double parts = std::min(std::floor(coarse / spacing + 0.5), 1.0 / kFinest);
  return parts * kCoarsest >= 1.0 ? coarse / parts : 0.0;
}

bool LocalSceneBuilder::isUseful(const Bounds& hand, const HapticScene& global) const noexcept
{
  return isIndexed_ && !hand.empty() && isFinite(hand.extent()) &&
    cellSize(global.toLattice(hand.center()), global) > 0.0;
}

std::shared_ptr<const HapticScene> LocalSceneBuilder::build(
  const Bounds& hand, const std::shared_ptr<const HapticScene>& global, const Executor& executor)
{
  if (!isIndexed_ || !global || hand.empty() || !isFinite(hand.extent()))
  {
    return nullptr;
  }
  const double cell = global->latticeScale() * cellSize(global->toLattice(hand.center()), *global);
  if (!(cell > 0.0))
  {
    return nullptr;
  }
  HapticSceneInput input;
  input.local.emplace();
  input.local->covered = grown(hand, kReach);
  input.local->global = global;
  const Bounds box = grown(input.local->covered, kMarginCells * cell);
  const double block = cell * double(1 << (CellPyramid::kCellLevels - 1));
  VoxelRequest request;
  Lattice& lattice = request.lattice;
  for (int axis = 0; axis < 3; ++axis)
  {
    // Counted from the same place whatever the box, in blocks as large as the coarsest cells.
    const double corner = workspace_.empty() ? 0.0 : workspace_.minimum[axis];
    const double end =
      workspace_.empty() ? box.maximum[axis] : std::min(box.maximum[axis], workspace_.maximum[axis]);
    const double first = std::floor((box.minimum[axis] - corner) / block);
    lattice.origin[axis] = corner + block * (workspace_.empty() ? first : std::max(0.0, first));
    lattice.spacing[axis] = cell;
    lattice.end[axis] = (end - lattice.origin[axis]) / cell;
    lattice.dimensions[std::size_t(axis)] = std::int64_t(std::max(1.0, std::ceil(lattice.end[axis])));
  }
  request.points = index_.points();
  request.index = &index_;
  request.part = lattice;
  request.transform = global->modelToWorkspace();
  request.covariances = true;
  if (lattice.check() != Status::Ok || resampler_.run(request, executor) != Status::Ok ||
    resampler_.size() == 0)
  {
    return nullptr;
  }
  const std::size_t size = std::size_t(resampler_.size());
  input.points.resize(size);
  resampler_.copyMeans(0, &input.points[0].x);
  std::vector<std::int64_t> counts(size);
  resampler_.copyCounts(0, counts.data());
  input.counts.assign(counts.begin(), counts.end());
  input.covariances.resize(size);
  resampler_.copyCovariances(0, input.covariances.data());
  input.bandwidth = bandwidth_;
  input.cellSize = cell;
  input.corner = lattice.origin;
  input.modelToWorkspace = request.transform;
  Status status = Status::Ok;
  return HapticScene::create(std::move(input), status, executor);
}

const HapticScene* LocalSceneFollower::at(const Vec3& hip, const Vec3& touched, const Executor& executor)
{
  Bounds hand;
  hand.include(hip);
  hand.include(touched);
  const auto inside = [&](const Bounds& box)
  { return contains(box, hand.minimum) && contains(box, hand.maximum); };
  const Bounds* covered = local_ ? &local_->covered() : nullptr;
  if (covered && inside(grown(*covered, -LocalSceneBuilder::kNearEnd)))
  {
    return local_.get();
  }
  if (inside(failed_))
  {
    return local_ && inside(*covered) ? local_.get() : global_.get();
  }
  failed_ = Bounds();
  std::shared_ptr<const HapticScene> next = builder_.build(hand, global_, executor);
  if (!next)
  {
    failed_ = grown(hand, LocalSceneBuilder::kNearEnd);
  }
  last_ = std::move(local_);
  local_ = std::move(next);
  return local_ ? local_.get() : global_.get();
}

} // namespace pointhaptics
