#include "Core/RadiusField.h"

#include <algorithm>

namespace pointhaptics
{
namespace
{
constexpr int kNodeLevel = 3;
/// Reach of a node in edges of its voxel.
constexpr double kReachInVoxels = 2.2;
/// |grad| bound between nodes, and how often it is handed on from neighbour to neighbour.
constexpr double kSlope = 0.5;
constexpr int kSlopePasses = 6;
}

int RadiusField::nodeLevel(const CellPyramid& pyramid)
{
  return std::min(kNodeLevel, pyramid.numberOfCellLevels() - 1);
}

void RadiusField::build(const CellPyramid& pyramid, std::vector<LocalScale> values)
{
  level_ = nodeLevel(pyramid);
  values_ = std::move(values);
  const auto& level = pyramid.level(level_);
  reach_ = kReachInVoxels * level.voxelSize;
  for (int pass = 0; pass < kSlopePasses; ++pass)
  {
    bool changed = false;
    for (std::size_t i = 0; i < level.cells.size(); ++i)
    {
      double& value = values_[i].radius;
      pyramid.visitBall(level_, level.cells[i].mean, reach_,
        [&](std::uint32_t j, const Cell&, double d2)
        {
          const double bound = values_[j].radius + kSlope * std::sqrt(d2);
          if (bound < value)
          {
            value = bound;
            changed = true;
          }
        });
    }
    if (!changed)
    {
      break;
    }
  }
  typical_.radius = median([](const LocalScale& v) { return v.radius; });
  typical_.gate = median([](const LocalScale& v) { return v.gate; });
  typical_.countRadius = median([](const LocalScale& v) { return v.countRadius; });
}

template <typename Member>
double RadiusField::median(Member member) const
{
  std::vector<double> sorted(values_.size());
  std::transform(values_.begin(), values_.end(), sorted.begin(), member);
  const auto middle = sorted.begin() + std::ptrdiff_t(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  return *middle;
}

LocalScale RadiusField::at(const CellPyramid& pyramid, const Vec3& position) const noexcept
{
  Vec3 ignored;
  return at(pyramid, position, ignored);
}

LocalScale RadiusField::at(
  const CellPyramid& pyramid, const Vec3& position, Vec3& radiusGradient) const noexcept
{
  double weights = 0.0;
  LocalScale sum;
  Vec3 weightGradient;
  Vec3 sumGradient;
  const double perReach2 = 1.0 / (reach_ * reach_);
  pyramid.visitBall(level_, position, reach_,
    [&](std::uint32_t i, const Cell& node, double d2)
    {
      const double base = 1.0 - d2 * perReach2;
      const double weight = base * base * base;
      const Vec3 gradient = (-6.0 * base * base * perReach2) * (position - node.mean);
      weights += weight;
      weightGradient += gradient;
      sum.radius += weight * values_[i].radius;
      sumGradient += values_[i].radius * gradient;
      sum.gate += weight * values_[i].gate;
      sum.countRadius += weight * values_[i].countRadius;
    });
  radiusGradient = Vec3();
  if (!(weights > 0.0))
  {
    return typical_;
  }
  const double radius = sum.radius / weights;
  radiusGradient = (sumGradient - radius * weightGradient) / weights;
  return { radius, sum.gate / weights, sum.countRadius / weights };
}

} // namespace pointhaptics
