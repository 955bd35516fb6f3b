#include "Core/Resample/Stages/VoxelTally.h"

#include "Core/Resample/Kernel/OrderedKey.h"
#include "Core/Resample/Stages/AttributeRounding.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace pointhaptics
{
namespace simd
{
bool addShifted(const std::uint64_t* number, int count, int shift, int sign, std::uint64_t* sum, int size)
{
  const int whole = (shift - (shift < 0 ? 63 : 0)) / 64;
  const int bits = shift - 64 * whole;
  const auto word = [=](int i) {
    return i < 0 ? 0 : i < count ? number[i] : std::uint64_t(std::int64_t(number[count - 1]) >> 63);
  };
  UInt128 carry = sign < 0;
  std::uint64_t before = 0;
  std::uint64_t more = 0;
  for (int i = 0; i < size; ++i)
  {
    more = word(i - whole) << bits | (bits > 0 ? word(i - whole - 1) >> (64 - bits) : 0);
    more = sign < 0 ? ~more : more;
    before = sum[i];
    carry += UInt128(before) + more;
    sum[i] = std::uint64_t(carry);
    carry >>= 64;
  }
  // Both have a sign that the result has not.
  return ((before ^ sum[size - 1]) & (more ^ sum[size - 1])) >> 63 == 0;
}

void TallySums::fit(int newUnit, int newWords)
{
  if (newUnit == unit && newWords == words)
  {
    return;
  }
  PageVector<std::uint64_t> moved(size * std::size_t(newWords), 0);
  for (std::size_t sum = 0; sum < size; ++sum)
  {
    static_cast<void>(
      addShifted(at(sum), words, unit - newUnit, 1, moved.data() + sum * std::size_t(newWords), newWords));
  }
  values = std::move(moved);
  unit = newUnit;
  words = newWords;
}

/// Takes a unit and as many words as the sums of another need, too.
void TallySums::cover(const TallySums& other)
{
  if (size == 0)
  {
    unit = other.unit;
    words = other.words;
  }
  else if (other.size > 0 && (other.unit != unit || other.words > words))
  {
    const int least = std::min(unit, other.unit);
    const auto needed = [=](const TallySums& sums) { return sums.words + (sums.unit - least + 63) / 64; };
    fit(least, std::max(needed(*this), needed(other)));
  }
}

void TallySums::append(const TallySums& from, std::size_t begin, std::size_t end)
{
  cover(from);
  const std::size_t before = size;
  size += end - begin;
  values.resize(size * std::size_t(words), 0);
  const bool isLike = from.unit == unit && from.words == words;
  if (isLike)
  {
    std::copy(from.at(begin), from.at(end), at(before));
  }
  for (std::size_t sum = begin; !isLike && sum < end; ++sum)
  {
    static_cast<void>(
      addShifted(from.at(sum), from.words, from.unit - unit, 1, at(before + sum - begin), words));
  }
  nonFinite.resize(nonFinite.empty() && from.nonFinite.empty() ? 0 : size);
  if (!from.nonFinite.empty())
  {
    std::copy(from.nonFinite.begin() + std::ptrdiff_t(begin), from.nonFinite.begin() + std::ptrdiff_t(end),
      nonFinite.begin() + std::ptrdiff_t(before));
  }
}

/// Adds @p sign times the @p other sum of @p from, which this covers. @return false where that leaves fewer
/// than no numbers that are not finite.
inline bool TallySums::add(std::size_t sum, const TallySums& from, std::size_t other, int sign)
{
  std::int64_t result; // Mostly words are added.
  const auto isWord = [&](std::int64_t own, std::int64_t more)
  {
    return sign > 0 ? !__builtin_add_overflow(own, more, &result)
                    : !__builtin_sub_overflow(own, more, &result);
  };
  if (words == 1 && from.unit == unit && isWord(std::int64_t(*at(sum)), std::int64_t(*from.at(other))))
  {
    *at(sum) = std::uint64_t(result);
  }
  else
  {
    const std::uint64_t top = at(sum)[words - 1];
    if (!addShifted(from.at(other), from.words, from.unit - unit, sign, at(sum), words))
    {
      fit(unit, words + 1);
      at(sum)[words - 1] = std::uint64_t(std::int64_t(top) >> 63);
    }
  }
  if (from.nonFinite.empty())
  {
    return true;
  }
  NonFiniteCount& seen = nonFinite[sum];
  const NonFiniteCount& more = from.nonFinite[other];
  seen = { seen.nans + sign * more.nans, seen.plus + sign * more.plus, seen.minus + sign * more.minus };
  return seen.nans >= 0 && seen.plus >= 0 && seen.minus >= 0;
}

TallySums TallySums::gathered(
  const TallySums* first, const TallySums* second, const VoxelGroups& groups, bool& isRight)
{
  const TallySums* const runs[2] = { first, second };
  TallySums gathered;
  bool areFinite = true;
  for (const TallySums* run : runs)
  {
    if (run && run->size > 0)
    {
      gathered.components = run->components;
      gathered.cover(*run);
      gathered.size = 1; // One of 0, for both to be covered.
      gathered.values.assign(std::size_t(gathered.words), 0);
      areFinite = areFinite && run->nonFinite.empty();
    }
  }
  const auto width = std::size_t(gathered.components);
  gathered.size = groups.ends.size() * width;
  gathered.values.assign(gathered.size * std::size_t(gathered.words), 0);
  gathered.nonFinite.resize(areFinite ? 0 : gathered.size);
  groups.forAll(
    [&](std::size_t group, const VoxelGroups::Voxel& voxel, int sign)
    {
      for (std::size_t c = 0; c < width; ++c)
      {
        isRight =
          gathered.add(group * width + c, *runs[voxel.run], voxel.number * width + c, sign) && isRight;
      }
    });
  return gathered;
}

double TallySums::mean(std::size_t sum, std::int64_t count) const
{
  if (!nonFinite.empty() && nonFinite[sum].any())
  {
    const NonFiniteCount& seen = nonFinite[sum];
    if (seen.plus > 0 || seen.minus > 0 || seen.nans >= count)
    {
      return meanWithNonFinite(seen);
    }
    count -= seen.nans;
  }
  const std::uint64_t* const number = at(sum);
  int top = words - 1;
  while (top > 1 && number[top] == std::uint64_t(std::int64_t(number[top - 1]) >> 63))
  {
    --top;
  }
  if (top == 0)
  {
    return scaledMean(double(std::int64_t(number[0])), unit, count);
  }
  // Two words have more bits than a double: of those below it is enough whether all are 0.
  const bool isExact = std::all_of(number, number + top - 1, [](std::uint64_t word) { return word == 0; });
  const auto whole = Int128(UInt128(number[top]) << 64 | number[top - 1] | std::uint64_t(!isExact));
  return scaledMean(toDouble(whole), unit + 64 * (top - 1), count);
}

Int128 TallySums::inUnits(std::size_t sum) const
{
  const std::uint64_t* const number = at(sum);
  return words == 1 ? Int128(std::int64_t(number[0])) : Int128(UInt128(number[1]) << 64 | number[0]);
}

void TallySums::write(const AccumulatedArray& kind, std::size_t first, std::size_t last,
  const std::int64_t* counts, const std::array<Vec3, 3>& columns, void* tuples) const
{
  const bool turns = kind.statistic == AttributeStatistic::Normal;
  withType(kind.type,
    [&](auto example)
    {
      using T = decltype(example);
      const auto writeAll = [&](const auto& meanOf, const auto& integerOf)
      {
        T* to = static_cast<T*>(tuples);
        std::size_t sum = first * std::size_t(components);
        for (std::size_t v = first; v < last; ++v, to += components, sum += std::size_t(components))
        {
          const std::int64_t count = counts[v - first];
          writeMeans(
            components, count, turns ? &columns : nullptr, to,
            [&](int c) { return meanOf(sum + std::size_t(c), count); },
            [&](int c) { return integerOf(sum + std::size_t(c)); });
        }
      };
      // Most sums are one word.
      const std::uint64_t* const word = values.data();
      const int wordUnit = unit;
      using Integer = std::conditional_t<sizeof(T) == 8, Int128, std::int64_t>;
      if (words == 1 && nonFinite.empty() && (std::is_floating_point_v<T> || unit == 0))
      {
        writeAll([=](std::size_t sum, std::int64_t count)
          { return scaledMean(double(std::int64_t(word[sum])), wordUnit, count); },
          [=](std::size_t sum) { return Integer(std::int64_t(word[sum])); });
        return;
      }
      writeAll([&](std::size_t sum, std::int64_t count) { return mean(sum, count); },
        [&](std::size_t sum) { return inUnits(sum) * (Int128(1) << unit); });
    });
}

void TallySums::trim()
{
  int low = 64 * words; // Bits in use, but the sign.
  int high = 0;
  for (std::size_t sum = 0; sum < size; ++sum)
  {
    const std::uint64_t* const number = at(sum);
    const auto sign = std::uint64_t(std::int64_t(number[words - 1]) >> 63);
    for (int i = 0; i < words; ++i)
    {
      low = number[i] != 0 ? std::min(low, 64 * i + __builtin_ctzll(number[i])) : low;
      high = number[i] != sign ? std::max(high, 64 * (i + 1) - __builtin_clzll(number[i] ^ sign)) : high;
    }
  }
  low < 64 * words ? fit(unit + low, (high - low) / 64 + 1) : fit(0, 1);
  values.shrink_to_fit();
  if (std::none_of(nonFinite.begin(), nonFinite.end(), [](const NonFiniteCount& seen) { return seen.any(); }))
  {
    nonFinite.clear();
  }
  nonFinite.shrink_to_fit();
}

std::int64_t TallyValues::List::mostFrequent() const
{
  return std::max_element(
    first, last, [](const TallyValue& a, const TallyValue& b) { return a.points < b.points; })
    ->key;
}

std::int64_t TallyValues::List::middle(std::int64_t count) const
{
  std::int64_t left = (count - 1) / 2;
  const TallyValue* value = first;
  for (; left >= value->points; ++value)
  {
    left -= value->points;
  }
  return value->key;
}

void TallyValues::append(const TallyValues& from, std::size_t begin, std::size_t end)
{
  const auto source = from.values.begin();
  const std::size_t start = from.beginOf(begin);
  const std::size_t before = values.size();
  values.insert(values.end(), source + std::ptrdiff_t(start), source + std::ptrdiff_t(from.beginOf(end)));
  for (std::size_t list = begin; list < end; ++list)
  {
    ends.push_back(before + from.ends[list] - start);
  }
}

TallyValues TallyValues::gathered(
  const TallyValues* first, const TallyValues* second, const VoxelGroups& groups, bool& isRight)
{
  const TallyValues* const runs[2] = { first, second };
  TallyValues gathered;
  for (const TallyValues* run : runs)
  {
    gathered.components = run && !run->ends.empty() ? run->components : gathered.components;
  }
  const auto width = std::size_t(gathered.components);
  std::vector<TallyValue> all;
  std::vector<TallyValue> both;
  for (std::size_t list = 0; list < groups.ends.size() * width; ++list)
  {
    all.clear();
    const std::size_t group = list / width;
    for (std::size_t i = group == 0 ? 0 : groups.ends[group - 1]; i < groups.ends[group]; ++i)
    {
      const VoxelGroups::Voxel& voxel = groups.voxels[i];
      const List more = (*runs[voxel.run])[voxel.number * width + list % width];
      both.resize(all.size() + std::size_t(more.last - more.first));
      const auto end = std::copy(all.begin(), all.end(), both.begin());
      std::transform(more.begin(), more.end(), end,
        [&](const TallyValue& value) {
          return TallyValue{ value.key, voxel.run == 0 ? value.points : groups.sign * value.points };
        });
      std::inplace_merge(both.begin(), end, both.end(),
        [](const TallyValue& a, const TallyValue& b) { return a.key < b.key; });
      all.swap(both);
    }
    for (std::size_t i = 0; i < all.size();)
    {
      TallyValue value = all[i++];
      for (; i < all.size() && all[i].key == value.key; ++i)
      {
        value.points += all[i].points;
      }
      isRight = isRight && value.points >= 0;
      gathered.values.insert(gathered.values.end(), value.points != 0, value);
    }
    gathered.ends.push_back(gathered.values.size());
  }
  return gathered;
}

void VoxelTally::append(const VoxelTally& from, std::size_t first, std::size_t last)
{
  sums.components = from.sums.components;
  values.components = from.values.components;
  const auto ofSums = std::size_t(sums.components);
  const auto ofValues = std::size_t(values.components);
  sums.append(from.sums, first * ofSums, last * ofSums);
  values.append(from.values, first * ofValues, last * ofValues);
}

VoxelTally VoxelTally::gathered(
  const VoxelTally* first, const VoxelTally* second, const VoxelGroups& groups, bool& isRight)
{
  return { TallySums::gathered(
             first ? &first->sums : nullptr, second ? &second->sums : nullptr, groups, isRight),
    TallyValues::gathered(
      first ? &first->values : nullptr, second ? &second->values : nullptr, groups, isRight) };
}

namespace
{

bool isOf(const NonFiniteCount& seen, std::int64_t count)
{
  return seen.nans >= 0 && seen.plus >= 0 && seen.minus >= 0 && seen.nans <= count &&
    seen.plus <= count - seen.nans && seen.minus <= count - seen.nans - seen.plus;
}

/// True if @p count integers can have the sum.
template <typename T>
bool isSumOf(const TallySums& sums, std::size_t sum, std::int64_t count)
{
  constexpr int kMostBits = 34 + 64; // Bits of the count and of each integer.
  if (std::is_floating_point_v<T>)
  {
    return true;
  }
  if (sums.unit < 0 || sums.unit > kMostBits || sums.words > 2)
  {
    return false;
  }
  const Int128 units = sums.inUnits(sum);
  const Int128 least = Int128(std::numeric_limits<T>::lowest()) * count;
  const Int128 most = Int128(std::numeric_limits<T>::max()) * count;
  return units >= -(-least >> sums.unit) && units <= most >> sums.unit;
}

template <typename T>
bool areValuesOf(TallyValues::List list, std::int64_t count)
{
  using Key = decltype(orderedKey(T()));
  const auto ascends = [](const TallyValue& a, const TallyValue& b) { return a.key >= b.key; };
  std::int64_t left = count;
  for (const TallyValue& value : list)
  {
    if (value.points < 1 || value.points > left || value.key != std::int64_t(Key(value.key)))
    {
      return false;
    }
    left -= value.points;
  }
  return left == 0 && std::adjacent_find(list.first, list.last, ascends) == list.last;
}

}

void VoxelTally::write(const AccumulatedArray& kind, std::size_t first, std::size_t last,
  const std::int64_t* counts, const std::array<Vec3, 3>& columns, void* tuples) const
{
  if (isSum(kind.statistic))
  {
    sums.write(kind, first, last, counts, columns, tuples);
    return;
  }
  withType(kind.type,
    [&](auto example)
    {
      using T = decltype(example);
      T* to = static_cast<T*>(tuples);
      const auto components = std::size_t(kind.components);
      for (std::size_t list = first * components; list < last * components; ++list)
      {
        const std::int64_t count = counts[list / components - first];
        *to++ = valueOfKey<T>(kind.statistic == AttributeStatistic::Mode ? values[list].mostFrequent()
                                                                         : values[list].middle(count));
      }
    });
}

bool VoxelTally::isOf(const AccumulatedArray& kind, std::size_t voxel, std::int64_t count) const
{
  bool isRight = true;
  withType(kind.type,
    [&](auto example)
    {
      using T = decltype(example);
      for (int c = 0; isRight && c < kind.components; ++c)
      {
        const std::size_t i = voxel * std::size_t(kind.components) + std::size_t(c);
        isRight = isSum(kind.statistic)
          ? isSumOf<T>(sums, i, count) && (sums.nonFinite.empty() || simd::isOf(sums.nonFinite[i], count))
          : areValuesOf<T>(values[i], count);
      }
    });
  return isRight;
}

void VoxelTally::trim()
{
  sums.trim();
  values.ends.shrink_to_fit();
  values.values.shrink_to_fit();
}

std::size_t VoxelTally::bytes() const
{
  return sums.values.capacity() * sizeof(std::uint64_t) + sums.nonFinite.capacity() * sizeof(NonFiniteCount) +
    values.ends.capacity() * sizeof(std::size_t) + values.values.capacity() * sizeof(TallyValue);
}

} // namespace simd
} // namespace pointhaptics
