#include "Core/AttributeMean.h"

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

constexpr int kMostPartBits = 40;
/// The most parts from the largest double to the last bit of the smallest, at 28 bits each.
constexpr int kMostLanes = 80;
/// With more parts than this the scale alone would push a small value below the smallest double.
constexpr int kMostScaledLanes = 8;
/// Adding and subtracting it rounds to an integer.
constexpr double kRounder = 0x1.8p52;
constexpr std::uint8_t kSawNaN = 1;
constexpr std::uint8_t kSawPlus = 2;
constexpr std::uint8_t kSawMinus = 4;

int bitsOf(std::int64_t count)
{
  int bits = 0;
  while (count >> bits != 0)
  {
    ++bits;
  }
  return bits;
}

double powerOfTwo(int exponent)
{
  const std::uint64_t bits = std::uint64_t(exponent + 1023) << 52;
  double value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

template <typename Real>
std::uint8_t kindOf(Real value)
{
  return std::isnan(value) ? kSawNaN : value > Real(0) ? kSawPlus : kSawMinus;
}

/// Calls function(T()) with the C++ type of a scalar type.
template <typename Function>
void withType(ScalarType type, Function&& function)
{
  switch (type)
  {
    case ScalarType::Int8:
      return function(std::int8_t());
    case ScalarType::UInt8:
      return function(std::uint8_t());
    case ScalarType::Int16:
      return function(std::int16_t());
    case ScalarType::UInt16:
      return function(std::uint16_t());
    case ScalarType::Int32:
      return function(std::int32_t());
    case ScalarType::UInt32:
      return function(std::uint32_t());
    case ScalarType::Int64:
      return function(std::int64_t());
    case ScalarType::UInt64:
      return function(std::uint64_t());
    case ScalarType::Float:
      return function(float());
    case ScalarType::Double:
      return function(double());
  }
}

}

AttributeMean::AttributeMean(const AttributeView& view, const Executor& executor)
  : view_(view)
{
  switch (view.type)
  {
    case ScalarType::Float:
      scan<float>(executor);
      break;
    case ScalarType::Double:
      scan<double>(executor);
      break;
    case ScalarType::Int64:
    case ScalarType::UInt64:
      lanes_ = 2;
      break;
    default:
      break;
  }
}

template <typename Real>
void AttributeMean::scan(const Executor& executor)
{
  const auto* values = static_cast<const Real*>(view_.values);
  double largest = 0.0;
  double smallest = std::numeric_limits<double>::infinity();
  bool nonFinite = false;
  std::mutex mutex;
  forRange(executor, view_.tuples * view_.components,
    [&](std::int64_t begin, std::int64_t end)
    {
      // Of the bits without the sign: they ascend with the magnitude, infinities and NaN above all.
      using Bits = std::conditional_t<sizeof(Real) == 4, std::uint32_t, std::uint64_t>;
      constexpr Bits kMagnitude = ~(Bits(1) << (8 * sizeof(Bits) - 1));
      const Real infinity = std::numeric_limits<Real>::infinity();
      Bits infinite;
      std::memcpy(&infinite, &infinity, sizeof infinite);
      Bits most = 0;
      Bits leastLessOne = infinite - 1; // Zero becomes the largest of all.
      Bits above = 0;
      for (std::int64_t i = begin; i < end; ++i)
      {
        Bits bits;
        std::memcpy(&bits, values + i, sizeof bits);
        bits &= kMagnitude;
        const bool finite = bits < infinite;
        most = std::max(most, finite ? bits : Bits(0));
        leastLessOne = std::min(leastLessOne, Bits(bits - 1));
        above |= Bits(!finite);
      }
      const Bits least = leastLessOne + 1;
      Real high;
      Real low;
      std::memcpy(&high, &most, sizeof high);
      std::memcpy(&low, &least, sizeof low);
      const std::lock_guard<std::mutex> lock(mutex);
      largest = std::max(largest, double(high));
      smallest = std::min(smallest, double(low));
      nonFinite = nonFinite || above != 0;
    });
  hasNonFinite_ = nonFinite;
  exponent_ = lastBit_ = 0;
  if (largest > 0.0)
  {
    int exponent;
    std::frexp(largest, &exponent_);
    std::frexp(smallest, &exponent);
    lastBit_ = exponent - std::numeric_limits<Real>::digits;
  }
}

