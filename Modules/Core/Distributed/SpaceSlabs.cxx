#include "Core/Distributed/SpaceSlabs.h"

#include "Core/Distributed/SharedVoxels.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace pointhaptics
{
namespace
{

bool comesBefore(const SlabPoint& a, const SlabPoint& b)
{
  return a.index < b.index;
}

int longestAxis(const Bounds& box)
{
  // Halves: the extent may be more than the largest number.
  const Vec3 half = box.empty() ? Vec3() : 0.5 * box.maximum - 0.5 * box.minimum;
  return half.x >= half.y && half.x >= half.z ? 0 : half.y >= half.z ? 1 : 2;
}

}

SpaceSlabs::SpaceSlabs(Ranks& ranks, const PointView& points, const std::vector<double>& counts)
  : ranks_(ranks)
{
  std::int64_t finite = 0;
  for (std::int64_t i = 0; i < points.size(); ++i)
  {
    if (isFinite(points[i]))
    {
      ++finite;
      box_.include(points[i]);
    }
  }
  box_ = commonBounds(ranks, box_);
  pointsOfAll_ = ranks.sum(finite);
  firsts_.push_back(0);
  for (const std::int64_t size : ranks.gatherValues(points.size()))
  {
    firsts_.push_back(firsts_.back() + size);
  }
  axis_ = longestAxis(box_);
  const std::vector<double> cuts = this->chooseCuts(points);
  std::vector<std::vector<SlabPoint>> ofRanks(std::size_t(ranks.size()));
  const std::int64_t first = firsts_[std::size_t(ranks.rank())];
  for (std::int64_t i = 0; i < points.size(); ++i)
  {
    const Vec3 p = points[i];
    if (isFinite(p))
    {
      const auto slab = std::upper_bound(cuts.begin(), cuts.end(), p[axis_]) - cuts.begin();
      ofRanks[std::size_t(slab)].push_back({ p, first + i, counts.empty() ? 1.0 : counts[std::size_t(i)] });
    }
  }
  // By index: each rank has its points in order, and those of the next rank come after them.
  own_ = ranks.exchangeValues(ofRanks);
}

/// Where one slab ends and the next begins. Every rank shows each n-th of its points, the same n on all.
std::vector<double> SpaceSlabs::chooseCuts(const PointView& points)
{
  constexpr std::int64_t kSamplesPerRank = 1024;
  const std::int64_t size = ranks_.size();
  const std::int64_t step = std::max<std::int64_t>(1, firsts_.back() / (kSamplesPerRank * size));
  std::vector<double> sample;
  for (std::int64_t i = 0; i < points.size(); i += step)
  {
    if (isFinite(points[i]))
    {
      sample.push_back(points[i][axis_]);
    }
  }
  std::vector<double> ofAll = ranks_.gatherAll(sample);
  std::sort(ofAll.begin(), ofAll.end());
  std::vector<double> cuts;
  for (std::int64_t r = 1; r < size && !ofAll.empty(); ++r)
  {
    cuts.push_back(ofAll[ofAll.size() * std::size_t(r) / std::size_t(size)]);
  }
  return cuts;
}

std::vector<SlabPoint> SpaceSlabs::withGhosts(const SlabRange& range)
{
  const std::vector<SlabRange> ranges = ranks_.gatherValues(range);
  std::vector<std::vector<SlabPoint>> wanted(ranges.size());
  for (std::size_t r = 0; r < ranges.size(); ++r)
  {
    std::copy_if(own_.begin(), own_.end(), std::back_inserter(wanted[r]),
      [&](const SlabPoint& point)
      { return int(r) != ranks_.rank() && ranges[r].contains(this->coordinate(point)); });
  }
  std::vector<SlabPoint> ghosts = ranks_.exchangeValues(wanted);
  std::sort(ghosts.begin(), ghosts.end(), &comesBefore);
  std::vector<SlabPoint> all(ghosts.size() + own_.size());
  std::merge(ghosts.begin(), ghosts.end(), own_.begin(), own_.end(), all.begin(), &comesBefore);
  return all;
}

std::vector<double> SpaceSlabs::giveBack(const std::vector<double>& values)
{
  struct Placed
  {
    std::int64_t place;
    double value;
  };
  std::vector<std::vector<Placed>> ofRanks(std::size_t(ranks_.size()));
  for (std::size_t i = 0; i < own_.size(); ++i)
  {
    const auto owner = std::upper_bound(firsts_.begin(), firsts_.end(), own_[i].index) - 1;
    ofRanks[std::size_t(owner - firsts_.begin())].push_back({ own_[i].index - *owner, values[i] });
  }
  const auto rank = std::size_t(ranks_.rank());
  std::vector<double> result(std::size_t(firsts_[rank + 1] - firsts_[rank]), 0.0);
  for (const Placed& placed : ranks_.exchangeValues(ofRanks))
  {
    result[std::size_t(placed.place)] = placed.value;
  }
  return result;
}

} // namespace pointhaptics
