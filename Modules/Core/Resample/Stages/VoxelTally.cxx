#include "Core/Resample/Stages/VoxelTally.h"

#include "Core/Resample/Kernel/OrderedKey.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

namespace pointhaptics::simd
{

namespace
{

/// Adds a number of @p count words to a sum of @p size words, shifted left by so many bits, or right where
/// that loses no bit. @return false where the sum has no room for the result: its sign is wrong.
bool addShifted(const std::uint64_t* number, int count, int shift, std::uint64_t* sum, int size)
{
  const int whole = (shift - (shift < 0 ? 63 : 0)) / 64;
  const int bits = shift - 64 * whole;
  const auto word = [=](int i) {
    return i < 0 ? 0 : i < count ? number[i] : std::uint64_t(std::int64_t(number[count - 1]) >> 63);
  };
  UInt128 carry = 0;
  std::uint64_t before = 0;
  std::uint64_t more = 0;
  for (int i = 0; i < size; ++i)
  {
    more = word(i - whole) << bits | (bits > 0 ? word(i - whole - 1) >> (64 - bits) : 0);
    before = sum[i];
    carry += UInt128(before) + more;
    sum[i] = std::uint64_t(carry);
    carry >>= 64;
  }
  // Both have a sign that the result has not.
  return ((before ^ sum[size - 1]) & (more ^ sum[size - 1])) >> 63 == 0;
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

}

void TallySums::prepare(
  const AccumulatedArray& kind, const AttributeRange& range, const std::vector<std::int64_t>& counts)
{
  const std::int64_t most = counts.empty() ? 0 : *std::max_element(counts.begin(), counts.end());
  const bool isReal = kind.type == ScalarType::Float || kind.type == ScalarType::Double;
  components = kind.components;
  unit = range.lastBit; // 0 of integers
  words = isReal
    ? (range.exponent - range.lastBit + std::ilogb(double(std::max<std::int64_t>(most, 1))) + 1) / 64 + 1
    : bytesOf(kind.type) == 8 ? 2
                              : 1;
  size = counts.size() * std::size_t(kind.components);
  values.assign(size * std::size_t(words), 0);
  nonFinite.assign(range.hasNonFinite ? size : 0, NonFiniteCount());
}

/// Adds @p number 2^shift to a sum that has room for the result.
inline void TallySums::addWide(Int128 number, int shift, std::size_t sum)
{
  std::uint64_t* const to = at(sum);
  if (words == 2 && shift >= 0) // as most sums of doubles
  {
    const UInt128 both = (UInt128(to[1]) << 64 | to[0]) + (UInt128(number) << shift);
    to[0] = std::uint64_t(both);
    to[1] = std::uint64_t(both >> 64);
    return;
  }
  const std::uint64_t parts[2] = { std::uint64_t(number), std::uint64_t(UInt128(number) >> 64) };
  static_cast<void>(addShifted(parts, 2, shift, to, words));
}

/// Adds a number to a sum of any words, and if it is not finite.
template <typename T>
inline void TallySums::addNumber(T number, std::size_t sum)
{
  if constexpr (!std::is_floating_point_v<T>)
  {
    addWide(number, 0, sum);
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
    const std::uint64_t below = bits & ((std::uint64_t(1) << kMantissaBits) - 1);
    const auto mantissa = std::int64_t(below | std::uint64_t(exponent > 0) << kMantissaBits);
    addWide(value < 0.0 ? -mantissa : mantissa, std::max(exponent, 1) - 1075 - unit, sum);
  }
}

void TallySums::add(
  ScalarType type, const Tuples& tuples, const std::int64_t* numbers, const std::uint32_t* voxels, int count)
{
  withType(type,
    [&](auto example)
    {
      using T = decltype(example);
      const auto forNumbers = [=, from = tuples, width = std::size_t(components)](const auto& addOne)
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
  std::vector<std::uint64_t> moved(size * std::size_t(newWords), 0);
  for (std::size_t sum = 0; sum < size; ++sum)
  {
    static_cast<void>(
      addShifted(at(sum), words, unit - newUnit, moved.data() + sum * std::size_t(newWords), newWords));
  }
  values = std::move(moved);
  unit = newUnit;
  words = newWords;
}

/// Adds the @p other sum of @p from, which this covers.
inline void TallySums::add(std::size_t sum, const TallySums& from, std::size_t other)
{
  const std::uint64_t top = at(sum)[words - 1];
  std::int64_t result; // Mostly words are added.
  if (words == 1 && from.unit == unit &&
    !__builtin_add_overflow(std::int64_t(top), std::int64_t(*from.at(other)), &result))
  {
    *at(sum) = std::uint64_t(result);
  }
  else if (!addShifted(from.at(other), from.words, from.unit - unit, at(sum), words))
  {
    fit(unit, words + 1);
    at(sum)[words - 1] = std::uint64_t(std::int64_t(top) >> 63);
  }
  if (!from.nonFinite.empty())
  {
    NonFiniteCount& seen = nonFinite[sum];
    const NonFiniteCount& more = from.nonFinite[other];
    seen = { seen.nans + more.nans, seen.plus + more.plus, seen.minus + more.minus };
  }
}

/// Has sums hold those of the other, too.
void TallySums::cover(const TallySums& other)
{
  components = other.components;
  const int least = words > 0 ? std::min(unit, other.unit) : other.unit;
  const auto wordsOf = [=](const TallySums& sums) { return sums.words + (sums.unit - least + 63) / 64; };
  fit(least, std::max(words > 0 ? wordsOf(*this) : 0, wordsOf(other)));
}

void TallySums::append(const TallySums* a, std::size_t i, const TallySums* b, std::size_t j)
{
  const auto width = std::size_t(a ? a->components : b->components);
  const bool areFinite = nonFinite.empty() && (!a || a->nonFinite.empty()) && (!b || b->nonFinite.empty());
  for (const TallySums* const other : { a, b })
  {
    other && (other->unit != unit || other->words != words) ? cover(*other) : void();
  }
  size += width;
  values.resize(size * std::size_t(words), 0);
  nonFinite.resize(areFinite ? 0 : size);
  for (std::size_t sum = size - width, c = 0; c < width; ++c, ++sum)
  {
    a ? add(sum, *a, i * width + c) : void();
    b ? add(sum, *b, j * width + c) : void();
  }
}

/// @p scale: 2^unit, or 0 where that is no normal number.
double TallySums::mean(std::size_t sum, std::int64_t count, double scale) const
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
  // Two words have more bits than a double: of those below it is enough whether all are 0.
  const bool isExact =
    std::all_of(number, number + std::max(top - 1, 0), [](std::uint64_t w) { return w == 0; });
  const double whole = top == 0
    ? double(std::int64_t(number[0]))
    : toDouble(Int128(UInt128(number[top]) << 64 | number[top - 1] | std::uint64_t(!isExact)));
  // Divided before it is scaled: the scale may reach among the denormals. ldexp() takes as long as the rest.
  return top <= 1 && scale > 0.0 ? whole / double(count) * scale
                                 : std::ldexp(whole / double(count), unit + 64 * std::max(top - 1, 0));
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
      const double power = std::ldexp(1.0, unit);
      const double scale = std::isnormal(power) ? power : 0.0;
      for (std::size_t v = first; v < last; ++v)
      {
        const std::int64_t count = counts[v - first];
        if (kind.statistic == AttributeStatistic::Normal)
        {
          const Vec3 vector = turnedMean<T>(
            { mean(sum, count, scale), mean(sum + 1, count, scale), mean(sum + 2, count, scale) }, columns);
          to = std::transform(&vector.x, &vector.x + 3, to, [](double x) { return T(x); });
          sum += 3;
          continue;
        }
        for (int c = 0; c < components; ++c, ++sum, ++to)
        {
          if constexpr (std::is_floating_point_v<T>)
          {
            *to = T(mean(sum, count, scale));
          }
          else
          {
            const std::uint64_t* const number = at(sum); // of up to two words
            *to = roundedMean<T>(
              words == 1 ? Int128(std::int64_t(number[0])) : Int128(UInt128(number[1]) << 64 | number[0]),
              count);
          }
        }
      }
    });
}

void TallyValues::append(const TallyValues* a, std::size_t i, const TallyValues* b, std::size_t j)
{
  components = a ? a->components : b->components;
  const auto width = std::size_t(components);
  for (std::size_t c = 0; c < width; ++c)
  {
    List ofA = a ? (*a)[i * width + c] : List{};
    List ofB = b ? (*b)[j * width + c] : List{};
    while (ofA.first != ofA.last || ofB.first != ofB.last)
    {
      const bool isIn = ofA.first != ofA.last && (ofB.first == ofB.last || ofA.first->key <= ofB.first->key);
      const bool isInOther = ofB.first != ofB.last && (!isIn || ofB.first->key == ofA.first->key);
      values.push_back({ isIn ? ofA.first->key : ofB.first->key,
        (isIn ? ofA.first->points : 0) + (isInOther ? ofB.first->points : 0) });
      ofA.first += isIn;
      ofB.first += isInOther;
    }
    ends.push_back(values.size());
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
        const bool isMode = kind.statistic == AttributeStatistic::Mode;
        const TallyValues::List points = values[list];
        const TallyValue* value = isMode
          ? std::max_element(points.first, points.last,
              [](const TallyValue& a, const TallyValue& b) { return a.points < b.points; })
          : points.first;
        std::int64_t left = (counts[list / components - first] - 1) / 2;
        for (; !isMode && left >= value->points; ++value)
        {
          left -= value->points;
        }
        *to++ = valueOfKey<T>(value->key);
      }
    });
}

} // namespace pointhaptics::simd
