/// @file
/// Part of VoxelKernelBody.h: modes and medians of short lists of values.
#pragma once

#include "Core/Resample/Kernel/OrderedKey.h"
#include "Core/Resample/Kernel/VoxelKernel.h"

namespace pointhaptics::simd
{
namespace
{

/// The keys of as many values as a vector has, in that order of values that orderedKey() gives.
template <typename T, typename Keys>
inline Keys keysAt(const T* from)
{
  using Key = decltype(orderedKey(T()));
  typedef T Values __attribute__((vector_size(kListVector), aligned(sizeof(T)), may_alias));
  Values values = *reinterpret_cast<const Values*>(from);
  if constexpr (std::is_floating_point_v<T>)
  {
    const Keys isNumber = Keys(values == values);
    values += T(0);
    const Keys keys =
      (Keys(values) & isNumber) | (Keys(Values{} + std::numeric_limits<T>::quiet_NaN()) & ~isNumber);
    return keys ^ ((keys >> int(8 * sizeof(Key) - 1)) & std::numeric_limits<Key>::max());
  }
  else
  {
    return std::is_same_v<T, std::uint64_t> ? Keys(values) ^ std::numeric_limits<Key>::lowest()
                                            : Keys(values);
  }
}

/// Each key is compared with each, without branches, which would be unpredictable. The mode is the one that
/// is there most often, the smallest of several; the median the lower middle one: of those that are greater
/// more are below.
template <bool Median, typename T>
void select(const void* list, int count, void* to)
{
  using Key = decltype(orderedKey(T()));
  using Number = std::make_signed_t<Key>;
  const T* const values = static_cast<const T*>(list);
  typedef Key Keys __attribute__((vector_size(kListVector), may_alias));
  typedef Number Numbers __attribute__((vector_size(kListVector)));
  constexpr int kInVector = kListVector / int(sizeof(Key));
  constexpr Key kLargest = std::numeric_limits<Key>::max();
  Numbers lanes;
  for (int i = 0; i < kInVector; ++i)
  {
    lanes[i] = Number(i);
  }
  // Vectors are filled up with the largest key, which changes nothing.
  alignas(kListVector) Key keys[kFewValues];
  for (int first = 0; first < count; first += kInVector)
  {
    const int left = count - first < kInVector ? count - first : kInVector;
    const auto are = Keys(lanes < Number(left));
    *reinterpret_cast<Keys*>(keys + first) = (keysAt<T, Keys>(values + first) & are) | (kLargest & ~are);
  }
  const auto isBetter = [=](const auto& key, const auto& number, const auto& best, const auto& most)
  {
    return Median ? (number <= Number((count - 1) / 2)) & (key > best)
                  : (number > most) | ((number == most) & (key < best));
  };
  Keys best = Keys{} + (Median ? std::numeric_limits<Key>::lowest() : kLargest);
  Numbers most{};
  for (int first = 0; first < count; first += kInVector)
  {
    const Keys those = *reinterpret_cast<const Keys*>(keys + first);
    Numbers numbers{};
    for (int j = 0; j < count; ++j)
    {
      numbers -= Median ? Numbers(keys[j] < those) : Numbers(keys[j] == those);
    }
    const auto better = Numbers(isBetter(those, numbers, best, most));
    best = Keys((Numbers(those) & better) | (Numbers(best) & ~better));
    most = (numbers & better) | (most & ~better);
  }
  Key result = best[0];
  Number number = most[0];
  for (int i = 1; i < kInVector && i < count; ++i)
  {
    const bool better = Median ? best[i] > result : isBetter(Key(best[i]), Number(most[i]), result, number);
    result = better ? best[i] : result;
    number = better ? most[i] : number;
  }
  *static_cast<T*>(to) = valueOfKey<T>(result);
}

template <bool Median>
constexpr SelectKernel kSelect[] = { &select<Median, std::int8_t>, &select<Median, std::uint8_t>,
  &select<Median, std::int16_t>, &select<Median, std::uint16_t>, &select<Median, std::int32_t>,
  &select<Median, std::uint32_t>, &select<Median, std::int64_t>, &select<Median, std::uint64_t>,
  &select<Median, float>, &select<Median, double> };

}
} // namespace pointhaptics::simd
