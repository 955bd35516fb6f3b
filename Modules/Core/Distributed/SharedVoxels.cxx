#include "Core/Distributed/SharedVoxels.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace pointhaptics
{

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

std::vector<std::uint64_t> shareKeys(Ranks& ranks, const std::vector<std::uint64_t>& own)
{
  std::vector<std::uint64_t> ranges = cutsOf(ranks, own, 256);
  ranges.resize(std::size_t(ranks.size()) - 1, 0); // no rank has a voxel
  ranges.insert(ranges.begin(), 0);
  ranges.push_back(std::numeric_limits<std::uint64_t>::max());
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
  std::vector<std::vector<std::int64_t>> answers;
  for (const std::string& message : ranks.exchange(std::move(messages)))
  {
    std::vector<std::int64_t>& answer = answers.emplace_back();
    for (const std::uint64_t key : valuesOfBytes<std::uint64_t>(message))
    {
      const auto found = std::lower_bound(keys.begin(), keys.end(), key);
      answer.push_back(
        found != keys.end() && *found == key ? numbers[std::size_t(found - keys.begin())] : -1);
    }
  }
  return ranks.exchangeValues(answers);
}

/// Memory that is no longer needed is freed at once: the messages need it.
Status shareVoxels(Ranks& ranks, const std::vector<std::uint64_t>& ranges, VoxelAccumulator& voxels)
{
  voxels.releaseScratch();
  const auto rank = std::size_t(ranks.rank());
  std::vector<std::string> messages;
  for (std::size_t r = 0; r + 1 < ranges.size(); ++r)
  {
    messages.push_back(r == rank ? std::string() : voxels.serialize(ranges[r], ranges[r + 1]));
  }
  voxels = voxels.part(ranges[rank], ranges[rank + 1]);
  Status status = Status::Ok;
  messages = ranks.exchange(std::move(messages));
  for (std::size_t r = 0; r < messages.size() && status == Status::Ok; ++r)
  {
    if (r == rank)
    {
      continue;
    }
    VoxelAccumulator part{ Lattice() };
    status = VoxelAccumulator::deserialize(messages[r], part);
    std::string().swap(messages[r]);
    status = status == Status::Ok ? voxels.merge(std::move(part)) : status;
  }
  return ranks.reduce(status, [](Status a, Status b) { return a != Status::Ok ? a : b; });
}

} // namespace pointhaptics
