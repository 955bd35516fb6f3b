#include "Core/Resample/Reductions/AttributeTuples.h"

#include "Core/Resample/Reductions/VoxelSlices.h"
#include "Core/Resample/Reductions/VoxelTally.h"

#include <algorithm>
#include <utility>

namespace pointhaptics
{
namespace
{

/// Of more than simd::kFewValues.
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

void AttributeTuples::prepare(const std::int64_t* counts, std::int64_t voxels, std::int64_t, const Executor&)
{
  ends_.assign(counts, counts + voxels);
  const std::int64_t tuples = simd::countsToPlaces(ends_);
  // With what kernels read beyond the last value.
  constexpr std::size_t kBeyond = simd::kListVector;
  const std::size_t bytes = std::size_t(tuples * bytesOf(view_.type)) + kBeyond;
  componentBytes_ = (bytes + 63) / 64 * 64;
  values_.reserve(componentBytes_ * std::size_t(view_.components), Pages::Huge);
}

void AttributeTuples::addTuples(
  const Tuples& tuples, const std::int64_t* points, const std::int64_t* voxels, int count)
{
  const auto tupleOf = [=](int i) { return tuples.first + tuples.step * points[i]; };
  withType(view_.type,
    [&](auto example)
    {
      using T = decltype(example);
      using One = std::integral_constant<int, 1>;
      using Three = std::integral_constant<int, 3>;
      view_.components == 1     ? keepTuples<T>(voxels, count, One(), tupleOf)
        : view_.components == 3 ? keepTuples<T>(voxels, count, Three(), tupleOf)
                                : keepTuples<T>(voxels, count, view_.components, tupleOf);
    });
}

/// Of voxels @p first to @p last.
template <typename T>
void AttributeTuples::writeValues(std::int64_t first, std::int64_t last, T* to) const
{
  const bool isMedian = statistic_ == AttributeStatistic::Median;
  const auto select = (isMedian ? kernels_->medians : kernels_->modes)[std::size_t(view_.type)];
  int many[simd::kBatch];
  std::vector<decltype(orderedKey(T()))> keys;
  for (std::int64_t v = first; v < last; v += simd::kBatch)
  {
    const auto size = int(std::min<std::int64_t>(last - v, simd::kBatch));
    for (int c = 0; c < view_.components; ++c)
    {
      T* const selected = to + view_.components * v + c;
      const int found =
        select({ values<T>(c), begin(v), ends_.data() + v, size }, selected, view_.components, many);
      for (int i = 0; i < found; ++i)
      {
        const std::int64_t voxel = v + many[i];
        keys.resize(std::size_t(end(voxel) - begin(voxel)));
        std::transform(values<T>(c) + begin(voxel), values<T>(c) + end(voxel), keys.begin(), &orderedKey<T>);
        selected[view_.components * many[i]] = valueOfKey<T>(statisticOf(statistic_, keys));
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
    for (int c = 0; c < view_.components; ++c)
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
