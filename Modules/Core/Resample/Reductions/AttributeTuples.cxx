#include "Core/Resample/Reductions/AttributeTuples.h"

#include "Core/Resample/Reductions/VoxelSlices.h"
#include "Core/Resample/Reductions/VoxelTally.h"

#include <algorithm>
#include <utility>

namespace pointhaptics
{
namespace
{

/// Up to so many tuples are sorted by exchanges without branches, which would be unpredictable.
constexpr int kFewTuples = 8;

/// Sorts each component of tuples, from the largest down to that of tuple @p least.
template <typename Key>
void sortFew(Key* keys, std::int64_t tuples, int components, std::int64_t least)
{
  const std::int64_t end = std::max<std::int64_t>(least, 1) * components;
  for (std::int64_t last = (tuples - 1) * components; last >= end; last -= components)
  {
    for (std::int64_t i = 0; i < last; ++i)
    {
      const Key a = keys[i];
      const Key b = keys[i + components];
      const Key less = std::min(a, b);
      keys[i] = less;
      keys[i + components] = Key(a ^ b ^ less); // Of std::max() the compiler would make a branch.
    }
  }
}

/// Of up to so many keys each is compared with each, eight at a time: without branches, which would be
/// unpredictable.
constexpr int kFewKeys = 64;
constexpr int kLanes = 8;

/// Calls @p use(key, number of the keys for which @p counts(other, key)). @pre the keys are followed by the
/// largest one there can be up to the next multiple of kLanes.
template <typename Key, typename Counts, typename Use>
void compareAll(const Key* keys, int count, Counts&& counts, Use&& use)
{
  for (int first = 0; first < count; first += kLanes)
  {
    Key those[kLanes];
    Key numbers[kLanes] = {};
    std::copy_n(keys + first, kLanes, those);
    for (int i = 0; i < count; ++i)
    {
      for (int lane = 0; lane < kLanes; ++lane)
      {
        numbers[lane] = Key(numbers[lane] + Key(counts(keys[i], those[lane])));
      }
    }
    for (int lane = 0; lane < kLanes; ++lane)
    {
      use(those[lane], int(numbers[lane]));
    }
  }
}

/// The lower middle one: of those that are greater more are below.
template <typename Key>
Key medianOfFew(const Key* keys, int count)
{
  Key result = std::numeric_limits<Key>::min();
  compareAll(
    keys, count, [](Key other, Key key) { return other < key; },
    [&](Key key, int below) { result = below <= (count - 1) / 2 ? std::max(result, key) : result; });
  return result;
}

/// As mostFrequent().
template <typename Key>
Key modeOfFew(const Key* keys, int count)
{
  Key result = keys[0];
  int most = 0;
  compareAll(
    keys, count, [](Key other, Key key) { return other == key; },
    [&](Key key, int equal)
    {
      result = equal > most || (equal == most && key < result) ? key : result;
      most = std::max(most, equal);
    });
  return result;
}

/// The key that is there most often, the smallest of several. @pre they are sorted, @p step apart.
template <typename Key>
Key mostFrequent(const Key* keys, std::int64_t count, int step)
{
  Key best = keys[0];
  std::int64_t longest = 0;
  std::int64_t run = 0;
  for (std::int64_t i = 0; i < count; ++i, keys += step)
  {
    run = i > 0 && keys[-step] == keys[0] ? run + 1 : 1;
    best = run > longest ? keys[0] : best;
    longest = std::max(longest, run);
  }
  return best;
}

template <typename Key>
Key statisticOf(AttributeStatistic statistic, std::vector<Key>& keys)
{
  if (keys.size() <= kFewKeys)
  {
    const auto count = int(keys.size());
    keys.resize(keys.size() + kLanes - 1, std::numeric_limits<Key>::max());
    return statistic == AttributeStatistic::Median ? medianOfFew(keys.data(), count)
                                                   : modeOfFew(keys.data(), count);
  }
  const auto at = keys.begin() + std::ptrdiff_t((keys.size() - 1) / 2);
  if (statistic == AttributeStatistic::Median)
  {
    std::nth_element(keys.begin(), at, keys.end());
    return *at;
  }
  if (std::any_of(keys.begin(), keys.end(), [&](Key key) { return key != keys[0]; }))
  {
    std::sort(keys.begin(), keys.end());
  }
  return mostFrequent(keys.data(), std::int64_t(keys.size()), 1);
}

}

void AttributeTuples::makeRoom(std::int64_t tuples)
{
  constexpr std::size_t kWord = sizeof(std::uint64_t);
  const std::size_t bytes = std::size_t(tuples * view_.tupleBytes());
  tuples_.reserve((bytes + kWord - 1) / kWord, Pages::Huge);
}

void AttributeTuples::prepare(const std::int64_t* counts, std::int64_t voxels, std::int64_t, const Executor&)
{
  ends_.assign(counts, counts + voxels);
  makeRoom(simd::countsToPlaces(ends_));
}

void AttributeTuples::add(const std::int64_t* points, const std::int64_t* voxels, int count)
{
  const auto* const first = static_cast<const char*>(view_.values);
  const std::int64_t step = view_.step();
  const auto addAll = [&](auto bytes)
  {
    for (int i = 0; i < count; ++i)
    {
      addTuple(first + step * points[i], std::size_t(bytes), voxels[i]);
    }
  };
  // Without a call for each of the usual tuples.
  const std::int64_t bytes = view_.tupleBytes();
  bytes == 1      ? addAll(std::integral_constant<int, 1>())
    : bytes == 4  ? addAll(std::integral_constant<int, 4>())
    : bytes == 12 ? addAll(std::integral_constant<int, 12>())
                  : addAll(bytes);
}

/// Of voxels @p first to @p last. The components of few tuples go together: how many there are is
/// unpredictable, once.
template <typename T>
void AttributeTuples::writeValues(std::int64_t first, std::int64_t last, T* to) const
{
  using Key = std::conditional_t<sizeof(T) < sizeof(std::int32_t), std::int32_t, decltype(orderedKey(T()))>;
  const bool isMedian = statistic_ == AttributeStatistic::Median;
  std::vector<Key> few(std::size_t(kFewTuples * view_.components));
  std::vector<Key> many;
  to += view_.components * first;
  for (std::int64_t v = first; v < last; ++v, to += view_.components)
  {
    const T* const values = tuple<T>(begin(v));
    const std::int64_t size = end(v) - begin(v);
    const bool areFew = size <= kFewTuples;
    const std::int64_t middle = (size - 1) / 2;
    if (areFew)
    {
      std::transform(values, values + size * view_.components, few.begin(), &orderedKey<T>);
      sortFew(few.data(), size, view_.components, isMedian ? middle : 0);
    }
    for (int c = 0; c < view_.components; ++c)
    {
      many.resize(areFew ? 0 : std::size_t(size));
      for (std::size_t i = 0; i < many.size(); ++i)
      {
        many[i] = orderedKey(values[std::int64_t(i) * view_.components + c]);
      }
      to[c] = valueOfKey<T>(!areFew ? statisticOf(statistic_, many)
          : isMedian                ? few[std::size_t(middle * view_.components + c)]
                                    : mostFrequent(few.data() + c, size, view_.components));
    }
  }
}

template <typename T>
void AttributeTuples::tallyValues(simd::TallyValues& to) const
{
  std::vector<decltype(orderedKey(T()))> keys;
  for (std::int64_t v = 0; v < voxels(); ++v)
  {
    for (int c = 0; c < view_.components; ++c)
    {
      keys.clear();
      for (std::int64_t i = begin(v); i < end(v); ++i)
      {
        keys.push_back(orderedKey(tuple<T>(i)[c]));
      }
      std::sort(keys.begin(), keys.end());
      for (std::size_t i = 0; i < keys.size(); ++i)
      {
        if (i == 0 || keys[i] != keys[i - 1])
        {
          to.values.push_back({ std::int64_t(keys[i]), 0 });
        }
        ++to.values.back().points;
      }
      to.ends.push_back(to.values.size());
    }
  }
}

simd::VoxelTally AttributeTuples::takeTally()
{
  simd::VoxelTally tally;
  tally.values.components = view_.components;
  withType(view_.type, [&](auto example) { tallyValues<decltype(example)>(tally.values); });
  return tally;
}

bool AttributeTuples::write(
  const std::int64_t*, void* values, const Executor& executor, ProgressObserver* observer) const
{
  return simd::forVoxelSlices(ends_, executor, observer,
    [&](std::int64_t first, std::int64_t last)
    {
      withType(view_.type,
        [&](auto example)
        {
          using T = decltype(example);
          writeValues(first, last, static_cast<T*>(values));
        });
    });
}

} // namespace pointhaptics
