#include "Haptics/LocalRegion.h"

#include "Core/Base/Boxes.h"
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
/// Margin of nodes that matter, in cells: their reach (2.2 voxels of 8 cells each), and a fit at a surface
/// that is watched from outside.
constexpr double kNodeCells = 17.6 + 3.0;
/// Reach of a node that has a vote, in cells: from its mean to the cell it looks from, and beyond the last
/// fit.
constexpr double kSeedCells = 4.0;
/// Longest radius that a node may try, over the one it chooses; and at most so many cells.
constexpr double kTriedRadii = 2.0;
constexpr double kMostTriedCells = 20.0;
/// Longest radius in cells where the global scene's radii are not known: that of clouds with little noise.
constexpr double kTriedAlone = 14.0;

} // namespace

std::optional<LocalRegion> LocalRegion::about(const Bounds& hand, std::shared_ptr<const HapticScene> global,
  const AffineTransform& modelToLattice, const Lattice& lattice)
{
  Status status = Status::Ok;
  const std::shared_ptr<const HapticScene> moved =
    global && global->isAligned() ? global->moved(modelToLattice, status) : nullptr;
  if (!moved || hand.empty() || !isFinite(hand.extent()))
  {
    return {};
  }
  LocalRegion region;
  region.scale_ = moved->latticeScale();
  if (!(region.scale_ <= kMostScale && region.scale_ >= 1.0 / kMostScale))
  {
    return {};
  }
  region.fromGlobal_ = modelToLattice * global->modelToLattice().inverse();
  region.toGlobal_ = region.fromGlobal_.inverse();
  const double spacing = std::max({ lattice.spacing.x, lattice.spacing.y, lattice.spacing.z });
  region.cellSize_ = global->hasLatticeCells() ? spacing : region.scale_ * global->cellSize();
  region.corner_ = lattice.origin;
  const double fit = region.scale_ *
    std::max(global->typicalScale().radius, global->fitRadius(region.toGlobal_.apply(hand.center())));
  const double tried =
    std::min(kTriedRadii * fit, kMostTriedCells * region.cellSize_) + kSeedCells * region.cellSize_;
  const double margin = (kNodeCells + kVoteReachInCells) * region.cellSize_ + tried;
  region.global_ = std::move(global);
  return region.cut(hand, lattice, margin) ? std::optional<LocalRegion>(region) : std::nullopt;
}

std::optional<LocalRegion> LocalRegion::alone(const Bounds& hand, const Lattice& lattice)
{
  LocalRegion region;
  region.cellSize_ = std::max({ lattice.spacing.x, lattice.spacing.y, lattice.spacing.z });
  region.corner_ = lattice.origin;
  const double margin = (kNodeCells + kTriedAlone) * region.cellSize_;
  const bool isThere = !hand.empty() && isFinite(hand.extent()) && region.cut(hand, lattice, margin);
  return isThere ? std::optional<LocalRegion>(region) : std::nullopt;
}

/// Finds the covered box, and the blocks and voxels within @p margin of it. False: there are none.
bool LocalRegion::cut(const Bounds& hand, const Lattice& lattice, double margin)
{
  voxels_ = lattice;
  const double reach = kReachCells * cellSize_;
  const double block = kBlockCells * cellSize_;
  for (int axis = 0; axis < 3; ++axis)
  {
    covered_.minimum[axis] = hand.minimum[axis] - reach;
    covered_.maximum[axis] = hand.maximum[axis] + reach;
    const double dimension = double(lattice.dimensions[std::size_t(axis)]);
    const double blocks = std::ceil(dimension * lattice.spacing[axis] / block);
    const double low = std::floor((covered_.minimum[axis] - margin - corner_[axis]) / block);
    const double high = std::ceil((covered_.maximum[axis] + margin - corner_[axis]) / block);
    if (!(low < blocks) || !(high > 0.0))
    {
      return false;
    }
    first_[std::size_t(axis)] = std::int64_t(kBlockCells * std::max(0.0, low));
    end_[std::size_t(axis)] = std::int64_t(kBlockCells * std::min(blocks, high));
    // Blocks need not end where voxels do: one more voxel on either side.
    const double perVoxel = cellSize_ / lattice.spacing[axis];
    const double first = std::max(0.0, std::floor(double(first_[std::size_t(axis)]) * perVoxel) - 1.0);
    const double end = std::min(dimension, std::ceil(double(end_[std::size_t(axis)]) * perVoxel) + 1.0);
    voxels_.origin[axis] = lattice.origin[axis] + first * lattice.spacing[axis];
    voxels_.dimensions[std::size_t(axis)] = std::int64_t(end - first);
    voxels_.end[axis] = lattice.end[axis] - first;
  }
  return true;
}

double LocalRegion::fraction() const
{
  const CellPyramid& pyramid = global_->pyramid();
  const auto& nodes = pyramid.level(RadiusField::nodeLevel(pyramid)).cells;
  const auto held = std::count_if(nodes.begin(), nodes.end(),
    [this](const Cell& node) { return this->holds(fromGlobal_.apply(node.mean)); });
  return double(held) / double(nodes.size());
}

std::vector<NodeUse> LocalRegion::uses(const CellPyramid& pyramid) const
{
  std::vector<NodeUse> uses;
  const Bounds all = grown(covered_, kNodeCells * cellSize_);
  const Bounds voting = grown(covered_, (kNodeCells + kVoteReachInCells) * cellSize_);
  for (const Cell& node : pyramid.level(RadiusField::nodeLevel(pyramid)).cells)
  {
    const bool votes = global_ && contains(voting, node.mean);
    uses.push_back(contains(all, node.mean) ? NodeUse::All : votes ? NodeUse::Vote : NodeUse::None);
  }
  return uses;
}

bool LocalRegion::completeScales(
  const CellPyramid& pyramid, const std::vector<NodeUse>& uses, std::vector<LocalScale>& scales) const
{
  const std::vector<Cell>& nodes = pyramid.level(RadiusField::nodeLevel(pyramid)).cells;
  LocalScale typical;
  if (!global_)
  {
    std::vector<LocalScale> known;
    for (std::size_t i = 0; i < scales.size(); ++i)
    {
      if (uses[i] == NodeUse::All)
      {
        known.push_back(scales[i]);
      }
    }
    if (known.empty())
    {
      return false;
    }
    const auto middle = known.begin() + std::ptrdiff_t(known.size() / 2);
    std::nth_element(known.begin(), middle, known.end(),
      [](const LocalScale& a, const LocalScale& b) { return a.radius < b.radius; });
    typical = *middle;
  }
  for (std::size_t i = 0; i < nodes.size(); ++i)
  {
    if (uses[i] != NodeUse::All && global_)
    {
      const Vec3 place = toGlobal_.apply(nodes[i].mean);
      scales[i] = scaled(global_->fitScale(place), scale_);
      scales[i].noise = scale_ * global_->noise(place);
    }
    else if (uses[i] != NodeUse::All)
    {
      scales[i] = typical;
    }
  }
  return true;
}

bool LocalRegion::holds(const Vec3& mean) const noexcept
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
