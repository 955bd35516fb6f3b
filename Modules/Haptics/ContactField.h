/// @file
/// Distances that the proxy's ball keeps from the points of a cloud: static, found where scenes are built.
#pragma once

#include "Core/Bandwidth/SheetField.h"
#include "Core/Base/Executor.h"
#include "Core/Surface/CellPyramid.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace pointhaptics
{

/// The points that decide about contact, each with the radius by which it keeps the ball away (SheetField.h).
/// Lattice frame, metres. Immutable after build(); any number of threads may read it.
class ContactField
{
public:
  /// @param pyramid must outlive this. @param settings bounds of the radii. @param felt box where the ball
  /// comes: other points get the least radius. Empty: everywhere. @param coarser gives the least radius at a
  /// place, from a field of more of the cloud; null: none.
  void build(const CellPyramid& pyramid, const SheetFieldSettings& settings, const Bounds& felt,
    const Executor& executor, const std::function<double(const Vec3&)>& coarser = nullptr);
  /// Radius at the point nearest to @p place if points there are sparser than index cells; a finer scene
  /// takes that radius. Else 0. @param search longest distance of the point, metres.
  double sparseRadiusAt(const Vec3& place, double search) const;
  /// True if any point near @p box is so sparse.
  bool isSparseNear(const Bounds& box) const;

  const CellPyramid& pyramid() const { return *pyramid_; }
  /// Radius of each cell of @p level; above level 0 the largest of the cells that were merged.
  const std::vector<float>& radii(int level) const { return cells_[std::size_t(level)]; }
  double largest() const { return largest_; }
  double typical() const { return typical_; }

  /// Calls visit(first, last) for runs of cells of @p level, until it returns false. The runs hold all cells
  /// nearer to @p center than their radius plus @p extra, and others near by.
  template <typename Visitor>
  void visitRuns(int level, const Vec3& center, double extra, Visitor&& visit) const
  {
    pyramid_->visitRunsWithin(
      level, center,
      [&](int l, std::uint32_t brick) { return extra + double(bricks_[std::size_t(l)][brick]); },
      std::forward<Visitor>(visit));
  }

private:
  void boundBricks();
  void mergeCells();

  const CellPyramid* pyramid_ = nullptr;
  std::vector<std::vector<float>> cells_;  ///< By level, while the pyramid has cells.
  std::vector<std::vector<float>> bricks_; ///< By level: the largest radius below each brick.
  double largest_ = 0.0;
  double sparse_ = 0.0; ///< Radius from which on points count as sparser than cells.
  double typical_ = 0.0;
};

} // namespace pointhaptics
