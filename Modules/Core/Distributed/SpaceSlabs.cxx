#include "Core/Distributed/SpaceSlabs.h"

#include <algorithm>
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

/// The points of all ranks' messages, one rank after the other.
std::vector<SlabPoint> pointsOf(const std::vector<std::string>& messages)
{
  std::vector<SlabPoint> points;
  for (const std::string& bytes : messages)
  {
    const auto more = valuesOfBytes<SlabPoint>(bytes);
    points.insert(points.end(), more.begin(), more.end());
  }
  return points;
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
  for (const Bounds& box : ranks.gatherValues(box_))
  {
    if (!box.empty())
    {
      box_.include(box.minimum);
      box_.include(box.maximum);
    }
  }
  pointsOfAll_ = ranks.reduce(finite, [](std::int64_t a, std::int64_t b) { return a + b; });
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
      ofRanks[std::size_t(slab)].push_back(
        { p, first + i, counts.empty() ? 1.0 : counts[std::size_t(i)], 0.0 });
    }
  }
  std::vector<std::string> messages;
  for (const std::vector<SlabPoint>& ofRank : ofRanks)
  {
    messages.push_back(bytesOfValues(ofRank));
  }
  // By index: each rank has its points in order, and those of the next rank come after them.
  own_ = pointsOf(ranks.exchange(std::move(messages)));
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
  std::vector<double> ofAll;
  for (const std::string& bytes : ranks_.gather(bytesOfValues(sample)))
  {
    const auto more = valuesOfBytes<double>(bytes);
    ofAll.insert(ofAll.end(), more.begin(), more.end());
  }
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
  std::vector<std::string> messages(ranges.size());
  for (std::size_t r = 0; r < ranges.size(); ++r)
  {
    std::vector<SlabPoint> wanted;
    for (const SlabPoint& point : own_)
    {
      if (int(r) != ranks_.rank() && ranges[r].contains(this->coordinate(point)))
      {
        wanted.push_back(point);
      }
    }
    messages[r] = bytesOfValues(wanted);
  }
  std::vector<SlabPoint> ghosts = pointsOf(ranks_.exchange(std::move(messages)));
  std::sort(ghosts.begin(), ghosts.end(), &comesBefore);
  std::vector<SlabPoint> all(ghosts.size() + own_.size());
  std::merge(ghosts.begin(), ghosts.end(), own_.begin(), own_.end(), all.begin(), &comesBefore);
  return all;
}

std::vector<double> SpaceSlabs::giveBack(const std::vector<double>& values, int width)
{
  const auto ownerOf = [this](std::int64_t index)
  { return std::size_t(std::upper_bound(firsts_.begin(), firsts_.end(), index) - firsts_.begin() - 1); };
  std::vector<std::vector<std::int64_t>> places(std::size_t(ranks_.size()));
  std::vector<std::vector<double>> numbers(places.size());
  for (std::size_t i = 0; i < own_.size(); ++i)
  {
    const std::size_t owner = ownerOf(own_[i].index);
    const auto first = values.begin() + std::ptrdiff_t(i) * width;
    places[owner].push_back(own_[i].index - firsts_[owner]);
    numbers[owner].insert(numbers[owner].end(), first, first + width);
  }
  std::vector<std::string> messages;
  std::vector<std::string> more;
  for (std::size_t r = 0; r < places.size(); ++r)
  {
    messages.push_back(bytesOfValues(places[r]));
    more.push_back(bytesOfValues(numbers[r]));
  }
  messages = ranks_.exchange(std::move(messages));
  more = ranks_.exchange(std::move(more));
  const auto rank = std::size_t(ranks_.rank());
  std::vector<double> result(std::size_t(firsts_[rank + 1] - firsts_[rank]) * std::size_t(width), 0.0);
  for (std::size_t r = 0; r < messages.size(); ++r)
  {
    const auto at = valuesOfBytes<std::int64_t>(messages[r]);
    const auto from = valuesOfBytes<double>(more[r]);
    for (std::size_t i = 0; i < at.size(); ++i)
    {
      std::copy_n(from.begin() + std::ptrdiff_t(i) * width, width, result.begin() + at[i] * width);
    }
  }
  return result;
}

} // namespace pointhaptics
