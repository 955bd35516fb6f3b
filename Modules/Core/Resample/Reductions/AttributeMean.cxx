#include "Core/Resample/Reductions/AttributeMean.h"

#include "Core/Resample/Kernel/VoxelKernel.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <mutex>
#include <type_traits>

namespace pointhaptics
{
namespace
{

int bitsOf(std::int64_t count)
{
  int bits = 0;
  while (count >> bits != 0)
  {
    ++bits;
  }
  return bits;
}

bool isReal(ScalarType type)
{
  return type == ScalarType::Float || type == ScalarType::Double;
}

/// Bits without the sign ascend with the magnitude, infinities and NaN above all.
template <typename Real, typename Bits>
AttributeRange rangeOfReals(const AttributeView& view, const Executor& executor)
{
  constexpr Bits kMagnitude = ~(Bits(1) << (8 * sizeof(Bits) - 1));
  const auto numberOf = [](Bits bits)
  {
    Real value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  };
  Bits infinite;
  const Real infinity = std::numeric_limits<Real>::infinity();
  std::memcpy(&infinite, &infinity, sizeof infinite);
  std::mutex mutex;
  Bits largest = 0;
  Bits leastLessOne = infinite - 1; // Zero becomes the largest of all.
  Bits above = 0;
  forRange(executor, view.tuples,
    [&](std::int64_t begin, std::int64_t end)
    {
      Bits ends[3] = { 0, infinite - 1, 0 };
      const std::int64_t together = view.stride == 0 ? end - begin : 1;
      for (std::int64_t i = begin; i < end; i += together)
      {
        const char* from = view.tuple(i);
        const char* const last = from + together * view.tupleBytes();
        for (; from != last; from += sizeof(Bits))
        {
          Bits bits;
          std::memcpy(&bits, from, sizeof bits);
          bits &= kMagnitude;
          ends[0] = std::max(ends[0], bits < infinite ? bits : Bits(0));
          ends[1] = std::min(ends[1], Bits(bits - 1));
          ends[2] = std::max(ends[2], bits);
        }
      }
      const std::lock_guard<std::mutex> lock(mutex);
      largest = std::max(largest, ends[0]);
      leastLessOne = std::min(leastLessOne, ends[1]);
      above = std::max(above, ends[2]);
    });
  AttributeRange range;
  range.hasNonFinite = above >= infinite;
  if (largest > 0)
  {
    int exponent;
    std::frexp(numberOf(largest), &range.exponent);
    std::frexp(numberOf(leastLessOne + 1), &exponent);
    range.lastBit = exponent - std::numeric_limits<Real>::digits;
  }
  return range;
}

}

AttributeRange rangeOf(const AttributeView& view, const Executor& executor)
{
  return view.type == ScalarType::Float ? rangeOfReals<float, std::uint32_t>(view, executor)
    : view.type == ScalarType::Double   ? rangeOfReals<double, std::uint64_t>(view, executor)
                                        : AttributeRange();
}

AttributeMean::AttributeMean(
  const AccumulatedArray& kind, const AttributeRange& range, const std::array<Vec3, 3>& columns)
  : kind_(kind)
  , range_(range)
  , columns_(columns)
{
}

void AttributeMean::prepare(const std::vector<std::int64_t>& counts)
{
  const std::int64_t most = counts.empty() ? 0 : *std::max_element(counts.begin(), counts.end());
  sums_.components = kind_.components;
  sums_.unit = range_.lastBit; // 0 of integers
  const bool isLong = kind_.type == ScalarType::Int64 || kind_.type == ScalarType::UInt64;
  sums_.words = isLong   ? 2
    : isReal(kind_.type) ? (range_.exponent - range_.lastBit + bitsOf(most)) / 64 + 1
                         : 1;
  sums_.size = counts.size() * std::size_t(kind_.components);
  sums_.values.assign(sums_.size * std::size_t(sums_.words), 0);
  sums_.nonFinite.assign(range_.hasNonFinite ? sums_.size : 0, NonFiniteCount());
}

namespace
{

/// Adds to a sum of two words.
inline void addWide(std::uint64_t* sum, simd::UInt128 more)
{
  const simd::UInt128 whole = (simd::UInt128(sum[1]) << 64 | sum[0]) + more;
  sum[0] = std::uint64_t(whole);
  sum[1] = std::uint64_t(whole >> 64);
}

/// Numbers of tuples, and the voxels they are added to.
struct Terms
{
  AttributeReducer::Tuples tuples;
  int components;
  const std::int64_t* numbers;
  const std::int64_t* voxels;
  int count;
};

/// Fields of a packed record are not aligned.
template <typename T>
T numberOf(const char* tuple, int component)
{
  T number;
  std::memcpy(&number, tuple + std::size_t(component) * sizeof(T), sizeof number);
  return number;
}

/// Calls add(sum, value) for each number: the sums have @p Words words for each of @p Components components,
/// or of the view's where the compiler is not to know.
template <int Words, int Components, typename T, typename Add>
void forNumbers(const Terms& terms, std::uint64_t* sums, const Add& add)
{
  const int width = Components > 0 ? Components : terms.components;
  const char* const first = terms.tuples.first;
  const std::int64_t step = terms.tuples.step;
  for (int i = 0; i < terms.count; ++i)
  {
    const char* const tuple = first + step * terms.numbers[i];
    std::uint64_t* sum = sums + Words * width * terms.voxels[i];
    for (int c = 0; c < width; ++c)
    {
      add(sum + Words * c, numberOf<T>(tuple, c));
    }
  }
}
template <int Words, typename T, typename Add>
void forNumbers(const Terms& terms, std::uint64_t* sums, const Add& add)
{
  terms.components == 3     ? forNumbers<Words, 3, T>(terms, sums, add)
    : terms.components == 1 ? forNumbers<Words, 1, T>(terms, sums, add)
                            : forNumbers<Words, 0, T>(terms, sums, add);
}

}

/// Adds a number to a sum of any words, and if it is not finite.
template <typename Real>
void AttributeMean::addReal(Real value, std::size_t sum)
{
  if (range_.hasNonFinite && !std::isfinite(value))
  {
    NonFiniteCount& seen = sums_.nonFinite[sum];
    ++(std::isnan(value) ? seen.nans : value > Real(0) ? seen.plus : seen.minus);
  }
  else if (value != Real(0))
  {
    constexpr int kBits = std::numeric_limits<Real>::digits;
    int exponent;
    const auto mantissa =
      std::uint64_t(std::int64_t(std::ldexp(std::frexp(double(value), &exponent), kBits)));
    // There is room: see prepare().
    static_cast<void>(
      simd::addShifted(&mantissa, 1, exponent - kBits - sums_.unit, 1, sums_.at(sum), sums_.words));
  }
}

template <typename Real>
void AttributeMean::addReals(
  const Tuples& tuples, const std::int64_t* numbers, const std::int64_t* voxels, int count)
{
  const Terms terms = { tuples, kind_.components, numbers, voxels, count };
  // A number becomes two words: the upper part is the integer that rounding finds, the lower part a word.
  constexpr int kLowBits = 62;
  constexpr int kHighBits = 50;
  constexpr double kRounder = 0x1.8p52;
  const int unit = sums_.unit;
  const bool isPlain = !range_.hasNonFinite && unit > -900 && unit < 900;
  if (sums_.words == 1 && isPlain)
  {
    const double scale = std::ldexp(1.0, -unit);
    forNumbers<1, Real>(terms, sums_.values.data(),
      [=](std::uint64_t* sum, Real value) { *sum += std::uint64_t(std::int64_t(double(value) * scale)); });
  }
  else if (sums_.words == 2 && isPlain && range_.exponent - unit <= kLowBits + kHighBits)
  {
    const double scale = std::ldexp(1.0, -unit - kLowBits);
    forNumbers<2, Real>(terms, sums_.values.data(),
      [=](std::uint64_t* sum, Real value)
      {
        const double scaled = double(value) * scale;
        const double high = (scaled + kRounder) - kRounder;
        const auto low = std::int64_t((scaled - high) * std::ldexp(1.0, kLowBits));
        addWide(sum, (simd::UInt128(simd::Int128(std::int64_t(high))) << kLowBits) + simd::UInt128(low));
      });
  }
  else
  {
    for (int i = 0; i < count; ++i)
    {
      const char* const tuple = tuples.first + tuples.step * numbers[i];
      for (int c = 0; c < kind_.components; ++c)
      {
        addReal(numberOf<Real>(tuple, c), std::size_t(kind_.components * voxels[i] + c));
      }
    }
  }
}

void AttributeMean::add(
  const Tuples& tuples, const std::int64_t* numbers, const std::int64_t* voxels, int count)
{
  withType(kind_.type,
    [&](auto example)
    {
      using T = decltype(example);
      if constexpr (std::is_floating_point_v<T>)
      {
        addReals<T>(tuples, numbers, voxels, count);
      }
      else
      {
        constexpr int kWords = sizeof(T) == 8 ? 2 : 1;
        forNumbers<kWords, T>({ tuples, kind_.components, numbers, voxels, count }, sums_.values.data(),
          [](std::uint64_t* sum, T value)
          { kWords == 2 ? addWide(sum, simd::UInt128(value)) : void(*sum += std::uint64_t(value)); });
      }
    });
}

void AttributeMean::write(const std::int64_t* counts, void* means) const
{
  sums_.write(kind_, 0, sums_.size / std::size_t(kind_.components), counts, columns_, means);
}

} // namespace pointhaptics
