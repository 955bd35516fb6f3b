/// @file
/// What an array has in voxels, in a form that any more can be added to, or taken from. It depends on the
/// tuples alone, not on their order or on how they came.
#pragma once

#include "Core/Base/Vector3.h"
#include "Core/Resample/AttributeView.h"
#include "Core/Resample/Kernel/VoxelKernel.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pointhaptics
{
namespace simd
{

/// An exact number, whatever its magnitude: digits of 32 bits, the least first, from -2^31 to below 2^31. A
/// digit at place 0 is in units of 2^-1216, below the last bit of a double.
struct ExactNumber
{
  int first; ///< The place of the first digit.
  int size;
  const std::int32_t* digits;

  static constexpr int kPlaces = 76; ///< Up to beyond the largest sum of doubles.
  static constexpr int kUnit = 38;   ///< The place of 1.

  int end() const { return first + size; }
  std::int32_t at(int place) const { return place >= first && place < end() ? digits[place - first] : 0; }
  /// Rounded once; times 2^exponent it is the number.
  double rounded(int& exponent) const;
  /// @pre it is an integer below 2^126.
  Int128 integer() const;
};

/// An integer times a power of two. @pre its bits lie at places of digits.
class ShiftedInteger
{
public:
  ShiftedInteger(std::int64_t value, int exponent);
  ExactNumber number() const { return { first_, size_, digits_ }; }

private:
  int first_;
  int size_ = 0;
  std::int32_t digits_[3];
};

/// Adds @p sign times a number to another one, whose @p digits are at as many places or more. @return what
/// its digits have no room for, in units of the place after the last of them.
std::int64_t addDigits(const ExactNumber& more, int sign, int first, int size, std::int32_t* digits);

/// Sums of numbers, one for each component of each voxel. All have digits at the same places. Memory: 4 bytes
/// a digit, of which most arrays have one to three.
class TallySums
{
public:
  int components = 0;
  int first = 0; ///< The place of the first digit.
  int width = 0; ///< Digits of a sum.
  std::size_t size = 0;
  std::vector<std::int32_t> digits;      ///< [voxel][component][digit]
  std::vector<NonFiniteCount> nonFinite; ///< [voxel][component], where there are any.

  ExactNumber operator[](std::size_t sum) const
  {
    return { first, width, digits.data() + sum * std::size_t(width) };
  }
  /// Gives all sums digits from place @p begin to before @p end, too.
  void cover(int begin, int end);
  /// Appends sums of no numbers.
  void push(std::size_t sums);
  /// Appends the sums from @p begin to before @p end of others.
  void append(const TallySums& from, std::size_t begin, std::size_t end);
  void add(std::size_t sum, const ExactNumber& more, int sign = 1);
  /// @return false where that leaves a count below 0.
  bool add(std::size_t sum, const NonFiniteCount& more, int sign = 1);
  /// The mean of @p count numbers.
  double mean(std::size_t sum, std::int64_t count) const;
  /// Leaves out digits and counts that are 0 everywhere, but one digit, so that equal sums are kept in the
  /// same way, and frees memory.
  void trim();

private:
  void setPlaces(int begin, int end);
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
  std::vector<std::size_t> ends; ///< Of each list.
  std::vector<TallyValue> values;

  struct List
  {
    const TallyValue* first;
    const TallyValue* last;

    const TallyValue* begin() const { return first; }
    const TallyValue* end() const { return last; }
    /// The key that most points have, of several the smallest.
    std::int64_t mostFrequent() const;
    /// That of the middle one of @p count points.
    std::int64_t middle(std::int64_t count) const;
  };
  void append(const TallyValues& from, std::size_t begin, std::size_t end);
  /// Adds to the last lists, as many as a voxel has, @p sign times those from @p begin on. @return false
  /// where that leaves fewer than no points with a value.
  bool addToLast(const TallyValues& from, std::size_t begin, int sign);
  std::size_t beginOf(std::size_t list) const { return list == 0 ? 0 : ends[list - 1]; }
  List operator[](std::size_t list) const
  {
    return { values.data() + beginOf(list), values.data() + ends[list] };
  }
};

/// Of an array that is summed the sums, of one whose most frequent or middle values are wanted the values.
/// The other of the two has no components.
class VoxelTally
{
public:
  TallySums sums;
  TallyValues values;

  /// Appends voxels @p first to before @p last of another one like this; one without voxels becomes like it.
  void append(const VoxelTally& from, std::size_t first, std::size_t last);
  /// Adds @p sign times what a voxel of another has to the last one. @return false where that leaves fewer
  /// than no points with a value.
  bool addToLast(const VoxelTally& from, std::size_t voxel, int sign);
  /// Writes the tuples of voxels @p first to before @p last, of @p counts points each; vectors turned by @p
  /// columns.
  void write(const AccumulatedArray& kind, std::size_t first, std::size_t last, const std::int64_t* counts,
    const std::array<Vec3, 3>& columns, void* tuples) const;
  /// Whether tuples of @p count points can have made what a voxel has.
  bool isOf(const AccumulatedArray& kind, std::size_t voxel, std::int64_t count) const;
  /// Frees memory that is not used. Equal tallies are then kept in the same way.
  void trim();
  std::size_t bytes() const;
};

} // namespace simd
} // namespace pointhaptics
