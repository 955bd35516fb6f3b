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
      Bits above = 0;
      for (std::int64_t i = begin; i < end; ++i)
      {
        Bits bits;
        std::memcpy(&bits, values + i, sizeof bits);
        bits &= kMagnitude;
        const bool finite = bits < infinite;
        most = std::max(most, finite ? bits : Bits(0));
        above |= Bits(!finite);
      }
      Real value;
      std::memcpy(&value, &most, sizeof value);
      const std::lock_guard<std::mutex> lock(mutex);
      largest = std::max(largest, double(value));
      nonFinite = nonFinite || above != 0;
    });
  lanes_ = 2;
  hasNonFinite_ = nonFinite;
  std::frexp(largest, &exponent_);
  partBits_ = std::min(kMostPartBits, 62 - bitsOf(view_.tuples));
  // In two factors: for tiny arrays one would overflow.
  const int shift = partBits_ - exponent_;
  scale_[0] = std::ldexp(1.0, std::min(shift, 1000));
  scale_[1] = std::ldexp(1.0, std::max(shift - 1000, 0));
}

void AttributeMean::prepare(std::int64_t voxels)
{
  voxels_ = voxels;
  const std::size_t size = std::size_t(voxels) * std::size_t(view_.components);
  sums_.reserve(size * std::size_t(lanes_), Pages::Huge);
  std::fill(sums_.data(), sums_.data() + size * std::size_t(lanes_), 0);
  if (hasNonFinite_)
  {
    special_.reserve(size);
    std::fill(special_.data(), special_.data() + size, std::uint8_t(0));
  }
}

template <typename Integer>
void AttributeMean::addIntegers(const std::int64_t* points, const std::int64_t* voxels, int count)
{
  const auto* values = static_cast<const Integer*>(view_.values);
  const int components = view_.components;
  for (int i = 0; i < count; ++i)
  {
    __builtin_prefetch(values + components * points[i]);
  }
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

template <typename Real>
void AttributeMean::addReals(const std::int64_t* points, const std::int64_t* voxels, int count)
{
  const auto* values = static_cast<const Real*>(view_.values);
  const int components = view_.components;
  const double lowScale = std::ldexp(1.0, partBits_);
  for (int i = 0; i < count; ++i)
  {
    __builtin_prefetch(values + components * points[i]);
  }
  for (int i = 0; i < count; ++i)
  {
    const Real* value = values + components * points[i];
    std::int64_t* sum = sums_.data() + 2 * std::int64_t(components) * voxels[i];
    for (int c = 0; c < components; ++c)
    {
      const double scaled = double(value[c]) * scale_[0] * scale_[1];
      if (hasNonFinite_ && !std::isfinite(value[c]))
      {
        special_[std::size_t(components * voxels[i] + c)] |= kindOf(value[c]);
        continue;
      }
      const double high = (scaled + kRounder) - kRounder;
      const double low = ((scaled - high) * lowScale + kRounder) - kRounder;
      sum[2 * c] += std::int64_t(high);
      sum[2 * c + 1] += std::int64_t(low);
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
  prepare(voxels);
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

AttributeMean::Int128 AttributeMean::sum(std::int64_t voxel, int component) const
{
  const std::int64_t* lanes =
    sums_.data() + std::int64_t(lanes_) * (std::int64_t(view_.components) * voxel + component);
  if (lanes_ == 1)
  {
    return lanes[0];
  }
  const int shift = isFloating() ? partBits_ : 32;
  return Int128(lanes[0]) * (Int128(1) << shift) + lanes[1];
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
  return std::ldexp(double(sum(voxel, component)) / double(count), exponent_ - 2 * partBits_);
}

void AttributeMean::mean(std::int64_t voxel, std::int64_t count, double* means) const
{
  for (int c = 0; c < view_.components; ++c)
  {
    means[c] = isFloating() ? realMean(voxel, c, count) : double(sum(voxel, c)) / double(count);
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
            const Int128 twice = 2 * sum(v, c);
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
