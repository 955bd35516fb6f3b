// From the sums of arrays to their means.
#include "Core/Resample/AttributeMean.h"

#include "Core/Resample/Kernel/VoxelKernel.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

namespace pointhaptics
{
namespace
{

double powerOfTwo(int exponent)
{
  const std::uint64_t bits = std::uint64_t(exponent + 1023) << 52;
  double value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
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
  exponent = range_.exponent - std::min(lanes_, 2) * partBits_;
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
  exponent = range_.exponent - (last + 1) * partBits_ - 1;
  const auto rounded = double(2 * whole + more);
  return negative ? -rounded : rounded;
}

double AttributeMean::realMean(std::int64_t voxel, int component, std::int64_t count) const
{
  const std::uint8_t seen =
    range_.hasNonFinite ? special_[std::size_t(view_.components * voxel + component)] : std::uint8_t(0);
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

/// Each sum is one word, which the kernels divide.
bool AttributeMean::sumsAreWords() const
{
  if (isFloating())
  {
    const int exponent = range_.exponent - partBits_;
    return lanes_ == 1 && !range_.hasNonFinite && exponent > -1000 && exponent < 1000;
  }
  const int bits = view_.type == ScalarType::Int8 || view_.type == ScalarType::UInt8 ? 8
    : view_.type == ScalarType::Int16 || view_.type == ScalarType::UInt16            ? 16
                                                                                     : 32;
  return lanes_ == 1 && double(mostPoints_) * std::ldexp(1.0, bits) < std::ldexp(1.0, simd::kRealSumBits);
}

simd::WordSums AttributeMean::wordSums(const std::int64_t* counts, std::int64_t begin, std::int64_t end) const
{
  return { lanes(begin, 0), counts + begin, end - begin, view_.components,
    isFloating() ? powerOfTwo(range_.exponent - partBits_) : 1.0 };
}

template <typename Integer>
void AttributeMean::writeIntegers(const std::int64_t* counts, Integer* means, const Executor& executor) const
{
  const int components = view_.components;
  forRange(executor, voxels_,
    [&](std::int64_t begin, std::int64_t end)
    {
      if constexpr (sizeof(Integer) < 8)
      {
        if (sumsAreWords())
        {
          kernels_->meansInteger[int(view_.type)](wordSums(counts, begin, end), means + components * begin);
          return;
        }
      }
      for (std::int64_t v = begin; v < end; ++v)
      {
        for (int c = 0; c < components; ++c)
        {
          const Int128 twice = 2 * integerSum(v, c);
          const Int128 half = twice < 0 ? -counts[v] : counts[v];
          means[v * components + c] = Integer((twice + half) / (2 * Int128(counts[v])));
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
      if (sumsAreWords())
      {
        const simd::WordSums sums = wordSums(counts, begin, end);
        if constexpr (sizeof(Real) == sizeof(float))
        {
          kernels_->meansFloat(sums, means + components * begin);
        }
        else
        {
          kernels_->meansDouble(sums, means + components * begin);
        }
        return;
      }
      for (std::int64_t v = begin; v < end; ++v)
      {
        for (int c = 0; c < components; ++c)
        {
          means[v * components + c] = Real(realMean(v, c, counts[v]));
        }
      }
    });
}

template <typename Real>
void AttributeMean::writeVectors(
  const std::int64_t* counts, const Vec3 (&columns)[3], Real* vectors, const Executor& executor) const
{
  const Vec3& x = columns[0];
  const Vec3& y = columns[1];
  const Vec3& z = columns[2];
  const simd::Turn turn = { { { x.x, x.y, x.z }, { y.x, y.y, y.z }, { z.x, z.y, z.z } } };
  forRange(executor, voxels_,
    [&](std::int64_t begin, std::int64_t end)
    {
      if (sumsAreWords())
      {
        const simd::WordSums sums = wordSums(counts, begin, end);
        if constexpr (sizeof(Real) == sizeof(float))
        {
          kernels_->unitVectorsFloat(sums, turn, vectors + 3 * begin);
        }
        else
        {
          kernels_->unitVectorsDouble(sums, turn, vectors + 3 * begin);
        }
        return;
      }
      for (std::int64_t v = begin; v < end; ++v)
      {
        Vec3 sum;
        mean(v, counts[v], &sum.x);
        const Vec3 turned = sum.x * x + sum.y * y + sum.z * z;
        constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
        const Vec3 unit = isFinite(sum) ? normalized(turned, Vec3()) : Vec3(kNaN, kNaN, kNaN);
        for (int axis = 0; axis < 3; ++axis)
        {
          vectors[3 * v + axis] = Real(unit[axis]);
        }
      }
    });
}

/// Integers have a scale of their own: they keep the length of their mean.
template <typename Integer>
void AttributeMean::writeTurned(
  const std::int64_t* counts, const Vec3 (&columns)[3], Integer* vectors, const Executor& executor) const
{
  constexpr auto kLow = double(std::numeric_limits<Integer>::min());
  // The largest 64-bit integer is no double; the one below is.
  const double high = sizeof(Integer) < 8 ? double(std::numeric_limits<Integer>::max())
                                          : std::nextafter(double(std::numeric_limits<Integer>::max()), 0.0);
  forRange(executor, voxels_,
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t v = begin; v < end; ++v)
      {
        Vec3 sum;
        mean(v, counts[v], &sum.x);
        const Vec3 turned = sum.x * columns[0] + sum.y * columns[1] + sum.z * columns[2];
        const double length = norm(turned);
        const double scale = length > 0.0 ? norm(sum) / length : 0.0;
        for (int axis = 0; axis < 3; ++axis)
        {
          vectors[3 * v + axis] = Integer(std::clamp(std::round(scale * turned[axis]), kLow, high));
        }
      }
    });
}

void AttributeMean::writeNormals(
  const std::int64_t* counts, const Vec3 (&columns)[3], void* vectors, const Executor& executor) const
{
  withType(view_.type,
    [&](auto example)
    {
      using T = decltype(example);
      if constexpr (std::is_floating_point_v<T>)
      {
        writeVectors<T>(counts, columns, static_cast<T*>(vectors), executor);
      }
      else
      {
        writeTurned<T>(counts, columns, static_cast<T*>(vectors), executor);
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