/// How to cut floating-point numbers.
void AttributeMean::chooseParts(std::int64_t mostPoints)
{
  const int bits = exponent_ - lastBit_;
  const int sumBits = bitsOf(mostPoints);
  const bool inOne = bits + sumBits <= 63;
  partBits_ = inOne ? bits : std::min(kMostPartBits, 62 - sumBits);
  lanes_ = inOne ? 1 : std::min((bits + partBits_ - 1) / partBits_, kMostLanes);
  // In two factors: for tiny arrays one would overflow.
  const int shift = partBits_ - exponent_;
  scale_[0] = std::ldexp(1.0, std::min(shift, 1000));
  scale_[1] = std::ldexp(1.0, std::max(shift - 1000, 0));
}

void AttributeMean::prepare(
  std::int64_t voxels, std::int64_t mostPoints, Buffer<std::int64_t> spare, const Executor& executor)
{
  if (isFloating())
  {
    chooseParts(mostPoints);
  }
  if (spare.bytes() > sums_.bytes())
  {
    sums_ = std::move(spare);
  }
  clear(voxels, executor);
}

void AttributeMean::clear(std::int64_t voxels, const Executor& executor)
{
  voxels_ = voxels;
  const std::size_t size = std::size_t(voxels) * std::size_t(view_.components);
  sums_.reserve(size * std::size_t(lanes_), Pages::Huge);
  forRange(executor, std::int64_t(size) * lanes_,
    [this](std::int64_t begin, std::int64_t end) { std::fill(sums_.data() + begin, sums_.data() + end, 0); });
  if (hasNonFinite_)
  {
    special_.reserve(size);
    std::fill(special_.data(), special_.data() + size, std::uint8_t(0));
  }
}

/// What add() will touch lies anywhere in the array, and its sums in those of a partition.
template <typename T>
void AttributeMean::prefetch(
  const T* values, const std::int64_t* points, const std::int64_t* voxels, int count) const
{
  const std::int64_t width = std::int64_t(lanes_) * view_.components;
  for (int i = 0; i < count; ++i)
  {
    __builtin_prefetch(values + view_.components * points[i]);
    __builtin_prefetch(sums_.data() + width * voxels[i], 1);
  }
}

template <typename Integer>
void AttributeMean::addIntegers(const std::int64_t* points, const std::int64_t* voxels, int count)
{
  const auto* values = static_cast<const Integer*>(view_.values);
  const int components = view_.components;
  prefetch(values, points, voxels, count);
  for (int i = 0; i < count; ++i)
  {
    const Integer* value = values + components * points[i];
    std::int64_t* sum = sums_.data() + std::int64_t(components) * lanes_ * voxels[i];
    for (int c = 0; c < components; ++c)
    {
      if constexpr (sizeof(Integer) == 8)
      {
        // High and low halves: the low one is not negative.
        sum[2 * c] += std::int64_t(value[c] >> 32);
        sum[2 * c + 1] += std::int64_t(value[c] & Integer(0xffffffff));
      }
      else
      {
        sum[c] += value[c];
      }
    }
  }
}

namespace
{

/// The integer a number was rounded to by adding kRounder, read from the bits of the sum.
inline std::int64_t roundedInteger(double sum)
{
  std::int64_t bits;
  std::int64_t rounder;
  const double zero = kRounder;
  std::memcpy(&bits, &sum, sizeof bits);
  std::memcpy(&rounder, &zero, sizeof rounder);
  return bits - rounder;
}

/// Adds the parts of a number that is in units of the first.
inline void addParts(double scaled, double partScale, int parts, std::int64_t* sums)
{
  for (int part = 0; part < parts; ++part)
  {
    const double shifted = scaled + kRounder;
    sums[part] += roundedInteger(shifted);
    scaled = (scaled - (shifted - kRounder)) * partScale;
  }
}

/// The usual cases: all numbers finite, one scale, and either one part
template <int Components, typename Real>
void addWhole(const Real* values, int components, const std::int64_t* points, const std::int64_t* voxels,
  int count, double scale, std::int64_t* sums)
{
  const int width = Components > 0 ? Components : components;
  for (int i = 0; i < count; ++i)
  {
    const Real* value = values + width * points[i];
    std::int64_t* sum = sums + width * voxels[i];
    for (int c = 0; c < width; ++c)
    {
      sum[c] += std::int64_t(double(value[c]) * scale);
    }
  }
}

/// or two.
template <int Components, typename Real>
void addPairs(const Real* values, int components, const std::int64_t* points, const std::int64_t* voxels,
  int count, double scale, double partScale, std::int64_t* sums)
{
  const int width = Components > 0 ? Components : components;
  for (int i = 0; i < count; ++i)
  {
    const Real* value = values + width * points[i];
    std::int64_t* sum = sums + 2 * width * voxels[i];
    for (int c = 0; c < width; ++c)
    {
      addParts(double(value[c]) * scale, partScale, 2, sum + 2 * c);
    }
  }
}

}

