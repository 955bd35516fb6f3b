#include "Core/Resample/AttributeTuples.h"

#include "Core/Resample/Stages/VoxelSlices.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

namespace pointhaptics
{
namespace
{

/// One value for those that differ in their bits only: the zeros, the NaNs.
template <typename T>
T canonical(T value)
{
  if constexpr (std::is_floating_point_v<T>)
  {
    return std::isnan(value) ? std::numeric_limits<T>::quiet_NaN() : value + T(0);
  }
  return value;
}

template <typename T>
bool areAllSame(const std::vector<T>& values)
{
  const auto differs = [&](T value)
  { return isLessValue(value, values[0]) || isLessValue(values[0], value); };
  return std::none_of(values.begin(), values.end(), differs);
}

/// The value that is there most often, the smallest of several. Sorts them.
template <typename T>
T mostFrequent(std::vector<T>& values)
{
  if (areAllSame(values))
  {
    return values.front();
  }
  std::sort(values.begin(), values.end(), isLessValue<T>);
  T best = values.front();
  std::size_t longest = 0;
  for (std::size_t i = 0; i < values.size();)
  {
    std::size_t end = i + 1;
    while (end < values.size() && !isLessValue(values[i], values[end]))
    {
      ++end;
    }
    if (end - i > longest)
    {
      longest = end - i;
      best = values[i];
    }
    i = end;
  }
  return best;
}

/// The middle value, of an even number the lower one. Reorders them.
template <typename T>
T middle(std::vector<T>& values)
{
  const auto at = values.begin() + std::ptrdiff_t((values.size() - 1) / 2);
  std::nth_element(values.begin(), at, values.end(), isLessValue<T>);
  return *at;
}

}

void AttributeTuples::makeRoom(std::int64_t tuples)
{
  constexpr std::size_t kWord = sizeof(std::uint64_t);
  const std::size_t bytes = std::size_t(tuples * components_ * bytesOf(type_));
  room_ = tuples;
  tuples_.reserve((bytes + kWord - 1) / kWord, Pages::Huge);
}

void AttributeTuples::prepare(const std::int64_t* counts, std::int64_t voxels)
{
  ends_.assign(counts, counts + voxels);
  makeRoom(simd::countsToPlaces(ends_));
}

void AttributeTuples::add(const void* tuples, std::size_t stride, const std::int64_t* voxels, int count)
{
  withType(type_,
    [&](auto example)
    {
      using T = decltype(example);
      const auto* from = static_cast<const char*>(tuples);
      for (int i = 0; i < count; ++i, from += stride)
      {
        std::copy_n(reinterpret_cast<const T*>(from), components_, tuple<T>(ends_[std::size_t(voxels[i])]++));
      }
    });
}

void AttributeTuples::coarsen(const std::vector<std::int64_t>& parents, std::int64_t voxels)
{
  const Buffer<std::uint64_t> fine = std::move(tuples_);
  const std::vector<std::int64_t> fineEnds = std::move(ends_);
  ends_.assign(std::size_t(voxels), 0);
  std::int64_t begin = 0;
  for (std::size_t v = 0; v < parents.size(); ++v)
  {
    ends_[std::size_t(parents[v])] += fineEnds[v] - std::exchange(begin, fineEnds[v]);
  }
  makeRoom(simd::countsToPlaces(ends_));
  withType(type_,
    [&](auto example)
    {
      using T = decltype(example);
      const T* from = reinterpret_cast<const T*>(fine.data());
      std::int64_t first = 0;
      for (std::size_t v = 0; v < parents.size(); ++v)
      {
        const std::int64_t size = fineEnds[v] - std::exchange(first, fineEnds[v]);
        std::int64_t& end = ends_[std::size_t(parents[v])];
        std::copy_n(from, components_ * size, tuple<T>(end));
        from += components_ * size;
        end += size;
      }
    });
}

/// Of voxels @p first to @p last.
template <typename T>
void AttributeTuples::writeValues(std::int64_t first, std::int64_t last, T* to) const
{
  std::vector<T> values;
  for (std::int64_t v = first; v < last; ++v)
  {
    for (int c = 0; c < components_; ++c)
    {
      values.clear();
      for (std::int64_t i = begin(v); i < end(v); ++i)
      {
        values.push_back(canonical(tuple<T>(i)[c]));
      }
      to[components_ * v + c] = statistic_ == TupleStatistic::Mode ? mostFrequent(values) : middle(values);
    }
  }
}

bool AttributeTuples::write(void* values, const Executor& executor, ProgressObserver* observer) const
{
  return simd::forVoxelSlices(ends_, executor, observer,
    [&](std::int64_t first, std::int64_t last)
    {
      withType(type_,
        [&](auto example)
        {
          using T = decltype(example);
          writeValues(first, last, static_cast<T*>(values));
        });
    });
}

} // namespace pointhaptics
