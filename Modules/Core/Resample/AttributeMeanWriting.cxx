// From the sums of arrays to their means.
#include "Core/Resample/AttributeMean.h"

#include "Core/Resample/Kernel/AttributeRounding.h"
#include "Core/Resample/Kernel/VoxelKernel.h"
#include "Core/Resample/Stages/VoxelTally.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

namespace pointhaptics
{
using simd::Int128;
using simd::powerOfTwo;

Int128 AttributeMean::integerSum(std::int64_t voxel, int component) const
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
  const NonFinite seen =
    range_.hasNonFinite ? nonFinite_[std::size_t(view_.components * voxel + component)] : NonFinite();
  if (seen.nans + seen.plus + seen.minus > 0)
  {
    return simd::meanWithNonFinite(seen.nans > 0, seen.plus > 0, seen.minus > 0);
  }
  int exponent;
  const double sum = realSum(voxel, component, exponent);
  return simd::scaledMean(sum, exponent, count);
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

void AttributeMean::tally(simd::VoxelTally& to) const
{
  simd::TallySum sum;
  for (std::int64_t voxel = 0; voxel < voxels_; ++voxel)
  {
    for (int c = 0; c < view_.components; ++c)
    {
      const std::int64_t* const parts = lanes(voxel, c);
      for (int part = 0; part < lanes_; ++part)
      {
        constexpr int kIntegerPart = 32;
        sum.add(parts[part],
          isFloating() ? range_.exponent - (part + 1) * partBits_ : (lanes_ - 1 - part) * kIntegerPart);
      }
      if (range_.hasNonFinite)
      {
        const NonFinite& seen = nonFinite_[std::size_t(view_.components * voxel + c)];
        sum.addNonFinite(seen.nans, seen.plus, seen.minus);
      }
      sum.moveTo(to);
    }
  }
}

template <typename T>
void AttributeMean::writeTuple(std::int64_t voxel, std::int64_t count, T* tuple) const
{
  if (columns_)
  {
    Vec3 vector;
    mean(voxel, count, &vector.x);
    vector = simd::turnedMean<T>(vector, *columns_);
    std::transform(&vector.x, &vector.x + 3, tuple, [](double x) { return T(x); });
    return;
  }
  for (int c = 0; c < view_.components; ++c)
  {
    if constexpr (std::is_floating_point_v<T>)
    {
      tuple[c] = T(realMean(voxel, c, count));
    }
    else
    {
      tuple[c] = simd::roundedMean<T>(integerSum(voxel, c), count);
    }
  }
}

bool AttributeMean::write(
  const std::int64_t* counts, void* means, const Executor& executor, ProgressObserver*) const
{
  const bool byKernel = sumsAreWords() && (!columns_ || isFloating());
  simd::Turn turn = {};
  for (std::size_t axis = 0; columns_ && axis < 3; ++axis)
  {
    std::copy_n(&(*columns_)[axis].x, 3, turn.columns[axis]);
  }
  withType(view_.type,
    [&](auto example)
    {
      using T = decltype(example);
      forRange(executor, voxels_,
        [&](std::int64_t begin, std::int64_t end)
        {
          T* to = static_cast<T*>(means) + view_.components * begin;
          if (byKernel)
          {
            const simd::WordSums sums = wordSums(counts, begin, end);
            columns_ ? kernels_->unitVectors[sizeof(T) == sizeof(double)](sums, turn, to)
                     : kernels_->means[int(view_.type)](sums, to);
            return;
          }
          for (std::int64_t v = begin; v < end; ++v, to += view_.components)
          {
            writeTuple(v, counts[v], to);
          }
        });
    });
  return true;
}

} // namespace pointhaptics
