#include "Core/Resample/Stages/VoxelTally.h"

#include "Core/Resample/AttributeTuples.h"
#include "Core/Resample/Kernel/AttributeRounding.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <type_traits>

namespace pointhaptics
{
namespace simd
{
namespace
{

constexpr int kDigitBits = 32;
constexpr Int128 kBase = Int128(1) << kDigitBits;

int exponentOf(int place)
{
  return kDigitBits * (place - ExactNumber::kUnit);
}

/// The lowest digit of a number, which loses it.
template <typename Integer>
std::int32_t takeDigit(Integer& number)
{
  const auto digit = std::int32_t(std::uint32_t(number));
  number = (number - digit) >> kDigitBits;
  return digit;
}

}

double ExactNumber::rounded(int& exponent) const
{
  // Three digits from the first that is not 0 have more bits than a double; of the others the sign is enough.
  int top = size;
  while (top > 0 && digits[top - 1] == 0)
  {
    --top;
  }
  const int least = std::max(top - 3, 0);
  Int128 whole = 0;
  for (int i = top; i > least; --i)
  {
    whole = whole * kBase + digits[i - 1];
  }
  int below = least;
  while (below > 0 && digits[below - 1] == 0)
  {
    --below;
  }
  exponent = exponentOf(first + least) - 2;
  const int rest = below == 0 ? 0 : digits[below - 1] > 0 ? 1 : -1;
  return double(4 * whole + rest);
}

Int128 ExactNumber::integer() const
{
  Int128 sum = 0;
  for (int i = size; i > 0; --i)
  {
    sum = sum * kBase + digits[i - 1];
  }
  return sum * (Int128(1) << exponentOf(first));
}

ShiftedInteger::ShiftedInteger(std::int64_t value, int exponent)
{
  const int shift = exponent - exponentOf(0);
  first_ = shift / kDigitBits;
  Int128 left = Int128(value) * (Int128(1) << (shift % kDigitBits));
  while (left != 0)
  {
    digits_[size_++] = takeDigit(left);
  }
}

std::int64_t addDigits(const ExactNumber& more, int sign, int first, int size, std::int32_t* digits)
{
  std::int64_t carry = 0;
  for (int place = more.first; place < first + size && (place < more.end() || carry != 0); ++place)
  {
    std::int32_t& digit = digits[place - first];
    carry += digit + sign * std::int64_t(more.at(place));
    digit = takeDigit(carry);
  }
  return carry;
}

/// Has all sums digits from place @p begin to before @p end; others are 0.
void TallySums::setPlaces(int begin, int end)
{
  if (begin == first && end == first + width)
  {
    return;
  }
  std::vector<std::int32_t> moved;
  moved.reserve(size * std::size_t(end - begin));
  for (std::size_t sum = 0; sum < size; ++sum)
  {
    for (int place = begin; place < end; ++place)
    {
      moved.push_back((*this)[sum].at(place));
    }
  }
  digits = std::move(moved);
  first = begin;
  width = end - begin;
}

void TallySums::cover(int begin, int end)
{
  if (width == 0)
  {
    setPlaces(begin, end);
  }
  else if (begin < end)
  {
    setPlaces(std::min(first, begin), std::max(first + width, end));
  }
}

void TallySums::push(std::size_t sums)
{
  size += sums;
  digits.resize(size * std::size_t(width));
  nonFinite.resize(nonFinite.empty() ? 0 : size);
}

void TallySums::append(const TallySums& from, std::size_t begin, std::size_t end)
{
  cover(from.first, from.first + from.width);
  const std::size_t before = size;
  push(end - begin);
  for (std::size_t sum = begin; from.width > 0 && sum < end; ++sum)
  {
    std::copy_n(from[sum].digits, from.width,
      digits.data() + (before + sum - begin) * std::size_t(width) + (from.first - first));
  }
  if (!from.nonFinite.empty())
  {
    nonFinite.resize(before);
    nonFinite.insert(nonFinite.end(), from.nonFinite.begin() + std::ptrdiff_t(begin),
      from.nonFinite.begin() + std::ptrdiff_t(end));
  }
}

void TallySums::add(std::size_t sum, const ExactNumber& more, int sign)
{
  cover(more.first, more.end());
  const std::int64_t carry = addDigits(more, sign, first, width, digits.data() + sum * std::size_t(width));
  if (carry != 0)
  {
    cover(first, first + width + 1);
    digits[(sum + 1) * std::size_t(width) - 1] = std::int32_t(carry);
  }
}

bool TallySums::add(std::size_t sum, const NonFiniteCount& more, int sign)
{
  nonFinite.resize(size);
  NonFiniteCount& seen = nonFinite[sum];
  seen = { seen.nans + sign * more.nans, seen.plus + sign * more.plus, seen.minus + sign * more.minus };
  return seen.nans >= 0 && seen.plus >= 0 && seen.minus >= 0;
}

double TallySums::mean(std::size_t sum, std::int64_t count) const
{
  if (!nonFinite.empty() && nonFinite[sum].any())
  {
    return meanWithNonFinite(nonFinite[sum]);
  }
  int exponent;
  const double rounded = (*this)[sum].rounded(exponent);
  return scaledMean(rounded, exponent, count);
}

void TallySums::trim()
{
  int low = width;
  int high = 0;
  for (std::size_t i = 0; i < digits.size(); i += std::size_t(width))
  {
    for (int place = 0; place < width; ++place)
    {
      low = digits[i + place] != 0 ? std::min(low, place) : low;
      high = digits[i + place] != 0 ? std::max(high, place + 1) : high;
    }
  }
  low < high ? setPlaces(first + low, first + high) : setPlaces(ExactNumber::kUnit, ExactNumber::kUnit + 1);
  digits.shrink_to_fit();
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

bool TallyValues::addToLast(const TallyValues& from, std::size_t begin, int sign)
{
  const std::size_t firstOwn = ends.size() - std::size_t(components);
  const std::size_t start = beginOf(firstOwn);
  const std::vector<TallyValue> own(values.begin() + std::ptrdiff_t(start), values.end());
  bool isRight = true;
  std::size_t a = 0;
  values.resize(start);
  for (std::size_t c = 0; c < std::size_t(components); ++c)
  {
    const std::size_t endOfOwn = ends[firstOwn + c] - start;
    const List others = from[begin + c];
    for (const TallyValue* b = others.first; a < endOfOwn || b < others.last;)
    {
      const bool isOwn = a < endOfOwn && (b == others.last || own[a].key <= b->key);
      TallyValue both = isOwn ? own[a++] : TallyValue{ b->key, 0 };
      both.points += b < others.last && b->key == both.key ? sign * (b++)->points : 0;
      isRight = isRight && both.points >= 0;
      values.insert(values.end(), both.points != 0, both);
    }
    ends[firstOwn + c] = values.size();
  }
  return isRight;
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

bool VoxelTally::addToLast(const VoxelTally& from, std::size_t voxel, int sign)
{
  bool isRight = true;
  const std::size_t own = sums.size - std::size_t(sums.components);
  for (std::size_t c = 0; c < std::size_t(sums.components); ++c)
  {
    const std::size_t other = voxel * std::size_t(sums.components) + c;
    sums.add(own + c, from.sums[other], sign);
    isRight = (from.sums.nonFinite.empty() || sums.add(own + c, from.sums.nonFinite[other], sign)) && isRight;
  }
  return values.addToLast(from.values, voxel * std::size_t(values.components), sign) && isRight;
}

namespace
{

template <typename T>
void writeTuple(const VoxelTally& tally, const AccumulatedArray& kind, std::size_t voxel, std::int64_t count,
  const std::array<Vec3, 3>& columns, T* tuple)
{
  const auto at = [&](int c) { return voxel * std::size_t(kind.components) + std::size_t(c); };
  if (isSum(kind.statistic))
  {
    writeMeans(
      kind.components, count, kind.statistic == AttributeStatistic::Normal ? &columns : nullptr, tuple,
      [&](int c) { return tally.sums.mean(at(c), count); },
      [&](int c) { return tally.sums[at(c)].integer(); });
    return;
  }
  for (int c = 0; c < kind.components; ++c)
  {
    const TallyValues::List list = tally.values[at(c)];
    tuple[c] =
      valueOfKey<T>(kind.statistic == AttributeStatistic::Mode ? list.mostFrequent() : list.middle(count));
  }
}

bool isOf(const NonFiniteCount& seen, std::int64_t count)
{
  return seen.nans >= 0 && seen.plus >= 0 && seen.minus >= 0 && seen.nans <= count &&
    seen.plus <= count - seen.nans && seen.minus <= count - seen.nans - seen.plus;
}

/// Of integers that as many can have the sum.
template <typename T>
bool isSumOf(const ExactNumber& sum, std::int64_t count)
{
  // 34 bits of points and 64 of each: two bits are in the fourth digit.
  constexpr int kTop = ExactNumber::kUnit + 3;
  constexpr std::int64_t kMostOfTop = 4;
  if (std::is_floating_point_v<T> || sum.size == 0)
  {
    return true;
  }
  if (sum.first < ExactNumber::kUnit || sum.end() > kTop + 1 ||
    (sum.end() == kTop + 1 && std::abs(std::int64_t(sum.digits[sum.size - 1])) > kMostOfTop))
  {
    return false;
  }
  const Int128 integer = sum.integer();
  return integer >= Int128(std::numeric_limits<T>::lowest()) * count &&
    integer <= Int128(std::numeric_limits<T>::max()) * count;
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
  withType(kind.type,
    [&](auto example)
    {
      auto* to = static_cast<decltype(example)*>(tuples);
      for (std::size_t v = first; v < last; ++v, to += kind.components)
      {
        writeTuple(*this, kind, v, *counts++, columns, to);
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
          ? isSumOf<T>(sums[i], count) && (sums.nonFinite.empty() || simd::isOf(sums.nonFinite[i], count))
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
  return sums.digits.capacity() * sizeof(std::int32_t) + sums.nonFinite.capacity() * sizeof(NonFiniteCount) +
    values.ends.capacity() * sizeof(std::size_t) + values.values.capacity() * sizeof(TallyValue);
}

} // namespace simd
} // namespace pointhaptics
