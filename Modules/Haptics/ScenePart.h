/// @file
/// Which part of a cloud a hand can feel before the next scene comes.
#pragma once

#include "Core/AffineTransform.h"
#include "Core/CellPyramid.h"
#include "Core/Lattice.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

namespace pointhaptics
{

class HapticScene;

/// A box about the hand, and what a scene of the cells in it takes from the newest one of the whole cloud. Within
/// covered() such a scene answers as one of the whole cloud would: the cells it has reach further by what fits
/// and radii look at. Frame: the lattice of the new scene. Immutable.
class ScenePart
{
public:
  /// How far beyond covered() there are cells, in index cells: what the nodes of the radius fields reach (18),
  /// those that vote on their radii (16), and the fits of these.
  static constexpr double kMarginCells = 48.0;
  /// Half-width of covered() about the hand, in index cells: 7 mm in the default workspace.
  static constexpr double kReachCells = 20.0;

  /// @param hand what is to be within reach: the HIP and the point of contact. @param whole the scene of the
  /// whole cloud made last; its index cells are counted from a corner. @param modelToLattice, @p lattice those
  /// of the new scene. Nothing: the whole has no corner, or its cloud would not keep its shape.
  static std::optional<ScenePart> about(const Bounds& hand, std::shared_ptr<const HapticScene> whole,
    const AffineTransform& modelToLattice, const Lattice& lattice);

  const std::shared_ptr<const HapticScene>& whole() const { return whole_; }
  const Bounds& covered() const { return covered_; }
  double cellSize() const { return cellSize_; }
  /// Lengths of the new scene over those of the whole one's lattice frame.
  double scale() const { return scale_; }
  /// Whether a cell with this mean belongs to the part: it lies in one of its blocks, which are as large as the
  /// coarsest cells.
  bool holds(const Vec3& mean) const noexcept;
  /// Voxels of @p lattice that have all means that the part holds.
  const Lattice& voxels() const { return voxels_; }

private:
  std::shared_ptr<const HapticScene> whole_;
  Bounds covered_;
  Lattice voxels_;
  Vec3 corner_;
  double cellSize_ = 0.0;
  double scale_ = 1.0;
  std::array<std::int64_t, 3> first_{}; ///< Index cells of the part's blocks, and an end.
  std::array<std::int64_t, 3> end_{};
};

} // namespace pointhaptics
