/// @file
/// The cloud as cells on several levels of detail: counts, means and covariances, merged exactly from level
/// to level.
#pragma once

#include "Core/Base/PointView.h"
#include "Core/Base/Status.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

namespace pointhaptics
{

/// Points merged into one: their count, mean, and central second moments divided by the count.
struct Cell
{
  Vec3 mean;
  double count = 1.0;
  SymMat3 covariance;
  bool mixed = false; ///< Thick in every direction: two sheets, an edge, or noise. Use its children instead.
};

/// An octree of 4^3-voxel bricks, sorted along the Morton curve: the bricks below a brick are adjacent,
/// so a search goes from the root to the voxels without hashing. Level 0 is the finest; a voxel of level l
/// has the edge 2^l voxelSize(0). Immutable after build(); any number of threads may read it. Memory: about
/// 130 bytes a point.
class CellPyramid
{
public:
  /// Levels above the finest that hold merged cells; a fit never needs coarser ones.
  static constexpr int kCellLevels = 5;

  /// 4 x 4 x 4 voxels of a level, with a bit for each voxel that holds points.
  struct Brick
  {
    std::uint64_t mask = 0;      ///< Bit m: the voxel with Morton index m in the brick holds points.
    std::uint32_t slot = 0;      ///< Slot (occupied voxel) of the lowest set bit; the others follow.
    std::uint32_t child = 0;     ///< First brick of the level below that lies in this one.
    std::uint8_t childCount = 0; ///< Bricks of the level below that lie in this one, 0 on level 0.
    std::int32_t x = 0;          ///< Brick index on each axis, in bricks of this level.
    std::int32_t y = 0;
    std::int32_t z = 0;
  };
  /// The bricks and cells of voxels of one size.
  struct Level
  {
    double voxelSize = 0.0;
    std::vector<Brick> bricks;
    std::vector<Cell> cells;              ///< In slot order; on levels above kCellLevels empty.
    std::vector<std::uint32_t> slotBegin; ///< Cells of slot s are [slotBegin[s], slotBegin[s + 1]).
  };

  /// @param cells finite means. @param voxelSize edge of a level-0 voxel, above 0.
  /// @param corner where given, a place no mean is below on any axis: the voxels of all levels are counted
  /// from there, not from the means' own corner, and all levels with cells are made. Pyramids with the same
  /// corner and voxels are then the same wherever their cells are, block of 2^(kCellLevels - 1) voxels by
  /// block. Errors: Empty, InvalidVoxelSize, LatticeNotAddressable (extent, from the corner, over voxelSize
  /// above 2^21, or over 2^32 cells), InvalidParameter (a mean below the corner).
  Status build(const std::vector<Cell>& cells, double voxelSize, const Vec3* corner = nullptr);

  /// Clears the mixed flag of cells that are no thicker than a single sheet with noise. Call it before other
  /// threads read. @param noiseAt the standard deviation of the points about the surface at a position,
  /// metres; called with the means of mixed cells.
  void reclassifyMixedCells(const std::function<double(const Vec3&)>& noiseAt);

  /// Origin from which voxels are counted.
  const Vec3& corner() const { return origin_; }
  int numberOfLevels() const { return int(levels_.size()); }
  int numberOfCellLevels() const { return numberOfLevels() < kCellLevels ? numberOfLevels() : kCellLevels; }
  const Level& level(int l) const { return levels_[std::size_t(l)]; }

  /// Calls visit(first, last) for runs of cells of @p level in Morton order, until it returns false. The runs
  /// hold all cells whose mean is nearer to @p center than @p radius, and others near by.
  template <typename Visitor>
  void visitRuns(int level, const Vec3& center, double radius, Visitor&& visit) const
  {
    this->visitRunsWithin(
      level, center, [radius](int, std::uint32_t) { return radius; }, visit);
  }

  /// As visitRunsWithin(level, center, radius, visit), with a radius for each brick: @p radius(level, brick)
  /// is at least that of the bricks below it.
  template <typename Radius, typename Visitor>
  void visitRunsWithin(int level, const Vec3& center, const Radius& radius, Visitor&& visit) const
  {
    visitBricks(level, center, radius,
      [&](const Level& l, const Brick& brick)
      {
        const std::uint32_t end = brick.slot + std::uint32_t(__builtin_popcountll(brick.mask));
        return visit(l.slotBegin[brick.slot], l.slotBegin[end]);
      });
  }

  /// Calls visit(cellIndex, cell, squaredDistance) for each cell of @p level whose mean is nearer to @p
  /// center than
  /// @p radius, in Morton order. No allocation. @pre level < numberOfCellLevels()
  template <typename Visitor>
  void visitBall(int level, const Vec3& center, double radius, Visitor&& visit) const
  {
    const std::vector<Cell>& cells = levels_[std::size_t(level)].cells;
    visitRuns(level, center, radius,
      [&](std::uint32_t first, std::uint32_t last)
      {
        for (std::uint32_t i = first; i < last; ++i)
        {
          const double d2 = norm2(cells[i].mean - center);
          if (d2 < radius * radius)
          {
            visit(i, cells[i], d2);
          }
        }
        return true;
      });
  }

