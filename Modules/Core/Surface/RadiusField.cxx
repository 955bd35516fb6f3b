#include "Core/Surface/RadiusField.h"

#include <algorithm>

namespace pointhaptics
{
namespace
{
constexpr int kNodeLevel = 3;
/// Reach of a node in edges of its voxel.
constexpr double kReachInVoxels = 2.2;
/// Bound of |grad| between nodes, and the number of passes from neighbour to neighbour that enforce it.
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
  const std::vector<Link> links = neighborLinks(pyramid);
  limitSlope(links, &LocalScale::radius);
  limitSlope(links, &LocalScale::proxyRadius);
  for (double LocalScale::*member :
    { &LocalScale::radius, &LocalScale::gate, &LocalScale::countRadius, &LocalScale::proxyRadius })
  {
    typical_.*member = median(member);
  }
}

/// All pairs of nodes within reach, by their first node.
std::vector<RadiusField::Link> RadiusField::neighborLinks(const CellPyramid& pyramid) const
{
  const auto& cells = pyramid.level(level_).cells;
  std::vector<Link> links;
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    pyramid.visitBall(level_, cells[i].mean, reach_,
      [&](std::uint32_t j, const Cell&, double d2) {
        links.push_back({ std::uint32_t(i), j, kSlope * std::sqrt(d2) });
      });
  }
  return links;
}

void RadiusField::limitSlope(const std::vector<Link>& links, double LocalScale::*radius)
{
  bool changed = true;
  for (int pass = 0; pass < kSlopePasses && changed; ++pass)
  {
    changed = false;
    for (const Link& link : links)
    {
      double& value = values_[link.node].*radius;
      const double bound = values_[link.neighbor].*radius + link.rise;
      if (bound < value)
      {
        value = bound;
        changed = true;
      }
    }
  }
}

double RadiusField::median(double LocalScale::*member) const
{
  std::vector<double> sorted(values_.size());
  std::transform(values_.begin(), values_.end(), sorted.begin(),
    [member](const LocalScale& value) { return value.*member; });
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
  simd::FieldSums sums;
  const double perReach2 = 1.0 / (reach_ * reach_);
  pyramid.visitBall(level_, position, reach_,
    [&](std::uint32_t i, const Cell& node, double d2)
    {
      const double base = 1.0 - d2 * perReach2;
      const double weight = base * base * base;
      const Vec3 gradient = (-6.0 * base * base * perReach2) * (position - node.mean);
      sums.weights += weight;
      for (int v = 0; v < simd::kFieldValues; ++v)
      {
        sums.values[v] += weight * (values_[i].*kScaleValues[v]);
      }
      for (int axis = 0; axis < 3; ++axis)
      {
        sums.weightGradient[axis] += gradient[axis];
        sums.radiusGradient[axis] += values_[i].radius * gradient[axis];
      }
    });
  return scaleFrom(sums, radiusGradient);
}

double RadiusField::noiseAt(const CellPyramid& pyramid, const Vec3& position) const noexcept
{
  double distance = 0.0;
  const std::int64_t node = pyramid.nearest(level_, position, reach_, distance);
  return node < 0 ? 0.0 : values_[std::size_t(node)].noise;
}

bool RadiusField::gather(
  const CellPyramid& pyramid, const Vec3& center, double reach, simd::FieldBlock& block) const noexcept
{
  block.center = center;
  block.reach = reach;
  block.size = 0;
  bool fits = true;
  pyramid.visitBall(level_, center, reach,
    [&](std::uint32_t i, const Cell& node, double)
    {
      if (block.size == simd::FieldBlock::kCapacity)
      {
        fits = false;
        return;
      }
      const int at = block.size++;
      const Vec3 place = node.mean - center;
      block.x[at] = place.x;
      block.y[at] = place.y;
      block.z[at] = place.z;
      block.present[at] = 1.0;
      for (int v = 0; v < simd::kFieldValues; ++v)
      {
        block.values[v][at] = values_[i].*kScaleValues[v];
      }
    });
  return fits;
}

LocalScale RadiusField::scaleFrom(const simd::FieldSums& sums, Vec3& radiusGradient) const noexcept
{
  radiusGradient = Vec3();
  if (!(sums.weights > 0.0))
  {
    return typical_;
  }
  const double per = 1.0 / sums.weights;
  LocalScale scale;
  for (int v = 0; v < simd::kFieldValues; ++v)
  {
    scale.*kScaleValues[v] = sums.values[v] * per;
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    radiusGradient[axis] = (sums.radiusGradient[axis] - scale.radius * sums.weightGradient[axis]) * per;
  }
  return scale;
}

} // namespace pointhaptics
