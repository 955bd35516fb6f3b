#include "Haptics/ScenePart.h"

#include "Core/FitRadius.h"
#include "Haptics/HapticScene.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pointhaptics
{
namespace
{

/// Cells of the coarsest level of a pyramid, in index cells.
constexpr double kBlockCells = 1 << (CellPyramid::kCellLevels - 1);
/// How far beyond what is covered there are cells: what the nodes of the fields reach (2.2 voxels of 8 cells
/// each), or a fit at a surface that is watched from a fit radius away; and a little more.
constexpr double kNodeReachCells = 17.6;
constexpr double kSlackCells = 4.0;
/// Longest fit radius that is grown for a node the whole scene does not know.
constexpr double kMostFitCells = 18.0;

} // namespace

std::optional<ScenePart> ScenePart::about(const Bounds& hand, std::shared_ptr<const HapticScene> whole,
  const AffineTransform& modelToLattice, const Lattice& lattice)
{
  Status status = Status::Ok;
  const std::shared_ptr<const HapticScene> moved =
    whole && whole->isAligned() ? whole->moved(modelToLattice, status) : nullptr;
  if (!moved || hand.empty() || !isFinite(hand.extent()))
  {
    return {};
  }
  ScenePart part;
  part.scale_ = moved->latticeScale();
  if (!(part.scale_ <= kMostScale && part.scale_ >= 1.0 / kMostScale))
  {
    return {};
  }
  part.fromWhole_ = modelToLattice * whole->modelToLattice().inverse();
  part.toWhole_ = part.fromWhole_.inverse();
  const double spacing = std::max({ lattice.spacing.x, lattice.spacing.y, lattice.spacing.z });
  part.cellSize_ = whole->hasLatticeCells() ? spacing : part.scale_ * whole->cellSize();
  part.corner_ = lattice.origin;
  const double fit = part.scale_ *
    std::max(whole->typicalScale().radius, whole->fitRadius(part.toWhole_.apply(hand.center())));
  const double margin = std::max(kNodeReachCells * part.cellSize_, 2.0 * fit) + kSlackCells * part.cellSize_;
  part.whole_ = std::move(whole);
  part.voxels_ = lattice;
  const double reach = kReachCells * part.cellSize_;
  const double block = kBlockCells * part.cellSize_;
  for (int axis = 0; axis < 3; ++axis)
  {
    part.covered_.minimum[axis] = hand.minimum[axis] - reach;
    part.covered_.maximum[axis] = hand.maximum[axis] + reach;
    const double dimension = double(lattice.dimensions[std::size_t(axis)]);
    const double blocks = std::ceil(dimension * lattice.spacing[axis] / block);
    const double low = std::floor((part.covered_.minimum[axis] - margin - part.corner_[axis]) / block);
    const double high = std::ceil((part.covered_.maximum[axis] + margin - part.corner_[axis]) / block);
    if (!(low < blocks) || !(high > 0.0))
    {
      return {};
    }
    part.first_[std::size_t(axis)] = std::int64_t(kBlockCells * std::max(0.0, low));
    part.end_[std::size_t(axis)] = std::int64_t(kBlockCells * std::min(blocks, high));
    // A voxel more on either side: blocks need not end where voxels do.
    const double perVoxel = part.cellSize_ / lattice.spacing[axis];
    const double first = std::max(0.0, std::floor(double(part.first_[std::size_t(axis)]) * perVoxel) - 1.0);
    const double end = std::min(dimension, std::ceil(double(part.end_[std::size_t(axis)]) * perVoxel) + 1.0);
    part.voxels_.origin[axis] = lattice.origin[axis] + first * lattice.spacing[axis];
    part.voxels_.dimensions[std::size_t(axis)] = std::int64_t(end - first);
    part.voxels_.end[axis] = lattice.end[axis] - first;
  }
  return part;
}

double ScenePart::share() const
{
  const CellPyramid& pyramid = whole_->pyramid();
  const auto& nodes = pyramid.level(RadiusField::nodeLevel(pyramid)).cells;
  const auto held = std::count_if(nodes.begin(), nodes.end(),
    [this](const Cell& node) { return this->holds(fromWhole_.apply(node.mean)); });
  return double(held) / double(nodes.size());
}

std::vector<LocalScale> ScenePart::scales(const CellPyramid& pyramid) const
{
  const auto& nodes = pyramid.level(RadiusField::nodeLevel(pyramid));
  std::unique_ptr<FitCells> memory;
  std::vector<LocalScale> scales;
  scales.reserve(nodes.cells.size());
  for (const Cell& node : nodes.cells)
  {
    const Vec3 place = toWhole_.apply(node.mean);
    LocalScale scale = scaled(whole_->fitScale(place), scale_);
    scale.noise = scale_ * whole_->noise(place);
    if (!whole_->isNear(place))
    {
      if (!memory)
      {
        memory = std::make_unique<FitCells>();
      }
      double distance = 0.0;
      const std::int64_t seed = pyramid.nearest(0, node.mean, 2.0 * nodes.voxelSize, distance);
      const Vec3 at = seed < 0 ? node.mean : pyramid.level(0).cells[std::size_t(seed)].mean;
      const FitScale fit =
        chooseFitRadius(pyramid, at, kMostFitCells * cellSize_, kMostFitCells * cellSize_, *memory);
      scale.radius = fit.radius;
      scale.countRadius = fit.countRadius;
      scale.noise = fit.noise;
      scale.gate = fitGate(fit.countRadius, fit.noise);
      scale.cubic = fit.cubic ? 1.0 : 0.0;
    }
    const double least = kSmallestFitRadiusInCells * cellSize_;
    scale.radius = std::max(scale.radius, least);
    scale.countRadius = std::max(scale.countRadius, least);
    scales.push_back(scale);
  }
  return scales;
}

bool ScenePart::holds(const Vec3& mean) const noexcept
{
  const Vec3 place = (mean - corner_) / cellSize_; // as CellPyramid counts
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!(place[axis] >= double(first_[std::size_t(axis)]) && place[axis] < double(end_[std::size_t(axis)])))
    {
      return false;
    }
  }
  return true;
}

} // namespace pointhaptics
