/// @file
/// Part of VoxelKernelBody.h: modes and medians of lists of values. Each value is compared with each, in
/// vectors: without branches, which would be unpredictable.
#pragma once

#include "Core/Resample/Kernel/OrderedKey.h"
#include "Core/Resample/Kernel/VoxelKernel.h"

namespace pointhaptics
{
namespace simd
{
namespace
{

/// The vectors of values of a type and of their keys.
template <typename T>
struct ListVectors
{
  using Key = decltype(orderedKey(T()));
  using Sign = std::make_signed_t<Key>;
  static constexpr int kLanes = kListVector / int(sizeof(Key));
  static constexpr Key kLeast = std::numeric_limits<Key>::lowest();
  static constexpr Key kMost = std::numeric_limits<Key>::max();
  typedef T Values __attribute__((vector_size(kListVector), aligned(sizeof(T)), may_alias));
  typedef Key Keys __attribute__((vector_size(kListVector), may_alias));
  typedef Sign Signs __attribute__((vector_size(kListVector), may_alias));

  static Keys all(Key key) { return Keys{} + key; }
  static Signs allSigns(int number) { return Signs{} + Sign(number); }
  /// The larger, or the smaller, lane by lane.
  template <bool Larger, typename Vector>
  static Vector better(const Vector& a, const Vector& b)
  {
    if constexpr (Larger)
    {
      return a > b ? a : b;
    }
    return a < b ? a : b;
  }
  /// The largest, or the smallest, of all lanes: of halves, of halves of them and so on.
  template <bool Largest, typename Vector>
  static auto among(Vector v)
  {
    typedef std::uint64_t Four __attribute__((vector_size(kListVector), may_alias));
    v = better<Largest>(v, Vector(__builtin_shufflevector(Four(v), Four(v), 2, 3, 0, 1)));
    v = better<Largest>(v, Vector(__builtin_shufflevector(Four(v), Four(v), 1, 0, 3, 2)));
    for (int bits = 32; bits >= int(8 * sizeof(Key)); bits /= 2)
    {
      v = better<Largest>(v, Vector((Four(v) >> bits) | (Four(v) << (64 - bits))));
    }
    return v[0];
  }
  /// @p a where bits are set, else @p b.
  static Keys chosen(const Signs& bits, const Keys& a, const Keys& b)
  {
    return (a & Keys(bits)) | (b & Keys(~bits));
  }
  /// All bits in the first lanes, @p count at most.
  static Signs firstLanes(int count)
  {
    Signs lanes;
    for (int lane = 0; lane < kLanes; ++lane)
    {
      lanes[lane] = Sign(lane);
    }
    return lanes < allSigns(count < kLanes ? count : kLanes);
  }
  /// The keys of values, @p count at most; the largest there can be stands for others.
  static Keys load(const T* values, int count)
  {
    Values those = *reinterpret_cast<const Values*>(values);
    Keys keys = Keys(those);
    if constexpr (std::is_floating_point_v<T>)
    {
      // As orderedKey() does.
      const auto isNumber = Signs(those == those);
      those += T(0);
      keys = chosen(isNumber, Keys(those), Keys(Values{} + std::numeric_limits<T>::quiet_NaN()));
      keys ^= (keys >> int(8 * sizeof(Key) - 1)) & all(kMost);
    }
    else if constexpr (std::is_same_v<T, std::uint64_t>)
    {
      keys ^= all(kLeast);
    }
    return chosen(firstLanes(count), keys, all(kMost));
  }
  /// Counts for each of a vector of keys how many of @p count keys are below it, or equal to it.
  template <bool Below>
  static Signs numbers(const Key* keys, int count, const Keys& those)
  {
    Signs numbers{};
    for (int i = 0; i < count; i += kTogether)
    {
      for (int j = i; j < i + kTogether; ++j)
      {
        numbers -= Below ? Signs(all(keys[j]) < those) : Signs(all(keys[j]) == those);
      }
    }
    return numbers;
  }
  static constexpr int kTogether = 4; ///< The ends of short loops are predicted more often.
};

/// The result of so many of the keys of a list.
template <typename T>
struct Selected
{
  typename ListVectors<T>::Key key;
  int number; ///< Number of keys that are equal to it.
};

/// The lower middle one: of those that are greater more are below.
template <typename T>
inline Selected<T> medianAmong(const typename ListVectors<T>::Key* keys, int count, int compared, int first)
{
  using V = ListVectors<T>;
  const auto those = *reinterpret_cast<const typename V::Keys*>(keys + first);
  const auto few =
    typename V::Signs(V::template numbers<true>(keys, compared, those) <= V::allSigns((count - 1) / 2));
  const auto candidates = V::chosen(few, those, V::all(V::kLeast));
  return { V::template among<true>(candidates), 0 };
}

/// The one that is there most often, the smallest of several.
template <typename T>
inline Selected<T> modeAmong(const typename ListVectors<T>::Key* keys, int count, int compared, int first)
{
  using V = ListVectors<T>;
  const auto those = *reinterpret_cast<const typename V::Keys*>(keys + first);
  // Less those that stand for no key.
  const auto others = typename V::Signs(those == V::all(V::kMost)) & V::allSigns(compared - count);
  const auto equal =
    (V::template numbers<false>(keys, compared, those) - others) & V::firstLanes(count - first);
  const auto most = V::template among<true>(equal);
  const auto candidates = V::chosen(typename V::Signs(equal == V::allSigns(most)), those, V::all(V::kMost));
  return { V::template among<false>(candidates), int(most) };
}

template <bool Median, typename T>
inline Selected<T> selectAmong(const typename ListVectors<T>::Key* keys, int count, int compared, int first)
{
  return Median ? medianAmong<T>(keys, count, compared, first) : modeAmong<T>(keys, count, compared, first);
}

/// Selects from a list that takes several vectors. It is a function of its own, as the compiler would keep
/// each of its keys in a vector.
template <bool Median, typename T>
__attribute__((noinline)) auto selectOfSeveral(const T* values, int count)
{
  using V = ListVectors<T>;
  alignas(kListVector) typename V::Key keys[kFewValues];
  int first = 0;
  do
  {
    *reinterpret_cast<typename V::Keys*>(keys + first) = V::load(values + first, count - first);
    first += V::kLanes;
  } while (first < count);
  const int compared = (count + V::kTogether - 1) / V::kTogether * V::kTogether;
  Selected<T> best = selectAmong<Median, T>(keys, count, compared, 0);
  for (first = V::kLanes; first < count; first += V::kLanes)
  {
    const Selected<T> next = selectAmong<Median, T>(keys, count, compared, first);
    const bool isBetter = Median
      ? next.key > best.key
      : next.number > best.number || (next.number == best.number && next.key < best.key);
    best = isBetter ? next : best;
  }
  return best.key;
}

template <typename T, bool Median>
int select(const ValueLists& lists, void* given, int step, int* many)
{
  using V = ListVectors<T>;
  T* to = static_cast<T*>(given);
  std::int64_t begin = lists.begin;
  int found = 0;
  for (int i = 0; i < lists.count; ++i)
  {
    const std::int64_t size = lists.ends[i] - begin;
    const T* const values = static_cast<const T*>(lists.values) + begin;
    begin = lists.ends[i];
    if (__builtin_expect(size > kFewValues, false))
    {
      many[found++] = i;
      continue;
    }
    auto& result = to[std::int64_t(step) * i];
    if (size <= 2)
    {
      // The smaller one, as mode and as median.
      const auto first = orderedKey(values[0]);
      const auto last = orderedKey(values[size > 1]);
      result = valueOfKey<T>(first < last ? first : last);
      continue;
    }
    if (size > V::kLanes)
    {
      result = valueOfKey<T>(selectOfSeveral<Median>(values, int(size)));
      continue;
    }
    alignas(kListVector) typename V::Key keys[V::kLanes];
    *reinterpret_cast<typename V::Keys*>(keys) = V::load(values, int(size));
    const int compared = (int(size) + V::kTogether - 1) / V::kTogether * V::kTogether;
    result = valueOfKey<T>(selectAmong<Median, T>(keys, int(size), compared, 0).key);
  }
  return found;
}

constexpr SelectKernels kSelectKernels = {
  { &select<std::int8_t, false>, &select<std::uint8_t, false>, &select<std::int16_t, false>,
    &select<std::uint16_t, false>, &select<std::int32_t, false>, &select<std::uint32_t, false>,
    &select<std::int64_t, false>, &select<std::uint64_t, false>, &select<float, false>,
    &select<double, false> },
  { &select<std::int8_t, true>, &select<std::uint8_t, true>, &select<std::int16_t, true>,
    &select<std::uint16_t, true>, &select<std::int32_t, true>, &select<std::uint32_t, true>,
    &select<std::int64_t, true>, &select<std::uint64_t, true>, &select<float, true>, &select<double, true> }
};

}
} // namespace simd
} // namespace pointhaptics
