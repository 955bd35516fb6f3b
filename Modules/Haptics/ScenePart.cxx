#include "Haptics/ScenePart.h"

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
  const double spacing = std::max({ lattice.spacing.x, lattice.spacing.y, lattice.spacing.z });
  part.cellSize_ = whole->hasLatticeCells() ? spacing : part.scale_ * whole->cellSize();
  part.corner_ = lattice.origin;
  part.whole_ = std::move(whole);
  part.voxels_ = lattice;
  const double reach = kReachCells * part.cellSize_;
  const double block = kBlockCells * part.cellSize_;
  for (int axis = 0; axis < 3; ++axis)
  {
    part.covered_.minimum[axis] = hand.minimum[axis] - reach;
    part.covered_.maximum[axis] = hand.maximum[axis] + reach;
    const double margin = kMarginCells * part.cellSize_;
    const double dimension = double(lattice.dimensions[std::size_t(axis)]);
    const double blocks = std::ceil(dimension * lattice.spacing[axis] / block);
    const double low = std::floor((part.covered_.minimum[axis] - margin - part.corner_[axis]) / block);
    const double high = std::ceil((part.covered_.maximum[axis] + margin - part.corner_[axis]) / block);
    if (!(low < blocks) || !(high > 0.0))
    {
      return {}; // the hand is far from the workspace
    }
    part.first_[std::size_t(axis)] = std::int64_t(kBlockCells * std::max(0.0, low));
    part.end_[std::size_t(axis)] = std::int64_t(kBlockCells * std::min(blocks, high));
    // A voxel more on either side: blocks need not end where voxels do.
    const double perVoxel = part.cellSize_ / lattice.spacing[axis];
    const double first =
      std::max(0.0, std::floor(double(part.first_[std::size_t(axis)]) * perVoxel) - 1.0);
    const double end =
      std::min(dimension, std::ceil(double(part.end_[std::size_t(axis)]) * perVoxel) + 1.0);
    part.voxels_.origin[axis] = lattice.origin[axis] + first * lattice.spacing[axis];
    part.voxels_.dimensions[std::size_t(axis)] = std::int64_t(end - first);
    part.voxels_.end[axis] = lattice.end[axis] - first;
  }
  return part;
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
