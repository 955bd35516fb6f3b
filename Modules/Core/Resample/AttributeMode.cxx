#include "Core/Resample/AttributeMode.h"

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

/// NaN is a value like others, the largest one.
template <typename T>
bool isLess(T a, T b)
{
  if constexpr (std::is_floating_point_v<T>)
  {
    return std::isnan(b) ? !std::isnan(a) : a < b;
  }
  return a < b;
}

template <typename T>
bool areAllSame(const std::vector<T>& values)
{
  const auto differs = [&](T value) { return isLess(value, values[0]) || isLess(values[0], value); };
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
  std::sort(values.begin(), values.end(), isLess<T>);
  T best = values.front();
  std::size_t longest = 0;
  for (std::size_t i = 0; i < values.size();)
  {
    std::size_t end = i + 1;
    while (end < values.size() && !isLess(values[i], values[end]))
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

/// Numbers of voxels become where their first tuples go. @return the sum of all.
std::int64_t countsToPlaces(std::vector<std::int64_t>& counts)
{
  std::int64_t sum = 0;
  for (std::int64_t& count : counts)
  {
    sum += std::exchange(count, sum);
  }
  return sum;
}

}

void AttributeMode::makeRoom(std::int64_t tuples)
{
  constexpr std::size_t kWord = sizeof(std::uint64_t);
  const std::size_t bytes = std::size_t(tuples * components_ * bytesOf(type_));
  tuples_.reserve((bytes + kWord - 1) / kWord, Pages::Huge);
}

void AttributeMode::prepare(const std::int64_t* counts, std::int64_t voxels)
{
  ends_.assign(counts, counts + voxels);
  makeRoom(countsToPlaces(ends_));
}

void AttributeMode::add(const void* tuples, std::size_t stride, const std::int64_t* voxels, int count)
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

void AttributeMode::coarsen(const std::vector<std::int64_t>& parents, std::int64_t voxels)
{
  const Buffer<std::uint64_t> fine = std::move(tuples_);
  const std::vector<std::int64_t> fineEnds = std::move(ends_);
  ends_.assign(std::size_t(voxels), 0);
  std::int64_t begin = 0;
  for (std::size_t v = 0; v < parents.size(); ++v)
  {
    ends_[std::size_t(parents[v])] += fineEnds[v] - std::exchange(begin, fineEnds[v]);
  }
  makeRoom(countsToPlaces(ends_));
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
void AttributeMode::writeModes(std::int64_t first, std::int64_t last, T* modes) const
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
      modes[components_ * v + c] = mostFrequent(values);
    }
  }
}

bool AttributeMode::write(void* modes, const Executor& executor, ProgressObserver* observer) const
{
  PointProgress progress(observer, ends_.empty() ? 0 : ends_.back(), 1);
  for (std::int64_t first = 0; first < voxels();)
  {
    // Voxels with the points of one report; at least one voxel.
    const std::int64_t points = begin(first);
    const auto last = std::upper_bound(ends_.begin() + first + 1, ends_.end(), points + kPointsPerReport);
    const std::int64_t count = last - ends_.begin() - first;
    forRange(executor, count,
      [&](std::int64_t from, std::int64_t to)
      {
        withType(type_,
          [&](auto example)
          {
            using T = decltype(example);
            writeModes(first + from, first + to, static_cast<T*>(modes));
          });
      });
    first += count;
    if (!progress.add(begin(first) - points))
    {
      return false;
    }
  }
  return true;
}

} // namespace pointhaptics
