#include "Core/Surface/CellPyramid.h"

#include "Core/Base/Lattice.h"
#include "Core/Base/RadixSort.h"

#include <algorithm>
#include <numeric>

namespace pointhaptics
{
namespace
{

/// A cell is mixed when it is thicker than this part of its voxel in its thinnest direction.
constexpr double kMixedThickness = 0.10;
/// A mixed cell may still be one sheet if it is at most this many standard deviations of the noise thick.
constexpr double kNoiseThickness = 2.0;

/// First reach of the search for the nearest cell, in voxels.
constexpr double kFirstReach = 2.0;

/// Spreads the low 21 bits of v to every third bit.
std::uint64_t spread(std::uint64_t v)
{
  v &= 0x1fffff;
  v = (v | v << 32) & 0x1f00000000ffffULL;
  v = (v | v << 16) & 0x1f0000ff0000ffULL;
  v = (v | v << 8) & 0x100f00f00f00f00fULL;
  v = (v | v << 4) & 0x10c30c30c30c30c3ULL;
  v = (v | v << 2) & 0x1249249249249249ULL;
  return v;
}

std::int32_t gather(std::uint64_t v)
{
  v &= 0x1249249249249249ULL;
  v = (v | v >> 2) & 0x10c30c30c30c30c3ULL;
  v = (v | v >> 4) & 0x100f00f00f00f00fULL;
  v = (v | v >> 8) & 0x1f0000ff0000ffULL;
  v = (v | v >> 16) & 0x1f00000000ffffULL;
  v = (v | v >> 32) & 0x1fffff;
  return std::int32_t(v);
}

/// Morton code of the voxel at a position, which is in voxels and not negative.
std::uint64_t mortonCode(const Vec3& place)
{
  return spread(std::uint64_t(place.x)) | spread(std::uint64_t(place.y)) << 1 |
    spread(std::uint64_t(place.z)) << 2;
}

/// Makes the bricks of a level from its sorted, distinct voxel codes.
std::vector<CellPyramid::Brick> makeBricks(const std::vector<std::uint64_t>& codes)
{
  std::vector<CellPyramid::Brick> bricks;
  std::uint64_t current = ~std::uint64_t(0);
  for (std::size_t i = 0; i < codes.size(); ++i)
  {
    const std::uint64_t key = codes[i] >> 6;
    if (bricks.empty() || key != current)
    {
      CellPyramid::Brick brick;
      brick.slot = std::uint32_t(i);
      brick.x = gather(key);
      brick.y = gather(key >> 1);
      brick.z = gather(key >> 2);
      bricks.push_back(brick);
      current = key;
    }
    bricks.back().mask |= std::uint64_t(1) << (codes[i] & 63);
  }
  return bricks;
}

/// Links each brick to the bricks of the level below that lie in it. Both lists are in Morton order.
void linkChildren(std::vector<CellPyramid::Brick>& bricks, const std::vector<CellPyramid::Brick>& below)
{
  std::uint32_t child = 0;
  for (auto& brick : bricks)
  {
    brick.child = child;
    while (child < below.size() && below[child].x >> 1 == brick.x && below[child].y >> 1 == brick.y &&
      below[child].z >> 1 == brick.z)
    {
      ++child;
      ++brick.childCount;
    }
  }
}

/// Merges the cells of @p finer into one for each voxel of twice the size. @p codes are those of the finer
/// voxels, @p count is the number of the larger ones.
std::vector<Cell> mergedByVoxel(
  const CellPyramid::Level& finer, const std::vector<std::uint64_t>& codes, std::size_t count)
{
  std::vector<Cell> cells;
  cells.reserve(count);
  for (std::size_t slot = 0; slot < codes.size(); ++slot)
  {
    bool isFirst = slot == 0 || codes[slot] >> 3 != codes[slot - 1] >> 3;
    for (std::size_t i = finer.slotBegin[slot]; i < finer.slotBegin[slot + 1]; ++i)
    {
      isFirst ? cells.push_back(finer.cells[i]) : void(cells.back() = merged(cells.back(), finer.cells[i]));
      isFirst = false;
    }
  }
  return cells;
}

/// True if the standard deviation of a covariance is above @p limit in every direction. Less limit^2 on the
/// diagonal the covariance is then positive definite, so all pivots are above zero.
bool isThick(const SymMat3& covariance, double limit)
{
  const double variance = limit * limit;
  const double x = covariance.xx - variance;
  if (!(x > 0.0))
  {
    return false;
  }
  const double y = covariance.yy - variance - covariance.xy / x * covariance.xy;
  if (!(y > 0.0))
  {
    return false;
  }
  const double yz = covariance.yz - covariance.xy / x * covariance.xz;
  return covariance.zz - variance - covariance.xz / x * covariance.xz - yz / y * yz > 0.0;
}

}

Cell merged(const Cell& a, const Cell& b) noexcept
{
  Cell cell;
  cell.count = a.count + b.count;
  const double fraction = b.count / cell.count;
  const Vec3 apart = b.mean - a.mean;
  cell.mean = a.mean + fraction * apart;
  SymMat3 fromA = a.covariance;
  fromA *= 1.0 - fraction;
  SymMat3 fromB = b.covariance;
  fromB *= fraction;
  SymMat3 between = outerProduct(apart);
  between *= fraction * (1.0 - fraction);
  cell.covariance = fromA;
  cell.covariance += fromB;
  cell.covariance += between;
  return cell;
}

Status CellPyramid::build(const std::vector<Cell>& cells, double voxelSize, const Vec3* corner)
{
  levels_.clear();
  if (cells.empty())
  {
    return Status::Empty;
  }
  if (!(voxelSize > 0.0) || !std::isfinite(voxelSize))
  {
    return Status::InvalidVoxelSize;
  }
  Bounds box;
  for (const Cell& cell : cells)
  {
    box.include(cell.mean);
  }
  origin_ = corner ? *corner : box.minimum;
  const Vec3 extent = box.maximum - origin_;
  const double longest = std::max({ extent.x, extent.y, extent.z });
  if (!(longest / voxelSize < double(kMaximumLatticeDimension)) || cells.size() > 0xfffffff0u)
  {
    return Status::LatticeNotAddressable;
  }
  const Vec3 above = box.minimum - origin_;
  if (!(above.x >= 0.0 && above.y >= 0.0 && above.z >= 0.0))
  {
    return Status::InvalidParameter;
  }
  std::vector<std::uint64_t> codes;
  levels_.push_back(this->finestLevel(cells, voxelSize, codes));
  buildUpperLevels(codes, corner ? kCellLevels : 1);
  return Status::Ok;
}

CellPyramid::Level CellPyramid::finestLevel(
  const std::vector<Cell>& cells, double voxelSize, std::vector<std::uint64_t>& codes) const
{
  struct Entry
  {
    std::uint64_t code;
    std::uint32_t source;
  };
  std::vector<Entry> entries(cells.size());
  std::vector<Entry> otherEntries(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    entries[i] = { mortonCode((cells[i].mean - origin_) / voxelSize), std::uint32_t(i) };
  }
  radixSort(entries, otherEntries, entries.size(), [](const Entry& entry) { return entry.code; });

  Level finest;
  finest.voxelSize = voxelSize;
  finest.cells.reserve(cells.size());
  for (const Entry& entry : entries)
  {
    if (codes.empty() || codes.back() != entry.code)
    {
      codes.push_back(entry.code);
      finest.slotBegin.push_back(std::uint32_t(finest.cells.size()));
    }
    finest.cells.push_back(cells[entry.source]);
    finest.cells.back().mixed = false;
  }
  finest.slotBegin.push_back(std::uint32_t(finest.cells.size()));
  finest.bricks = makeBricks(codes);
  return finest;
}

void CellPyramid::buildUpperLevels(const std::vector<std::uint64_t>& codes, int leastLevels)
{
  std::vector<std::uint64_t> below = codes;
  while (levels_.back().bricks.size() > 1 || numberOfLevels() < leastLevels)
  {
    const Level& finer = levels_.back();
    Level level;
    level.voxelSize = 2.0 * finer.voxelSize;
    const bool withCells = int(levels_.size()) < kCellLevels;
    std::vector<std::uint64_t> here;
    for (const std::uint64_t code : below)
    {
      here.empty() || here.back() != code >> 3 ? here.push_back(code >> 3) : void();
    }
    if (withCells)
    {
      level.cells = mergedByVoxel(finer, below, here.size());
    }
    level.slotBegin.resize(level.cells.size() + 1); // a voxel has one cell
    std::iota(level.slotBegin.begin(), level.slotBegin.end(), 0u);
    for (Cell& cell : level.cells)
    {
      cell.mixed = isThick(cell.covariance, kMixedThickness * level.voxelSize);
    }
    level.bricks = makeBricks(here);
    linkChildren(level.bricks, finer.bricks);
    below = std::move(here);
    levels_.push_back(std::move(level));
  }
}

void CellPyramid::reclassifyMixedCells(const std::function<double(const Vec3&)>& noiseAt)
{
  for (Level& level : levels_)
  {
    for (Cell& cell : level.cells)
    {
      if (cell.mixed)
      {
        cell.mixed = isThick(cell.covariance, kNoiseThickness * noiseAt(cell.mean));
      }
    }
  }
}

std::int64_t CellPyramid::nearest(
  int level, const Vec3& center, double radius, double& distance) const noexcept
{
  // The balls double in size. The first one that holds a cell holds the nearest.
  for (double reach = std::min(radius, kFirstReach * this->level(level).voxelSize);; reach *= 2.0)
  {
    reach = std::min(reach, radius);
    std::int64_t found = -1;
    double best = reach * reach;
    visitBall(level, center, reach,
      [&](std::uint32_t i, const Cell&, double d2)
      {
        if (d2 < best || (d2 == best && found >= 0 && std::int64_t(i) < found))
        {
          best = d2;
          found = i;
        }
      });
    if (found >= 0 || !(reach < radius))
    {
      distance = std::sqrt(best);
      return found;
    }
  }
}

} // namespace pointhaptics
