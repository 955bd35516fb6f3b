#include "Core/Resample/Reductions/AttributeTuples.h"

#include "Core/Resample/Kernel/OrderedKey.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

namespace pointhaptics
{
namespace
{

/// The statistic of a list, with memory for the keys of many.
template <typename T, typename Key>
T statisticOfMany(bool isMedian, const T* values, std::int64_t count, std::vector<Key>& keys)
{
  keys.resize(std::size_t(count));
  std::transform(values, values + count, keys.begin(), &orderedKey<T>);
  if (isMedian)
  {
    const auto middle = keys.begin() + (count - 1) / 2;
    std::nth_element(keys.begin(), middle, keys.end());
    return valueOfKey<T>(*middle);
  }
  std::sort(keys.begin(), keys.end());
  Key mode = keys[0];
  std::size_t most = 0;
  for (std::size_t i = 0, equal = 0; i < keys.size(); ++i)
  {
    equal = i > 0 && keys[i] == keys[i - 1] ? equal + 1 : 1;
    mode = equal > most ? keys[i] : mode;
    most = std::max(most, equal);
  }
  return valueOfKey<T>(mode);
}

}

void AttributeTuples::prepare(const AccumulatedArray& kind, const std::vector<std::int64_t>& counts)
{
  kind_ = kind;
  ends_ = counts;
  std::int64_t tuples = 0;
  for (std::int64_t& end : ends_)
  {
    tuples += std::exchange(end, tuples);
  }
  const std::size_t bytes = std::size_t(tuples * bytesOf(kind_.type)) + simd::kListVector;
  componentBytes_ = (bytes + 63) / 64 * 64;
  values_.reserve(componentBytes_ * std::size_t(kind_.components), Pages::Huge);
}

void AttributeTuples::add(
  const simd::Tuples& tuples, const std::int64_t* numbers, const std::int64_t* voxels, int count)
{
  withType(kind_.type,
    [&](auto example)
    {
      using T = decltype(example);
      // Copies, which no store can change.
      char* const to = values_.data();
      std::int64_t* const ends = ends_.data();
      const std::size_t apart = componentBytes_;
      const simd::Tuples from = tuples;
      const auto keep = [=](auto components)
      {
        for (int i = 0; i < count; ++i)
        {
          const char* const tuple = from.first + from.step * numbers[i];
          char* const first = to + sizeof(T) * std::size_t(ends[voxels[i]]++);
          for (std::size_t c = 0; c < components; ++c)
          {
            std::memcpy(first + apart * c, tuple + c * sizeof(T), sizeof(T));
          }
        }
      };
      simd::withWidth(kind_.components, keep);
    });
}

void AttributeTuples::write(const simd::Kernels& kernels, void* all) const
{
  const bool isMedian = kind_.statistic == AttributeStatistic::Median;
  const auto select = (isMedian ? kernels.medians : kernels.modes)[std::size_t(kind_.type)];
  withType(kind_.type,
    [&](auto example)
    {
      using T = decltype(example);
      T* to = static_cast<T*>(all);
      std::vector<decltype(orderedKey(T()))> keys;
      for (std::int64_t v = 0; v < voxels(); ++v)
      {
        const std::int64_t count = end(v) - begin(v);
        for (int c = 0; c < kind_.components; ++c, ++to)
        {
          const T* const list = values<T>(c) + begin(v);
          if (count <= 2) // The smaller one, as mode and as median.
          {
            *to = valueOfKey<T>(std::min(orderedKey(list[0]), orderedKey(list[count - 1])));
            continue;
          }
          count <= simd::kFewValues ? select(list, int(count), to)
                                    : void(*to = statisticOfMany(isMedian, list, count, keys));
        }
      }
    });
}

simd::TallyValues AttributeTuples::tally() const
{
  simd::TallyValues tally;
  tally.components = kind_.components;
  withType(kind_.type,
    [&](auto example)
    {
      using T = decltype(example);
      std::vector<decltype(orderedKey(T()))> keys;
      for (std::int64_t i = 0; i < voxels() * kind_.components; ++i)
      {
        const std::int64_t v = i / kind_.components;
        const T* const list = values<T>(int(i % kind_.components));
        keys.resize(std::size_t(end(v) - begin(v)));
        std::transform(list + begin(v), list + end(v), keys.begin(), &orderedKey<T>);
        std::sort(keys.begin(), keys.end());
        for (std::size_t k = 0; k < keys.size(); ++k)
        {
          if (k == 0 || keys[k] != keys[k - 1])
          {
            tally.values.push_back({ std::int64_t(keys[k]), 0 });
          }
          ++tally.values.back().points;
        }
        tally.ends.push_back(tally.values.size());
      }
    });
  return tally;
}

} // namespace pointhaptics
