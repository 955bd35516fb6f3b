#include "Core/Surface/FitCells.h"

#include "Core/Base/Boxes.h"

#include <algorithm>

namespace pointhaptics
{
namespace
{

/// Margin of a second try where the usual one overflows the block.
constexpr double kNoMargin = 1.0 + 1e-9;

/// Appends cells of no weight, as the loops take eight at a time.
template <typename Block>
void pad(Block& block) noexcept
{
  for (int i = block.size; i % simd::kFitLanes != 0; ++i)
  {
    block.clear(i);
  }
}

bool serves(const Vec3& gathered, double reach, const Vec3& center, double radius) noexcept
{
  const double left = reach - radius;
  return left >= 0.0 && norm2(center - gathered) <= left * left;
}

}

void FitCells::invalidate() noexcept
{
  pyramid_ = nullptr;
  field_ = nullptr;
  blocks_[0].level = blocks_[1].level = -1;
  nodes_.reach = -1.0;
}

void FitCells::carryOver(const CellPyramid& pyramid, const RadiusField& field, const Bounds& same) noexcept
{
  pyramid_ = &pyramid;
  field_ = &field;
  for (simd::FitBlock& block : blocks_)
  {
    block.level = containsBall(same, block.center, block.reach) ? block.level : -1;
  }
  nodes_.reach = containsBall(same, nodes_.center, nodes_.reach) ? nodes_.reach : -1.0;
}

bool FitCells::gather(
  const CellPyramid& pyramid, int level, const Vec3& center, double reach, simd::FitBlock& block) noexcept
{
  block.level = level;
  block.center = center;
  block.reach = reach;
  block.size = 0;
  bool fits = true;
  if (level == 0)
  {
    // A branch on "inside" would be mispredicted. So each cell is written, and the next one overwrites it if
    // it is outside.
    const Cell* const cells = pyramid.level(0).cells.data();
    pyramid.visitRuns(0, center, reach,
      [&](std::uint32_t first, std::uint32_t last)
      {
        for (std::uint32_t i = first; i < last && fits; ++i)
        {
          const Vec3 place = cells[i].mean - center;
          block.set(block.size, place, cells[i].count, cells[i].covariance);
          block.size += norm2(place) < reach * reach ? 1 : 0;
          fits = block.size <= simd::FitBlock::kCapacity;
        }
        return fits;
      });
    block.size = fits ? block.size : simd::FitBlock::kCapacity;
    pad(block);
    return fits;
  }
  pyramid.visitBallUnmixed(level, center, reach,
    [&](const Cell& cell, double)
    {
      if (block.size == simd::FitBlock::kCapacity)
      {
        fits = false;
        return;
      }
      block.set(block.size++, cell.mean - center, cell.count, cell.covariance);
    });
  pad(block);
  return fits;
}

const simd::FitBlock& FitCells::near(
  const CellPyramid& pyramid, int& level, const Vec3& center, double radius) noexcept
{
  if (pyramid_ != &pyramid)
  {
    invalidate();
    pyramid_ = &pyramid;
  }
  for (const int top = pyramid.numberOfCellLevels() - 1;; ++level)
  {
    simd::FitBlock& block = blocks_[level & 1];
    if (block.level == level && serves(block.center, block.reach, center, radius))
    {
      return block;
    }
    if (gather(pyramid, level, center, margin_ * radius, block) ||
      gather(pyramid, level, center, kNoMargin * radius, block))
    {
      return block;
    }
    overflowed_ = true;
    if (level == top)
    {
      return block;
    }
    block.level = -1;
  }
}

LocalScale FitCells::scaleAt(
  const CellPyramid& pyramid, const RadiusField& field, const Vec3& position, Vec3& radiusGradient) noexcept
{
  if (field_ != &field || pyramid_ != &pyramid ||
    !serves(nodes_.center, nodes_.reach, position, field.reach()))
  {
    if (pyramid_ != &pyramid)
    {
      invalidate();
      pyramid_ = &pyramid;
    }
    field_ = &field;
    if (!field.gather(pyramid, position, margin_ * field.reach(), nodes_))
    {
      nodes_.reach = -1.0;
      return field.at(pyramid, position, radiusGradient);
    }
    pad(nodes_);
  }
  simd::FieldSums sums;
  kernels_->sumField(nodes_, position - nodes_.center, field.reach(), sums);
  return field.scaleFrom(sums, radiusGradient);
}

} // namespace pointhaptics
