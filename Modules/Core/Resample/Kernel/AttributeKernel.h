/// @file
/// The inner loops of averaging arrays: a part of VoxelKernel.h.
#pragma once

#include <cstdint>

namespace pointhaptics
{
namespace simd
{

/// What there is among numbers.
struct Magnitudes
{
  double largest;  ///< Of the finite ones; 0 without any.
  double smallest; ///< Of those that are not 0; infinite without any.
  bool allFinite;
};

/// Sums of consecutive voxels in one word each.
struct WordSums
{
  const std::int64_t* sums; ///< [voxel][component]
  const std::int64_t* counts;
  std::int64_t voxels;
  int components;
  double unit; ///< What 1 in a sum stands for: a power of two.
};

/// How vectors are turned: the products of their components with the columns are added.
struct Turn
{
  double columns[3][3];
};

/// Consecutive lists of values, of one type.
struct ValueLists
{
  const void* values; ///< Of all lists of an array.
  std::int64_t begin; ///< Of the first list among them.
  const std::int64_t* ends;
  int count;
};
/// Lists of more values are left to others.
constexpr int kFewValues = 64;
/// Bytes of the vectors that lists are read in.
constexpr int kListVector = 32;

/// Rounded means of integers go through double where sums are below 2^kRealSumBits.
constexpr int kRealSumBits = 51;
struct AttributeKernels
{
  // Of floats and of doubles.
  Magnitudes (*magnitudes[2])(const void* values, std::int64_t count);
  /// means, of three components, turned, and divided by their length where that is above 0 and finite; else
  /// 0.
  void (*unitVectors[2])(const WordSums&, const Turn&, void* vectors);
  /// In the order of ScalarType; null for integers of 64 bits. sum / count unit, each operation rounded; of
  /// integers, whose unit is 1, sum / count rounded to the nearest, halves away from zero.
  void (*means[10])(const WordSums&, void* means);
  /// The modes of lists, and the lower medians, in the order of ScalarType: see AttributeStatistic. That of a
  /// list goes to @p to, @p step values after the one before. Lists of more than kFewValues are named in @p
  /// many. @return the number of these. Reads, but does not use, kListVector bytes past the end.
  int (*modes[10])(const ValueLists&, void* to, int step, int* many);
  int (*medians[10])(const ValueLists&, void* to, int step, int* many);
};

} // namespace simd
} // namespace pointhaptics
