#include "Core/Resample/Stages/VoxelTally.h"

#include "Core/Resample/Stages/VoxelRun.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

namespace pointhaptics::simd
{
namespace
{

/// Adds @p sign times a number of @p count words to a sum of @p size words, shifted left by so many bits, or
/// right where that loses no bit. @return false where the sum has no room for the result: its sign is wrong.
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

/// @pre @p exponent is that of a normal number.
inline double powerOfTwo(int exponent)
{
  const std::uint64_t bits = std::uint64_t(exponent + 1023) << 52;
  double value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

/// The mean of numbers whose sum is @p sum 2^exponent. Divided before it is scaled: the scale may reach among
/// the denormals.
inline double scaledMean(double sum, int exponent, std::int64_t count)
{
  // ldexp() takes as long as all the rest.
  const double mean = sum / double(count);
  return exponent > -1000 && exponent < 1000 ? mean * powerOfTwo(exponent) : std::ldexp(mean, exponent);
}

/// Sum by IEEE addition of numbers some of which are infinite, or all of them NaN.
inline double meanWithNonFinite(const NonFiniteCount& seen)
{
  const double infinity = std::numeric_limits<double>::infinity();
  return (seen.plus > 0) == (seen.minus > 0) ? std::numeric_limits<double>::quiet_NaN()
    : seen.plus > 0                          ? infinity
                                             : -infinity;
}

/// Rounded to the nearest, halves away from zero.
template <typename T>
T roundedMean(Int128 sum, std::int64_t count)
{
  constexpr Int128 kFew = Int128(1) << 62;
  if (sum < kFew && sum > -kFew) // There is a quick division.
  {
    const std::int64_t half = sum < 0 ? -(count / 2) : count / 2;
    return T((std::int64_t(sum) + half) / count);
  }
  const Int128 twice = 2 * sum;
  return T((twice + (twice < 0 ? -count : count)) / (2 * Int128(count)));
}

/// A mean vector, turned: unit vectors, 0 without a direction, NaN where it is not finite. Integers have a
/// scale of their own: they keep the length of their mean.
template <typename T>
Vec3 turnedMean(const Vec3& mean, const std::array<Vec3, 3>& columns)
{
  const Vec3 turned = mean.x * columns[0] + mean.y * columns[1] + mean.z * columns[2];
  if constexpr (std::is_floating_point_v<T>)
  {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    return isFinite(mean) ? normalized(turned, Vec3()) : Vec3(kNaN, kNaN, kNaN);
  }
  else
  {
    constexpr auto kLow = double(std::numeric_limits<T>::min());
    constexpr auto kHigh = double(std::numeric_limits<T>::max());
    // The largest 64-bit integer is no double; the one below is.
    const double high = sizeof(T) < 8 ? kHigh : std::nextafter(kHigh, 0.0);
    const double length = norm(turned);
    const double scale = length > 0.0 ? norm(mean) / length : 0.0;
    const auto rounded = [&](double x) { return std::clamp(std::round(scale * x), kLow, high); };
    return { rounded(turned.x), rounded(turned.y), rounded(turned.z) };
  }
}

int bitsOf(std::int64_t count)
{
  int bits = 0;
  while (count >> bits != 0)
  {
    ++bits;
  }
  return bits;
}

/// Adds a number, shifted left, to a sum whose words have room for the result.
inline void addWide(std::uint64_t* sum, int words, UInt128 more, int shift, bool isNegative)
{
  if (words == 2) // as most sums of doubles have
  {
    const UInt128 shifted = more << shift;
    const UInt128 both = (UInt128(sum[1]) << 64 | sum[0]) + (isNegative ? -shifted : shifted);
    sum[0] = std::uint64_t(both);
    sum[1] = std::uint64_t(both >> 64);
    return;
  }
  int word = shift / 64;
  const int bits = shift % 64;
  UInt128 carry = more << bits; // more has up to 64 bits
  if (isNegative)
  {
    carry = -carry;
  }
  const std::uint64_t sign = isNegative && more != 0 ? ~std::uint64_t(0) : 0;
  UInt128 low = UInt128(sum[word]) + std::uint64_t(carry);
  sum[word] = std::uint64_t(low);
  std::uint64_t above = std::uint64_t(carry >> 64);
  for (++word; word < words; ++word, above = sign)
  {
    low = UInt128(sum[word]) + above + std::uint64_t(low >> 64);
    sum[word] = std::uint64_t(low);
  }
}

}

void TallySums::prepare(
  const AccumulatedArray& kind, const AttributeRange& range, const std::vector<std::int64_t>& counts)
{
  const std::int64_t most = counts.empty() ? 0 : *std::max_element(counts.begin(), counts.end());
  const bool isReal = kind.type == ScalarType::Float || kind.type == ScalarType::Double;
  components = kind.components;
  unit = range.lastBit; // 0 of integers
  words = isReal ? (range.exponent - range.lastBit + bitsOf(most)) / 64 + 1 : bytesOf(kind.type) == 8 ? 2 : 1;
  size = counts.size() * std::size_t(kind.components);
  values.assign(size * std::size_t(words), 0);
  nonFinite.assign(range.hasNonFinite ? size : 0, NonFiniteCount());
}

/// Adds a number to a sum of any words, and if it is not finite.
template <typename T>
inline void TallySums::addNumber(T number, std::size_t sum)
{
  if constexpr (!std::is_floating_point_v<T>)
  {
    const bool isNegative = number < 0;
    addWide(at(sum), words, isNegative ? 0 - std::uint64_t(number) : std::uint64_t(number), 0, isNegative);
  }
  else if (!std::isfinite(number))
  {
    NonFiniteCount& seen = nonFinite[sum];
    ++(std::isnan(number) ? seen.nans : number > T(0) ? seen.plus : seen.minus);
  }
  else
  {
    constexpr int kMantissaBits = 52;
    const double value = number;
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    const int exponent = int(bits >> kMantissaBits & 2047);
    std::uint64_t mantissa = bits & ((std::uint64_t(1) << kMantissaBits) - 1);
    mantissa |= std::uint64_t(exponent > 0) << kMantissaBits;
    const int shift = std::max(exponent, 1) - 1075 - unit;
    // Bits below the unit are 0.
    shift < 0 ? addWide(at(sum), words, shift > -64 ? mantissa >> -shift : 0, 0, bits >> 63 != 0)
              : addWide(at(sum), words, mantissa, shift, bits >> 63 != 0);
  }
}

void TallySums::add(
  ScalarType type, const Tuples& tuples, const std::int64_t* numbers, const std::int64_t* voxels, int count)
{
  withType(type,
    [&](auto example)
    {
      using T = decltype(example);
      const auto forNumbers = [&](const auto& addOne)
      {
        withWidth(components,
          [=, from = tuples](auto width)
          {
            for (int i = 0; i < count; ++i)
            {
              const char* const tuple = from.first + from.step * numbers[i];
              const std::size_t sum = width * std::size_t(voxels[i]);
              for (std::size_t c = 0; c < width; ++c)
              {
                T number; // Fields of a packed record are not aligned.
                std::memcpy(&number, tuple + c * sizeof(T), sizeof number);
                addOne(number, sum + c);
              }
            }
          });
      };
      constexpr bool kIsReal = std::is_floating_point_v<T>;
      std::uint64_t* const word = values.data();
      const double scale = kIsReal ? std::ldexp(1.0, -unit) : 1.0;
      if (words > 1 || !nonFinite.empty() || !std::isnormal(scale))
      {
        forNumbers([&](T number, std::size_t sum) { this->addNumber(number, sum); });
        return;
      }
      forNumbers(
        [=](T number, std::size_t sum) {
          word[sum] += kIsReal ? std::uint64_t(std::int64_t(double(number) * scale)) : std::uint64_t(number);
        });
    });
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
  const std::vector<const TallySums*>& runs, const VoxelGroups& groups, bool& isRight)
{
  TallySums all;
  all.unit = std::numeric_limits<int>::max();
  bool areFinite = true;
  for (const TallySums* run : runs)
  {
    all.components = std::max(all.components, run->components);
    all.unit = run->size > 0 ? std::min(all.unit, run->unit) : all.unit;
    areFinite = areFinite && run->nonFinite.empty();
  }
  for (const TallySums* run : runs)
  {
    all.words =
      run->size > 0 ? std::max(all.words, run->words + (run->unit - all.unit + 63) / 64) : all.words;
  }
  all.unit = all.words > 0 ? all.unit : 0;
  const auto width = std::size_t(all.components);
  all.size = groups.size() * width;
  all.values.assign(all.size * std::size_t(all.words), 0);
  all.nonFinite.resize(areFinite ? 0 : all.size);
  for (std::size_t group = 0; group < groups.size(); ++group)
  {
    for (std::size_t i = groups.beginOf(group); i < groups.ends[group]; ++i)
    {
      const VoxelGroups::Voxel& voxel = groups.voxels[i];
      for (std::size_t c = 0; c < width; ++c)
      {
        const bool isLeft = all.add(
          group * width + c, *runs[std::size_t(voxel.run)], voxel.number * width + c, groups.signOf(voxel));
        isRight = isRight && isLeft;
      }
    }
  }
  return all;
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
  withType(kind.type,
    [&](auto example)
    {
      using T = decltype(example);
      T* to = static_cast<T*>(tuples);
      std::size_t sum = first * std::size_t(components);
      for (std::size_t v = first; v < last; ++v)
      {
        const std::int64_t count = counts[v - first];
        if (kind.statistic == AttributeStatistic::Normal)
        {
          const Vec3 vector =
            turnedMean<T>({ mean(sum, count), mean(sum + 1, count), mean(sum + 2, count) }, columns);
          to = std::transform(&vector.x, &vector.x + 3, to, [](double x) { return T(x); });
          sum += 3;
          continue;
        }
        for (int c = 0; c < components; ++c, ++sum, ++to)
        {
          if constexpr (std::is_floating_point_v<T>)
          {
            *to = T(mean(sum, count));
          }
          else
          {
            *to = roundedMean<T>(inUnits(sum) * (Int128(1) << unit), count);
          }
        }
      }
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

} // namespace pointhaptics::simd
