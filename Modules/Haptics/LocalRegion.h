/// @file
/// The region of a cloud that a hand can feel before the next scene comes.
#pragma once

#include "Core/Base/AffineTransform.h"
#include "Core/Base/Lattice.h"
#include "Core/Surface/CellPyramid.h"
#include "Core/Surface/FitRadius.h"
#include "Core/Surface/RadiusField.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace pointhaptics
{

class HapticScene;

/// A box about the hand, for a scene of the cells about it. It takes values from the newest global scene, if
/// there is one. In that case: Within covered() forces are those of a scene of the whole cloud
/// (LocalSceneProviderTest: to 1e-13 of the strongest): the cells are the same bit for bit, and there are
/// enough of them for the same radii of fit and proxy at all nodes of the fields that matter there. They may
/// differ by some parts in a thousand where points are sparser than voxels, as the index cells have the size
/// of the last global scene's then, and where a radius is cut for a much smaller one more than 30 cells away.
/// What only the whole cloud knows, such as the radius far from all cells, is as it was. Frame: the lattice
/// of the new scene. Immutable.
class LocalRegion
{
public:
  /// Half-width of covered() about the hand, in index cells: 4 mm in the default workspace.
  static constexpr double kReachCells = 12.0;
  /// The global scene is valid for a new model whose lengths differ by at most this factor, up or down.
  static constexpr double kMostScale = 1.6;

  /// Returns the region about a hand. @param hand box that must be within reach: the HIP and the point of
  /// contact. @param global the newest scene of the whole cloud; its index cells are counted from a corner.
  /// @param modelToLattice of the new scene. @param lattice of the new scene. @return nothing: the global
  /// scene has no corner, its cloud would not keep its shape or nearly its size, or the hand is far from the
  /// workspace.
  static std::optional<LocalRegion> about(const Bounds& hand, std::shared_ptr<const HapticScene> global,
    const AffineTransform& modelToLattice, const Lattice& lattice);

  /// Returns the region where no global scene is made yet. Nodes beside the covered box have fewer votes, so
  /// radii near its end may differ from those of the whole cloud. @return nothing: the hand is far from the
  /// workspace.
  static std::optional<LocalRegion> alone(const Bounds& hand, const Lattice& lattice);

  /// Null: there is none yet.
  const std::shared_ptr<const HapticScene>& globalScene() const { return global_; }
  const Bounds& covered() const { return covered_; }
  double cellSize() const { return cellSize_; }
  /// Lengths of the new scene over those of the global one's lattice frame.
  double scale() const { return scale_; }
  /// True if a cell with this mean belongs to the region: it lies in one of its blocks, which are as large as
  /// the coarsest cells.
  bool holds(const Vec3& mean) const noexcept;
  /// Voxels of @p lattice that hold all means of the region.
  const Lattice& voxels() const { return voxels_; }
  /// Approximate fraction of the global scene's cells that the region holds, 0 to 1. @pre there is a global
  /// scene.
  double fraction() const;
  /// Says for each cell of the field's node level what must be computed there. Cells near the end of the
  /// region lack neighbours, and are too far from the covered box to matter.
  std::vector<NodeUse> uses(const CellPyramid& pyramid) const;
  /// Gives incomplete nodes the values of the global scene, or else typical ones of the other nodes. False:
  /// there is neither.
  bool completeScales(
    const CellPyramid& pyramid, const std::vector<NodeUse>& uses, std::vector<LocalScale>& scales) const;

private:
  bool cut(const Bounds& hand, const Lattice& lattice, double margin);

  std::shared_ptr<const HapticScene> global_;
  AffineTransform toGlobal_; ///< Into the global one's lattice frame.
  AffineTransform fromGlobal_;
  Bounds covered_;
  Lattice voxels_;
  Vec3 corner_;
  double cellSize_ = 0.0;
  double scale_ = 1.0;
  std::array<std::int64_t, 3> first_{}; ///< Index cells of the region's blocks, and an end.
  std::array<std::int64_t, 3> end_{};
};

} // namespace pointhaptics
