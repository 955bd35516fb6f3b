/// @file
/// Sums or values of an array in voxels, to which more can be added, or from which some can be taken. They
/// depend on the tuples alone, not on their order or on how they came.
#pragma once

#include "Core/Base/Buffer.h"
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

/// Adds @p sign times a number of @p count words to a sum of @p size words, shifted left by so many bits, or
/// right where that loses no bit. @return false where the sum has no room for the result: its sign is wrong.
bool addShifted(const std::uint64_t* number, int count, int shift, int sign, std::uint64_t* sum, int size);

/// Voxels of one run or two, in groups of which each becomes one.
struct VoxelGroups
{
  struct Voxel
  {
    int run;
    std::size_t number;
  };
  std::vector<Voxel> voxels;
  std::vector<std::size_t> ends; ///< End of each group among these.
  int sign = 1;                  ///< -1: those of the second run are taken away.

  /// Calls visit(group, voxel, sign) for all of them.
  template <typename Visit>
  void forAll(const Visit& visit) const
  {
    for (std::size_t group = 0, i = 0; group < ends.size(); ++group)
    {
      for (; i < ends[group]; ++i)
      {
        visit(group, voxels[i], voxels[i].run == 0 ? 1 : sign);
      }
    }
  }
};

/// Sums of numbers, one for each component of each voxel: integers in units of 2^unit, in two's complement.
/// All have as many words. Memory: 8 bytes a word, of which most arrays have one.
class TallySums
{
public:
  int components = 0;
  int unit = 0;
  int words = 0; ///< Words of a sum; 0 before there are any.
  std::size_t size = 0;
  PageVector<std::uint64_t> values;      ///< [voxel][component][word], the lowest word first.
  std::vector<NonFiniteCount> nonFinite; ///< [voxel][component], where there are any.

  /// Sums of doubles need no smaller unit, and no more words.
  static constexpr int kLeastUnit = -1200;
  static constexpr int kMostWords = 40;

  std::uint64_t* at(std::size_t sum) { return values.data() + sum * std::size_t(words); }
  const std::uint64_t* at(std::size_t sum) const { return values.data() + sum * std::size_t(words); }
  /// Appends the sums from @p begin to before @p end of others.
  void append(const TallySums& from, std::size_t begin, std::size_t end);
  /// Gathers the sums of groups of the voxels of two tallies; one that is null has none. @p isRight becomes
  /// false where fewer than no numbers are left that are not finite.
  static TallySums gathered(
    const TallySums* first, const TallySums* second, const VoxelGroups& groups, bool& isRight);
  /// The mean of @p count numbers; the sum is rounded once.
  double mean(std::size_t sum, std::int64_t count) const;
  /// @pre it has up to two words.
  Int128 inUnits(std::size_t sum) const;
  /// Writes the means of voxels @p first to before @p last, of @p counts numbers each; vectors turned by @p
  /// columns.
  void write(const AccumulatedArray& kind, std::size_t first, std::size_t last, const std::int64_t* counts,
    const std::array<Vec3, 3>& columns, void* tuples) const;
  /// Takes the largest unit and the fewest words, so that equal sums are kept in the same way, and frees
  /// memory.
  void trim();

private:
  bool add(std::size_t sum, const TallySums& from, std::size_t other, int sign);
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
  PageVector<std::size_t> ends; ///< End of each list.
  PageVector<TallyValue> values;

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
  /// As of TallySums: points with a value.
  static TallyValues gathered(
    const TallyValues* first, const TallyValues* second, const VoxelGroups& groups, bool& isRight);
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

  /// Appends voxels @p first to before @p last of another one like this; one without voxels becomes like it.
  void append(const VoxelTally& from, std::size_t first, std::size_t last);
  /// As of TallySums.
  static VoxelTally gathered(
    const VoxelTally* first, const VoxelTally* second, const VoxelGroups& groups, bool& isRight);
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