template <typename Real>
void AttributeMean::addReals(const std::int64_t* points, const std::int64_t* voxels, int count)
{
  const auto* values = static_cast<const Real*>(view_.values);
  const int components = view_.components;
  const double partScale = std::ldexp(1.0, partBits_);
  prefetch(values, points, voxels, count);
  if (lanes_ == 1 && !hasNonFinite_ && scale_[1] == 1.0)
  {
    const auto whole = components == 3 ? &addWhole<3, Real>
      : components == 1                ? &addWhole<1, Real>
                                       : &addWhole<0, Real>;
    whole(values, components, points, voxels, count, scale_[0], sums_.data());
    return;
  }
  if (lanes_ == 2 && !hasNonFinite_ && scale_[1] == 1.0)
  {
    const auto pairs = components == 3 ? &addPairs<3, Real>
      : components == 1                ? &addPairs<1, Real>
                                       : &addPairs<0, Real>;
    pairs(values, components, points, voxels, count, scale_[0], partScale, sums_.data());
    return;
  }
  for (int i = 0; i < count; ++i)
  {
    const Real* value = values + components * points[i];
    std::int64_t* sum = sums_.data() + std::int64_t(lanes_) * components * voxels[i];
    for (int c = 0; c < components; ++c)
    {
      if (hasNonFinite_ && !std::isfinite(value[c]))
      {
        special_[std::size_t(components * voxels[i] + c)] |= kindOf(value[c]);
      }
      else if (lanes_ == 1)
      {
        sum[c] += std::int64_t(double(value[c]) * scale_[0] * scale_[1]);
      }
      else if (lanes_ <= kMostScaledLanes)
      {
        addParts(double(value[c]) * scale_[0] * scale_[1], partScale, lanes_, sum + lanes_ * c);
      }
      else if (value[c] != Real(0))
      {
        // From the part before the one its first bit is in.
        int exponent;
        std::frexp(double(value[c]), &exponent);
        const int part = std::max(0, (exponent_ - exponent) / partBits_ - 1);
        const double scaled = std::ldexp(double(value[c]), partBits_ * (part + 1) - exponent_);
        addParts(scaled, partScale, lanes_ - part, sum + lanes_ * c + part);
      }
    }
  }
}

void AttributeMean::add(const std::int64_t* points, const std::int64_t* voxels, int count)
{
  withType(view_.type,
    [&](auto example)
    {
      using T = decltype(example);
      if constexpr (std::is_floating_point_v<T>)
      {
        addReals<T>(points, voxels, count);
      }
      else
      {
        addIntegers<T>(points, voxels, count);
      }
    });
}

void AttributeMean::coarsen(const std::vector<std::int64_t>& parents, std::int64_t voxels)
{
  const Buffer<std::int64_t> fine = std::move(sums_);
  const Buffer<std::uint8_t> fineSpecial = std::move(special_);
  clear(voxels, Executor());
  const std::size_t components = std::size_t(view_.components);
  const std::size_t width = components * std::size_t(lanes_);
  for (std::size_t v = 0; v < parents.size(); ++v)
  {
    const auto parent = std::size_t(parents[v]);
    for (std::size_t c = 0; c < width; ++c)
    {
      sums_[parent * width + c] += fine[v * width + c];
    }
    for (std::size_t c = 0; hasNonFinite_ && c < components; ++c)
    {
      special_[parent * components + c] |= fineSpecial[v * components + c];
    }
  }
}

AttributeMean::Int128 AttributeMean::integerSum(std::int64_t voxel, int component) const
{
  const std::int64_t* sum = lanes(voxel, component);
  return lanes_ == 1 ? Int128(sum[0]) : Int128(sum[0]) * (Int128(1) << 32) + sum[1];
}

