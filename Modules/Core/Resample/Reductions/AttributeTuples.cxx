#include "Core/Resample/Reductions/AttributeTuples.h"

#include "Core/Resample/Kernel/OrderedKey.h"

#include <algorithm>
#include <cstring>
#include <type_traits>
#include <utility>

namespace pointhaptics
{
namespace
{

/// Statistic of more than simd::kFewValues values.
template <typename Key>
Key statisticOf(AttributeStatistic statistic, std::vector<Key>& keys)
{
  const auto at = keys.begin() + std::ptrdiff_t((keys.size() - 1) / 2);
  if (statistic == AttributeStatistic::Median)
  {
    std::nth_element(keys.begin(), at, keys.end());
    return *at;
  }
  std::sort(keys.begin(), keys.end());
  Key best = keys[0];
  for (auto first = keys.begin(), longest = keys.begin(); first != keys.end();)
  {
    const auto last = std::upper_bound(first, keys.end(), *first);
    if (last - first > longest - keys.begin())
    {
      longest = keys.begin() + (last - first);
      best = *first;
    }
    first = last;
  }
  return best;
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
  // With what kernels read beyond the last value.
  constexpr std::size_t kBeyond = simd::kListVector;
  const std::size_t bytes = std::size_t(tuples * bytesOf(kind_.type)) + kBeyond;
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
  int many[simd::kBatch];
  std::vector<decltype(orderedKey(T()))> keys;
  for (std::int64_t v = 0; v < voxels(); v += simd::kBatch)
  {
    const auto size = int(std::min<std::int64_t>(voxels() - v, simd::kBatch));
    for (int c = 0; c < kind_.components; ++c)
    {
      T* const selected = to + kind_.components * v + c;
      const int found =
        select({ values<T>(c), begin(v), ends_.data() + v, size }, selected, kind_.components, many);
      for (int i = 0; i < found; ++i)
      {
        const std::int64_t voxel = v + many[i];
        keys.resize(std::size_t(end(voxel) - begin(voxel)));
        std::transform(values<T>(c) + begin(voxel), values<T>(c) + end(voxel), keys.begin(), &orderedKey<T>);
        selected[kind_.components * many[i]] = valueOfKey<T>(statisticOf(kind_.statistic, keys));
      }
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
