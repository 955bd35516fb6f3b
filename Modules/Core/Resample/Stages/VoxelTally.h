/// @file
/// Sums or values of an array in voxels, to which more can be added. They depend on the tuples alone, not on
/// their order or on how they came.
#pragma once

#include "Core/Base/Vector3.h"
#include "Core/Resample/AttributeView.h"
#include "Core/Resample/Kernel/VoxelKernel.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace pointhaptics::simd
{

/// Rounded once, as the compiler's own conversion of 128 bits is; nearly all values take the quick way.
inline double toDouble(Int128 value)
{
  constexpr std::int64_t kExact = std::int64_t(1) << 53;
  const auto high = std::int64_t(value >> 32);
  if (Int128(high) == value >> 32 && high > -kExact && high < kExact)
  {
    return double(high) * 0x1p32 + double(std::uint32_t(value));
  }
  return double(value);
}

/// Where the tuples of points lie.
struct Tuples
{
  const char* first;
  std::int64_t step; ///< Bytes from one to the next.
};

/// Sums of numbers, one for each component of each voxel: integers in units of 2^unit, in two's complement.
/// Floating-point numbers are summed in units of the last bit of the array's smallest. All sums have as many
/// words as the largest magnitude and the most points of a voxel need: one for most arrays of floats, two for
/// those of doubles whose magnitudes differ by less than about 2^60. Sums are exact, so a mean is within one
/// rounding of the exact one (half a unit in the last place for the quotient, as much for the sum), and a
/// lone point's is its value. NaN stands for no value: it is left out, and where there is nothing else the
/// mean is NaN. Infinities count as in IEEE addition. Memory: 8 bytes a word.
class TallySums
{
public:
  int components = 0;
  int unit = 0;
  int words = 0; ///< Words of a sum; 0 before there are any.
  std::size_t size = 0;
  std::vector<std::uint64_t> values;     ///< [voxel][component][word], the lowest word first.
  std::vector<NonFiniteCount> nonFinite; ///< [voxel][component], where there are any.

  /// Drops all sums and makes room for those of voxels with @p counts points each. @p range: of all tuples.
  void prepare(
    const AccumulatedArray& kind, const AttributeRange& range, const std::vector<std::int64_t>& counts);
  /// Adds tuple numbers[i] to voxels[i].
  void add(ScalarType type, const Tuples& tuples, const std::int64_t* numbers, const std::uint32_t* voxels,
    int count);
  /// Appends the sum of voxel @p i of @p a and voxel @p j of @p b; either may be null.
  void append(const TallySums* a, std::size_t i, const TallySums* b, std::size_t j);
  /// Writes the means of voxels @p first to before @p last, of @p counts numbers each; vectors turned by @p
  /// columns.
  void write(const AccumulatedArray& kind, std::size_t first, std::size_t last, const std::int64_t* counts,
    const std::array<Vec3, 3>& columns, void* tuples) const;

private:
  std::uint64_t* at(std::size_t sum) { return values.data() + sum * std::size_t(words); }
  const std::uint64_t* at(std::size_t sum) const { return values.data() + sum * std::size_t(words); }
  void addWide(Int128 number, int shift, std::size_t sum);
  template <typename T>
  void addNumber(T number, std::size_t sum);
  void add(std::size_t sum, const TallySums& from, std::size_t other);
  double mean(std::size_t sum, std::int64_t count, double scale) const;
  void fit(int newUnit, int newWords);
  void cover(const TallySums& other);
};

/// So many points have a value, of which this is the orderedKey().
struct TallyValue
{
  std::int64_t key;
  std::int64_t points;
};

/// Values of points: for each component of each voxel a list of those that it has, in ascending order.
/// Memory: 8 bytes a list, 16 a value.
struct TallyValues
{
  int components = 0;
  std::vector<std::size_t> ends; ///< End of each list.
  std::vector<TallyValue> values;

  struct List
  {
    const TallyValue* first;
    const TallyValue* last;
  };
  /// As of TallySums: points with a value.
  void append(const TallyValues* a, std::size_t i, const TallyValues* b, std::size_t j);
  std::size_t beginOf(std::size_t list) const { return list == 0 ? 0 : ends[list - 1]; }
  List operator[](std::size_t list) const
  {
    return { values.data() + beginOf(list), values.data() + ends[list] };
  }
};

/// Tally of an array: sums where it is summed, values where the most frequent or middle ones are wanted. The
/// other of the two has no components.
class VoxelTally
{
public:
  TallySums sums;
  TallyValues values;

  /// As of TallySums.
  void append(const VoxelTally* a, std::size_t i, const VoxelTally* b, std::size_t j)
  {
    sums.append(a ? &a->sums : nullptr, i, b ? &b->sums : nullptr, j);
    values.append(a ? &a->values : nullptr, i, b ? &b->values : nullptr, j);
  }
  /// Writes the tuples of voxels @p first to before @p last, of @p counts points each; vectors turned by @p
  /// columns.
  void write(const AccumulatedArray& kind, std::size_t first, std::size_t last, const std::int64_t* counts,
    const std::array<Vec3, 3>& columns, void* tuples) const;
};

} // namespace pointhaptics::simd
