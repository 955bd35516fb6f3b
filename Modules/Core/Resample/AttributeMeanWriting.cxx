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
  std::int32_t digits[simd::ExactNumber::kPlaces] = {};
  for (int part = 0; part < lanes_; ++part)
  {
    const simd::ShiftedInteger more(sum[part], exponentOf(part));
    simd::addDigits(more.number(), 1, 0, simd::ExactNumber::kPlaces, digits);
  }
  return simd::ExactNumber{ 0, simd::ExactNumber::kPlaces, digits }.rounded(exponent);
}

double AttributeMean::mean(std::int64_t voxel, int component, std::int64_t count) const
{
  if (!isFloating())
  {
    return double(integerSum(voxel, component)) / double(count);
  }
  if (range_.hasNonFinite)
  {
    const NonFiniteCount& seen = nonFinite_[std::size_t(view_.components * voxel + component)];
    if (seen.any())
    {
      return simd::meanWithNonFinite(seen);
    }
  }
  int exponent;
  const double sum = realSum(voxel, component, exponent);
  return simd::scaledMean(sum, exponent, count);
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

/// Of what is counted in a lane.
int AttributeMean::exponentOf(int lane) const
{
  constexpr int kIntegerPart = 32;
  return isFloating() ? range_.exponent - (lane + 1) * partBits_ : (lanes_ - 1 - lane) * kIntegerPart;
}

simd::VoxelTally AttributeMean::tally() const
{
  simd::VoxelTally tally;
  tally.sums.components = view_.components;
  tally.sums.push(std::size_t(voxels_ * view_.components));
  for (std::size_t sum = 0; sum < tally.sums.size; ++sum)
  {
    for (int lane = 0; lane < lanes_; ++lane)
    {
      const std::int64_t part = sums_[sum * std::size_t(lanes_) + std::size_t(lane)];
      tally.sums.add(sum, simd::ShiftedInteger(part, exponentOf(lane)).number());
    }
    if (range_.hasNonFinite)
    {
      static_cast<void>(tally.sums.add(sum, nonFinite_[sum])); // No count is below 0.
    }
  }
  return tally;
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
            simd::writeMeans(
              view_.components, counts[v], columns_ ? &*columns_ : nullptr, to,
              [&](int c) { return mean(v, c, counts[v]); }, [&](int c) { return integerSum(v, c); });
          }
        });
    });
  return true;
}

} // namespace pointhaptics
