/// @file
/// What an array has in voxels, in a form that any more can be added to, or taken from.
#pragma once

#include "Core/Base/Vector3.h"
#include "Core/Resample/AttributeView.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pointhaptics
{
namespace simd
{

/// So many of something.
struct TallyEntry
{
  std::uint64_t key;
  std::int64_t amount;
};

/// Of each component of each voxel a list of entries, in ascending order of their keys, none of amount 0. It
/// depends on the tuples alone, not on their order or on how they came.
///
/// Of a sum they are its digits, of 32 bits and from -2^31 to below 2^31: an exact number, whatever the
/// magnitudes of other arrays of the kind were; and how many numbers were not finite. Of values of which the
/// most frequent or the middle one is wanted: each value, with how many points have it. Memory: 8 bytes a
/// list, 16 an entry; sums of most arrays have one or two.
class VoxelTally
{
public:
  VoxelTally() = default;
  explicit VoxelTally(const AccumulatedArray& kind)
    : kind_(kind)
  {
  }
  const AccumulatedArray& kind() const { return kind_; }
  /// What it is written as. @pre sums stay sums, others are of values of the same type.
  void setKind(const AccumulatedArray& kind) { kind_ = kind; }
  std::size_t voxels() const { return ends_.size() / std::size_t(kind_.components); }

  /// Appends a list. Those of a voxel come one after the other.
  void push(const std::vector<TallyEntry>& list);
  /// Appends voxels @p first to before @p last of another of this kind.
  void append(const VoxelTally& from, std::size_t first, std::size_t last);
  /// Adds @p sign times what a voxel of another has to the last one. @return false where that leaves fewer
  /// than no points with a value.
  bool addToLast(const VoxelTally& from, std::size_t voxel, int sign = 1);
  /// Writes the tuples of voxels @p first to before @p last, of @p counts points each, where those of the
  /// first belong; vectors turned by @p columns.
  void write(std::size_t first, std::size_t last, const std::int64_t* counts,
    const std::array<Vec3, 3>& columns, void* tuples) const;
  /// Whether tuples of @p count points can have made the lists of a voxel.
  bool isOf(std::size_t voxel, std::int64_t count) const;

  struct List
  {
    const TallyEntry* first;
    const TallyEntry* last;

    const TallyEntry* begin() const { return first; }
    const TallyEntry* end() const { return last; }
  };
  List list(std::size_t voxel, int component) const;
  std::size_t entries() const { return entries_.size(); }
  std::size_t bytes() const
  {
    return ends_.capacity() * sizeof(std::size_t) + entries_.capacity() * sizeof(TallyEntry);
  }

private:
  template <typename T>
  bool isListOf(List list, std::int64_t count) const;
  template <typename T>
  void writeTuple(std::size_t voxel, std::int64_t count, const std::array<Vec3, 3>& columns, T* to) const;

  AccumulatedArray kind_;
  std::vector<std::size_t> ends_; ///< Of each list among the entries.
  std::vector<TallyEntry> entries_;
  std::vector<TallyEntry> joined_; ///< Scratch of addToLast().
};

/// Makes the list of a sum from integers times powers of two, and from numbers that are not finite.
class TallySum
{
public:
  /// @pre the least bit and the sum have exponents of doubles, or 64 less or more.
  void add(std::int64_t value, int exponent);
  /// @pre integers come before.
  void addNonFinite(std::int64_t nans, std::int64_t plus, std::int64_t minus);
  /// Appends the list to a tally; it is that of 0 afterwards.
  void moveTo(VoxelTally& tally);

private:
  std::vector<TallyEntry> list_; ///< Of the sum so far.
  std::vector<TallyEntry> more_; ///< Scratch: of the next integer, and of both.
  std::vector<TallyEntry> both_;
};

/// A key for each value, in the order of orderedKey().
template <typename T>
std::uint64_t tallyKeyOf(T ordered)
{
  constexpr std::uint64_t kTop = std::uint64_t(1) << 63;
  return std::is_signed_v<T> ? std::uint64_t(std::int64_t(ordered)) ^ kTop : std::uint64_t(ordered);
}
template <typename T>
T orderedOfTallyKey(std::uint64_t key)
{
  constexpr std::uint64_t kTop = std::uint64_t(1) << 63;
  return std::is_signed_v<T> ? T(std::int64_t(key ^ kTop)) : T(key);
}

} // namespace simd
} // namespace pointhaptics
