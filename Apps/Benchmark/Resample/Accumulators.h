/// @file
/// Ways to sum the points of a voxel: what each costs and how wrong it is.
#pragma once

#include "Core/Base/PointView.h"

#include <array>
#include <cmath>
#include <cstdint>

namespace pointhaptics
{
namespace bench
{
namespace resample
{

/// Handed to an accumulator for each point: the coordinate itself and where it is in its voxel.
struct Coordinate
{
  double x;        ///< In the frame of the cloud.
  double fraction; ///< (x - lower face) / spacing, [0, 1).
};

/// Where the mean is to be taken from sums of offsets.
struct VoxelAxis
{
  double origin;  ///< Of the lattice.
  double spacing; ///< Of the lattice.
  double index;   ///< Of the voxel.

  /// The place at @p offset voxels above the lower face, beyond the precision of double.
  long double at(long double offset) const
  {
    return (long double)(origin) + ((long double)(index) + offset) * (long double)(spacing);
  }
};

/// Each sums one coordinate; the count is kept once for three of them. add(c, n): n counts c already.
struct FloatSum
{
  static constexpr const char* kName = "float sum";
  float sum = 0.0f;
  void add(const Coordinate& c, std::int64_t) { sum += float(c.x); }
  long double mean(std::int64_t n, const VoxelAxis&) const { return (long double)(sum / float(n)); }
};

struct DoubleSum
{
  static constexpr const char* kName = "double sum";
  double sum = 0.0;
  void add(const Coordinate& c, std::int64_t) { sum += c.x; }
  long double mean(std::int64_t n, const VoxelAxis&) const { return (long double)(sum / double(n)); }
};

struct FloatRunningMean
{
  static constexpr const char* kName = "float running mean";
  float value = 0.0f;
  void add(const Coordinate& c, std::int64_t n) { value += (float(c.x) - value) / float(n); }
  long double mean(std::int64_t, const VoxelAxis&) const { return (long double)(value); }
};

struct DoubleRunningMean
{
  static constexpr const char* kName = "double running mean";
  double value = 0.0;
  void add(const Coordinate& c, std::int64_t n) { value += (c.x - value) / double(n); }
  long double mean(std::int64_t, const VoxelAxis&) const { return (long double)(value); }
};

/// A compensated sum: the rounding error of each addition by Knuth's formula, which needs no branch (Kahan's
/// and Neumaier's sums do the same for the price of a condition).
struct FloatCompensated
{
  static constexpr const char* kName = "float compensated";
  float sum = 0.0f;
  float rest = 0.0f;
  void add(const Coordinate& c, std::int64_t)
  {
    const float x = float(c.x);
    const float next = sum + x;
    const float part = next - sum;
    rest += (sum - (next - part)) + (x - part);
    sum = next;
  }
  long double mean(std::int64_t n, const VoxelAxis&) const
  {
    return ((long double)(sum) + (long double)(rest)) / (long double)(n);
  }
};

struct FloatOffsetSum
{
  static constexpr const char* kName = "float sum of offsets";
  float sum = 0.0f;
  void add(const Coordinate& c, std::int64_t) { sum += float(c.fraction - 0.5); }
  long double mean(std::int64_t n, const VoxelAxis& axis) const
  {
    return axis.at(0.5L + (long double)(sum) / (long double)(n));
  }
};

struct DoubleOffsetSum
{
  static constexpr const char* kName = "double sum of offsets";
  double sum = 0.0;
  void add(const Coordinate& c, std::int64_t) { sum += c.fraction - 0.5; }
  long double mean(std::int64_t n, const VoxelAxis& axis) const
  {
    return axis.at(0.5L + (long double)(sum) / (long double)(n));
  }
};

/// Ours: integers, so that the order does not matter at all.
struct FixedPoint
{
  static constexpr const char* kName = "fixed point 2^-32";
  std::int64_t sum = 0;
  void add(const Coordinate& c, std::int64_t) { sum += std::int64_t((c.fraction - 0.5) * 0x1p32); }
  long double mean(std::int64_t n, const VoxelAxis& axis) const
  {
    return axis.at(0.5L + (long double)(sum)*0x1p-32L / (long double)(n));
  }
};

} // namespace resample
} // namespace bench
} // namespace pointhaptics
