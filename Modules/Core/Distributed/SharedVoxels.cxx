#include "Core/Distributed/SharedVoxels.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace pointhaptics
{
namespace
{

constexpr std::uint64_t kBeyondAllKeys = std::numeric_limits<std::uint64_t>::max();

}

Bounds commonBounds(Ranks& ranks, const Bounds& own)
{
  return ranks.reduce(own,
    [](Bounds a, const Bounds& b)
    {
      if (!b.empty())
      {
        a.include(b.minimum);
        a.include(b.maximum);
      }
      return a;
    });
}

std::int64_t commonSum(Ranks& ranks, std::int64_t own)
{
  return ranks.reduce(own, [](std::int64_t a, std::int64_t b) { return a + b; });
}

std::int64_t sumBefore(Ranks& ranks, std::int64_t own)
{
  const std::vector<std::int64_t> all = ranks.gatherValues(own);
  return std::accumulate(all.begin(), all.begin() + ranks.rank(), std::int64_t(0));
}

/// Every rank shows each n-th of its voxels, the same n on all, so that a rank's part of the sample is its
/// part of the voxels.
std::vector<std::uint64_t> shareKeys(Ranks& ranks, const std::vector<std::uint64_t>& own)
{
  constexpr std::int64_t kSamplesPerRank = 256;
  const auto size = std::size_t(ranks.size());
  const std::int64_t voxels = commonSum(ranks, std::int64_t(own.size()));
  const auto step = std::size_t(std::max<std::int64_t>(1, voxels / (kSamplesPerRank * std::int64_t(size))));
  std::vector<std::uint64_t> shown;
  for (std::size_t i = 0; i < own.size(); i += step)
  {
    shown.push_back(own[i]);
  }
  std::vector<std::uint64_t> sample;
  for (const std::string& bytes : ranks.gather(bytesOfValues(shown)))
  {
    const auto keys = valuesOfBytes<std::uint64_t>(bytes);
    sample.insert(sample.end(), keys.begin(), keys.end());
  }
  std::sort(sample.begin(), sample.end());
  std::vector<std::uint64_t> ranges(size + 1, 0);
  for (std::size_t r = 1; r < size && !sample.empty(); ++r)
  {
    ranges[r] = sample[sample.size() * r / size];
  }
  ranges.back() = kBeyondAllKeys;
  return ranges;
}

std::vector<std::int64_t> numbersOfKeys(Ranks& ranks, const std::vector<std::uint64_t>& ranges,
  const std::vector<std::uint64_t>& own, const std::vector<std::uint64_t>& keys,
  const std::vector<std::int64_t>& numbers)
{
  std::vector<std::string> messages;
  for (std::size_t r = 0; r + 1 < ranges.size(); ++r)
  {
    messages.push_back(
      bytesOfValues(std::vector<std::uint64_t>(std::lower_bound(own.begin(), own.end(), ranges[r]),
        std::lower_bound(own.begin(), own.end(), ranges[r + 1]))));
  }
  messages = ranks.exchange(std::move(messages));
  for (std::string& message : messages)
  {
    std::vector<std::int64_t> answer;
    for (const std::uint64_t key : valuesOfBytes<std::uint64_t>(message))
    {
      const auto found = std::lower_bound(keys.begin(), keys.end(), key);
      answer.push_back(
        found != keys.end() && *found == key ? numbers[std::size_t(found - keys.begin())] : -1);
    }
    message = bytesOfValues(answer);
  }
  std::vector<std::int64_t> all;
  for (const std::string& message : ranks.exchange(std::move(messages)))
  {
    const auto some = valuesOfBytes<std::int64_t>(message);
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

/// @p messages: the sums that each rank gave to this one; @p kept: those that this one, @p rank, keeps.
Status SharedVoxels::merge(std::vector<std::string> messages, std::size_t rank, VoxelAccumulator kept)
{
  voxels_ = kept.withoutPoints();
  for (std::size_t r = 0; r < messages.size(); ++r)
  {
    VoxelAccumulator part{ Lattice() };
    const Status status = r == rank ? Status::Ok : VoxelAccumulator::deserialize(messages[r], part);
    std::string().swap(messages[r]); // Frees memory for the next sums.
    if (r == rank)
    {
      part = std::move(kept);
    }
    const Status merged = status == Status::Ok ? voxels_.merge(std::move(part)) : status;
    if (merged != Status::Ok)
    {
      return merged;
    }
  }
  return Status::Ok;
}

/// Memory that is no longer needed is freed at once: the messages need it.
Status SharedVoxels::share(Ranks& ranks, VoxelAccumulator own)
{
  own.releaseScratch();
  ranges_ = shareKeys(ranks, own.keys());
  clipped_ = commonSum(ranks, own.clippedPoints());
  invalid_ = commonSum(ranks, own.invalidPoints());
  const auto rank = std::size_t(ranks.rank());
  std::vector<std::string> messages;
  for (std::size_t r = 0; r + 1 < ranges_.size(); ++r)
  {
    messages.push_back(r == rank ? std::string() : own.serialize(ranges_[r], ranges_[r + 1]));
  }
  VoxelAccumulator kept = own.part(ranges_[rank], ranges_[rank + 1]);
  own = VoxelAccumulator(Lattice());
  const Status status = this->merge(ranks.exchange(std::move(messages)), rank, std::move(kept));
  return ranks.reduce(status, [](Status a, Status b) { return a != Status::Ok ? a : b; });
}

} // namespace pointhaptics
