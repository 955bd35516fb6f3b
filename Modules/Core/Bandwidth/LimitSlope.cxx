#include "Core/Bandwidth/LocalBandwidth.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace
{

using simd::kBranches;
using simd::kLeafPoints;

/// Radii in spatial order, and the smallest in each box of the tree.
class SlopeLimiter
{
public:
  SlopeLimiter(const NeighborQuery& query, double slope, const std::vector<double>& radii)
    : query_(query)
    , tree_(query.tree())
    , slope_(slope)
    , radii_(query.valuesOfPlaces([&](std::int64_t index) { return radii[std::size_t(index)]; },
        [](double a, double b) { return std::min(a, b); }))
  {
    const std::vector<double>* below = &radii_;
    for (int level = 0; level < tree_.levels; ++level)
    {
      smallest_[level] = smallestOfEach(*below, level == 0 ? kLeafPoints : kBranches);
      below = &smallest_[level];
    }
  }

  double limited(std::int64_t slot) const
  {
    double best = radii_[std::size_t(slot)];
    visitGroup(tree_.levels - 1, 0, query_.point(slot), best);
    return best;
  }

private:
  static std::vector<double> smallestOfEach(const std::vector<double>& values, int together)
  {
    std::vector<double> result;
    for (auto begin = values.begin(); begin != values.end();)
    {
      const auto end = begin + std::min<std::ptrdiff_t>(together, values.end() - begin);
      result.push_back(*std::min_element(begin, end));
      begin = end;
    }
    return result;
  }

  void visitGroup(int level, std::int64_t group, const Vec3& center, double& best) const
  {
    const simd::BoxGroup& boxes = tree_.groups[level][group];
    for (int box = 0; box < simd::boxesOf(tree_, level, group); ++box)
    {
      const std::int64_t child = group * kBranches + box;
      const double smallest = smallest_[level][std::size_t(child)];
      if (smallest + slope_ * std::sqrt(simd::squaredGap(boxes, box, &center.x)) >= best)
      {
        continue;
      }
      level > 0 ? visitGroup(level - 1, child, center, best) : visitLeaf(child, center, best);
    }
  }

  void visitLeaf(std::int64_t leaf, const Vec3& center, double& best) const
  {
    const std::int64_t first = leaf * kLeafPoints;
    const std::int64_t last = std::min(first + kLeafPoints, tree_.size);
    for (std::int64_t slot = first; slot < last; ++slot)
    {
      const double distance = std::sqrt(norm2(query_.point(slot) - center));
      best = std::min(best, radii_[std::size_t(slot)] + slope_ * distance);
    }
  }

  const NeighborQuery& query_;
  const simd::NeighborTree& tree_;
  const double slope_;
  const std::vector<double> radii_;
  std::vector<double> smallest_[simd::kMostLevels];
};

}

void limitSlope(
  const NeighborQuery& query, double slope, std::vector<double>& radii, const Executor& executor)
{
  if (query.size() == 0)
  {
    return;
  }
  const SlopeLimiter limiter(query, slope, radii);
  forEachIndex(executor, query.size(),
    [&](std::int64_t slot) { radii[std::size_t(query.index(slot))] = limiter.limited(slot); });
  query.copyToRepeats(radii);
}

} // namespace pointhaptics
