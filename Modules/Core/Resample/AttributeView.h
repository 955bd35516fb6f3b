/// @file
/// Arrays of attributes, and what is made of them voxel by voxel.
#pragma once

#include "Core/Base/Executor.h"
#include "Core/Base/ScalarType.h"

#include <cstdint>
#include <optional>

namespace pointhaptics
{

/// An array owned by the caller: tuples of components.
struct AttributeView
{
  const void* values = nullptr;
  ScalarType type = ScalarType::Float;
  int components = 1;
  std::int64_t tuples = 0;
  std::int64_t stride = 0; ///< Bytes from one tuple to the next; 0: none lie between.

  std::int64_t tupleBytes() const { return std::int64_t(bytesOf(type)) * components; }
  /// Bytes from one tuple to the next.
  std::int64_t step() const { return stride > 0 ? stride : tupleBytes(); }
  const char* tuple(std::int64_t i) const { return static_cast<const char*>(values) + step() * i; }
};

/// Properties of all finite values of a floating-point array that must be known before some of them are
/// summed.
struct AttributeRange
{
  int exponent = 0; ///< All magnitudes are below 2^exponent.
  int lastBit = 0;  ///< And multiples of 2^lastBit.
  bool hasNonFinite = false;
};

/// Scans the values of a floating-point array once; integers need no range.
AttributeRange rangeOf(const AttributeView& view, const Executor& executor);

/// How many numbers are not finite.
struct NonFiniteCount
{
  std::int64_t nans = 0;
  std::int64_t plus = 0;
  std::int64_t minus = 0;

  bool any() const { return nans > 0 || plus > 0 || minus > 0; }
};

/// Statistic of an array in a voxel. All are exact, and none depends on the order of the points.
enum class AttributeStatistic
{
  Mean, ///< Mean; means of integers are rounded to the nearest, halves away from zero.
  /// The mean of vectors of three, turned as normals are by the request's transform: unit vectors, 0 without
  /// a direction; those of integers are as long as their mean.
  Normal,
  Mode,   ///< The value that most points have, component by component, the smallest of several: for labels.
  Median, ///< Component by component, of an even number the lower middle one.
};

/// Such are summed, and need no more memory for more points; of others all tuples are kept.
inline bool isSum(AttributeStatistic statistic)
{
  return statistic == AttributeStatistic::Mean || statistic == AttributeStatistic::Normal;
}

/// An array to reduce to one tuple a voxel, of its own type.
struct AttributeRequest
{
  AttributeView view; ///< A tuple for each point.
  AttributeStatistic statistic = AttributeStatistic::Mean;
  std::optional<AttributeRange> range = {}; ///< rangeOf() the view as it is, where that is known already.
};

/// An array of which several clouds bring tuples, and what becomes of them in a voxel.
struct AccumulatedArray
{
  ScalarType type = ScalarType::Float;
  int components = 1;
  AttributeStatistic statistic = AttributeStatistic::Mean;

  bool operator==(const AccumulatedArray& other) const
  {
    return type == other.type && components == other.components && statistic == other.statistic;
  }
};

} // namespace pointhaptics