  /// True if visit(cell) is true for a cell of @p level whose mean is nearer to @p center than @p radius.
  template <typename Visitor>
  bool anyWithin(int level, const Vec3& center, double radius, Visitor&& visit) const
  {
    const std::vector<Cell>& cells = levels_[std::size_t(level)].cells;
    bool found = false;
    visitRuns(level, center, radius,
      [&](std::uint32_t first, std::uint32_t last)
      {
        found = std::any_of(cells.begin() + first, cells.begin() + last,
          [&](const Cell& cell) { return norm2(cell.mean - center) < radius * radius && visit(cell); });
        return !found;
      });
    return found;
  }

  /// As visitBall, but a mixed cell is replaced by the cells it was merged from, down to level 0. visit(cell,
  /// squaredDistance).
  template <typename Visitor>
  void visitBallUnmixed(int level, const Vec3& center, double radius, Visitor&& visit) const
  {
    visitBricks(
      level, center, [radius](int, std::uint32_t) { return radius; },
      [&](const Level&, const Brick& brick)
      {
        visitUnmixed(level, brick, ~std::uint64_t(0), center, radius * radius, visit);
        return true;
      });
  }

  /// Index of the cell of @p level nearest to @p center within @p radius; -1: none. Ties: the smaller index.
  std::int64_t nearest(int level, const Vec3& center, double radius, double& distance) const noexcept;

private:
  /// Squared distance from a point to a brick's box.
  double squaredDistance(const Level& level, const Brick& brick, const Vec3& p) const noexcept
  {
    const double edge = 4.0 * level.voxelSize;
    const auto gap = [edge](double coordinate, std::int32_t index)
    {
      const double low = edge * double(index);
      const double below = low - coordinate;
      const double above = coordinate - (low + edge);
      const double outside = below > above ? below : above;
      return outside > 0.0 ? outside : 0.0;
    };
    const double x = gap(p.x - origin_.x, brick.x);
    const double y = gap(p.y - origin_.y, brick.y);
    const double z = gap(p.z - origin_.z, brick.z);
    return x * x + y * y + z * z;
  }

  /// Visits bricks until visit(level, brick) returns false.
  template <typename Radius, typename BrickVisitor>
  void visitBricks(int target, const Vec3& center, const Radius& radius, BrickVisitor&& visit) const
  {
    struct Entry
    {
      std::uint32_t brick;
      int level;
    };
    // Rounding of the box's corners must not lose a mean that lies on one.
    const double rounding = 1e-9 * levels_[0].voxelSize;
    Entry stack[8 * kMaximumLevels];
    int size = 0;
    const int top = numberOfLevels() - 1;
    for (std::size_t i = levels_[std::size_t(top)].bricks.size(); i-- > 0;)
    {
      stack[size++] = { std::uint32_t(i), top };
    }
    while (size > 0)
    {
      const Entry entry = stack[--size];
      const Level& l = levels_[std::size_t(entry.level)];
      const Brick& brick = l.bricks[entry.brick];
      const double reach = radius(entry.level, entry.brick) + rounding;
      if (squaredDistance(l, brick, center) > reach * reach)
      {
        continue;
      }
      if (entry.level == target)
      {
        if (!visit(l, brick))
        {
          return;
        }
        continue;
      }
      for (std::uint32_t i = brick.childCount; i-- > 0;)
      {
        stack[size++] = { brick.child + i, entry.level - 1 };
      }
    }
  }

  /// Visits the cells of those voxels of @p brick that are among @p voxels, bits that follow each other; in
  /// the place of a mixed cell the cells it was merged from, which lie in one byte of the mask of a brick
  /// below.
  template <typename Visitor>
  void visitUnmixed(
    int level, const Brick& brick, std::uint64_t voxels, const Vec3& center, double r2, Visitor& visit) const
  {
    const Level& l = levels_[std::size_t(level)];
    const std::uint64_t below = (voxels & (~voxels + 1)) - 1;
    std::uint32_t slot = brick.slot + std::uint32_t(__builtin_popcountll(brick.mask & below));
    for (std::uint64_t bits = brick.mask & voxels; bits != 0; bits &= bits - 1, ++slot)
    {
      const int bit = __builtin_ctzll(bits);
      for (std::uint32_t c = l.slotBegin[slot]; c < l.slotBegin[slot + 1]; ++c)
      {
        const Cell& cell = l.cells[c];
        const double d2 = norm2(cell.mean - center);
        for (std::uint32_t i = 0; cell.mixed && level > 0 && i < brick.childCount; ++i)
        {
          const Brick& child = levels_[std::size_t(level) - 1].bricks[brick.child + i];
          if (((child.x & 1) | (child.y & 1) << 1 | (child.z & 1) << 2) == bit >> 3)
          {
            visitUnmixed(level - 1, child, std::uint64_t(0xff) << 8 * (bit & 7), center, r2, visit);
          }
        }
        if (d2 < r2 && !(cell.mixed && level > 0))
        {
          visit(cell, d2);
        }
      }
    }
  }

  /// The cells in the order of the Morton curve; those of a voxel in the order in which they are given.
  /// @p codes receives the distinct voxels' codes.
  Level finestLevel(
    const std::vector<Cell>& cells, double voxelSize, std::vector<std::uint64_t>& codes) const;
  void buildUpperLevels(const std::vector<std::uint64_t>& codes, int leastLevels);

  static constexpr int kMaximumLevels = 22;
  std::vector<Level> levels_;
  Vec3 origin_;
};

/// Exact merge of two cells: counts, mean and central second moments of the union.
Cell merged(const Cell& a, const Cell& b) noexcept;

} // namespace pointhaptics
