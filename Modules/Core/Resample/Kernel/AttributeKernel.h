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

/// Rounded means of integers go through double where sums are below 2^kRealSumBits.
constexpr int kRealSumBits = 51;
/// Integer types of up to 32 bits, in the order of ScalarType.
constexpr int kShortIntegers = 6;

struct AttributeKernels
{
  Magnitudes (*magnitudesFloat)(const float* values, std::int64_t count);
  Magnitudes (*magnitudesDouble)(const double* values, std::int64_t count);
  /// sum / count unit, each operation rounded.
  void (*meansFloat)(const WordSums&, float* means);
  void (*meansDouble)(const WordSums&, double* means);
  /// sum / count rounded to the nearest integer, halves away from zero. @pre unit is 1.
  void (*meansInteger[kShortIntegers])(const WordSums&, void* means);
  /// The same as means, of three components, turned, and divided by their length where that is above 0 and
  /// finite; else 0.
  void (*unitVectorsFloat)(const WordSums&, const Turn&, float* vectors);
  void (*unitVectorsDouble)(const WordSums&, const Turn&, double* vectors);
};

} // namespace simd
} // namespace pointhaptics
