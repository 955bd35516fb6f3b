#include "Core/Resample/Reductions/AttributeTuples.h"

#include "Core/Resample/Kernel/OrderedKey.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>
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

void AttributeTuples::prepare(const std::vector<std::int64_t>& counts)
{
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

/// @p components: those of a tuple, which the compiler may know.
template <typename T, typename Components>
void AttributeTuples::keepTuples(const Tuples& tuples, const std::int64_t* numbers,
  const std::int64_t* voxels, int count, Components components)
{
  // Copies, which no store can change.
  char* const to = values_.data();
  std::int64_t* const ends = ends_.data();
  const std::size_t apart = componentBytes_;
  const Tuples from = tuples;
  for (int i = 0; i < count; ++i)
  {
    const char* const tuple = from.first + from.step * numbers[i];
    char* const first = to + sizeof(T) * std::size_t(ends[voxels[i]]++);
    for (int c = 0; c < components; ++c)
    {
      std::memcpy(first + apart * std::size_t(c), tuple + std::size_t(c) * sizeof(T), sizeof(T));
    }
  }
}

void AttributeTuples::add(
  const Tuples& tuples, const std::int64_t* numbers, const std::int64_t* voxels, int count)
{
  withType(kind_.type,
    [&](auto example)
    {
      using T = decltype(example);
      using One = std::integral_constant<int, 1>;
      using Three = std::integral_constant<int, 3>;
      kind_.components == 1     ? keepTuples<T>(tuples, numbers, voxels, count, One())
        : kind_.components == 3 ? keepTuples<T>(tuples, numbers, voxels, count, Three())
                                : keepTuples<T>(tuples, numbers, voxels, count, kind_.components);
    });
}

template <typename T>
void AttributeTuples::writeValues(T* to) const
{
  const bool isMedian = kind_.statistic == AttributeStatistic::Median;
  const auto select = (isMedian ? kernels_->medians : kernels_->modes)[std::size_t(kind_.type)];
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
}

template <typename T>
void AttributeTuples::tallyValues(simd::TallyValues& to) const
{
  std::vector<decltype(orderedKey(T()))> keys;
  for (std::int64_t v = 0; v < voxels(); ++v)
  {
    for (int c = 0; c < kind_.components; ++c)
    {
      keys.clear();
      for (std::int64_t i = begin(v); i < end(v); ++i)
      {
        keys.push_back(orderedKey(values<T>(c)[i]));
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
  tally.values.components = kind_.components;
  withType(kind_.type, [&](auto example) { tallyValues<decltype(example)>(tally.values); });
  return tally;
}

void AttributeTuples::write(const std::int64_t*, void* values) const
{
  withType(kind_.type,
    [&](auto example)
    {
      using T = decltype(example);
      writeValues(static_cast<T*>(values));
    });
}

} // namespace pointhaptics