/// The sum is the result times 2^exponent.
double AttributeMean::realSum(std::int64_t voxel, int component, int& exponent) const
{
  const std::int64_t* sum = lanes(voxel, component);
  exponent = exponent_ - std::min(lanes_, 2) * partBits_;
  if (lanes_ == 1)
  {
    return double(sum[0]);
  }
  if (lanes_ == 2)
  {
    // Two numbers that are exact in double, so that their sum is rounded once.
    constexpr std::int64_t kExact = std::int64_t(1) << 53;
    const std::int64_t carry = sum[1] >> partBits_;
    const std::int64_t high = sum[0] + carry;
    const std::int64_t low = sum[1] - carry * (std::int64_t(1) << partBits_);
    return high > -kExact && high < kExact ? double(high) * powerOfTwo(partBits_) + double(low)
                                           : double(Int128(high) * (Int128(1) << partBits_) + low);
  }
  // Carries from part to part, all of one sign afterwards; rounded once, from the first part that is not 0.
  std::int64_t parts[kMostLanes];
  std::copy(sum, sum + lanes_, parts);
  const auto carry = [&]
  {
    for (int part = lanes_ - 1; part > 0; --part)
    {
      const std::int64_t over = parts[part] >> partBits_;
      parts[part] -= over * (std::int64_t(1) << partBits_);
      parts[part - 1] += over;
    }
  };
  carry();
  const bool negative = parts[0] < 0;
  if (negative)
  {
    std::transform(sum, sum + lanes_, parts, [](std::int64_t part) { return -part; });
    carry();
  }
  int first = 0;
  while (first + 2 < lanes_ && parts[first] == 0)
  {
    ++first;
  }
  Int128 whole = Int128(parts[first]) * (Int128(1) << partBits_) + parts[first + 1];
  int last = first + 1;
  if (last + 1 < lanes_ && parts[first] >> kMostPartBits == 0)
  {
    whole = whole * (Int128(1) << partBits_) + parts[++last];
  }
  const bool more =
    std::any_of(parts + last + 1, parts + lanes_, [](std::int64_t part) { return part != 0; });
  exponent = exponent_ - (last + 1) * partBits_ - 1;
  const auto rounded = double(2 * whole + more);
  return negative ? -rounded : rounded;
}

double AttributeMean::realMean(std::int64_t voxel, int component, std::int64_t count) const
{
  const std::uint8_t seen =
    hasNonFinite_ ? special_[std::size_t(view_.components * voxel + component)] : std::uint8_t(0);
  if (seen != 0)
  {
    const double infinity = std::numeric_limits<double>::infinity();
    return seen == kSawPlus ? infinity
      : seen == kSawMinus   ? -infinity
                            : std::numeric_limits<double>::quiet_NaN();
  }
  // Divided before it is scaled: the scale may reach among the denormals.
  int exponent;
  const double sum = realSum(voxel, component, exponent);
  // ldexp() takes as long as all the rest.
  const double mean = sum / double(count);
  return exponent > -1000 && exponent < 1000 ? mean * powerOfTwo(exponent) : std::ldexp(mean, exponent);
}

void AttributeMean::mean(std::int64_t voxel, std::int64_t count, double* means) const
{
  for (int c = 0; c < view_.components; ++c)
  {
    means[c] = isFloating() ? realMean(voxel, c, count) : double(integerSum(voxel, c)) / double(count);
  }
}

template <typename Integer>
void AttributeMean::writeIntegers(const std::int64_t* counts, Integer* means, const Executor& executor) const
{
  const int components = view_.components;
  forRange(executor, voxels_,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t v = begin; v < end; ++v)
      {
        for (int c = 0; c < components; ++c)
        {
          if constexpr (sizeof(Integer) == 8)
          {
            const Int128 twice = 2 * integerSum(v, c);
            const Int128 half = twice < 0 ? -counts[v] : counts[v];
            means[v * components + c] = Integer((twice + half) / (2 * Int128(counts[v])));
          }
          else
          {
            const std::int64_t twice = 2 * sums_[std::size_t(v * components + c)];
            const std::int64_t half = twice < 0 ? -counts[v] : counts[v];
            means[v * components + c] = Integer((twice + half) / (2 * counts[v]));
          }
        }
      }
    });
}

template <typename Real>
void AttributeMean::writeReals(const std::int64_t* counts, Real* means, const Executor& executor) const
{
  const int components = view_.components;
  forRange(executor, voxels_,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t v = begin; v < end; ++v)
      {
        for (int c = 0; c < components; ++c)
        {
          means[v * components + c] = Real(realMean(v, c, counts[v]));
        }
      }
    });
}

void AttributeMean::write(const std::int64_t* counts, void* means, const Executor& executor) const
{
  withType(view_.type,
    [&](auto example)
    {
      using T = decltype(example);
      if constexpr (std::is_floating_point_v<T>)
      {
        writeReals<T>(counts, static_cast<T*>(means), executor);
      }
      else
      {
        writeIntegers<T>(counts, static_cast<T*>(means), executor);
      }
    });
}

} // namespace pointhaptics
