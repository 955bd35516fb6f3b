/// @file
/// Modes and medians of the attributes of points, voxel by voxel.
#pragma once

#include "Core/Base/Buffer.h"
#include "Core/Base/ScalarType.h"
#include "Core/Resample/Reductions/AttributeReducer.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <vector>

namespace pointhaptics
{

/// Turns the order of negative numbers around, and back. Without a branch: signs are unpredictable.
template <typename Key>
Key turnedNegative(Key key)
{
  return Key(key ^ ((key >> (8 * sizeof(Key) - 1)) & std::numeric_limits<Key>::max()));
}

/// Of 64-bit integers without a sign, taken as ones with it.
constexpr std::uint64_t kFirstNegative = std::uint64_t(1) << 63;

/// An integer of at most 63 bits and a sign for each value, in the order of the values. Of floating-point
/// numbers NaN is the largest, and both zeros are one.
template <typename T>
auto orderedKey(T value)
{
  if constexpr (std::is_floating_point_v<T>)
  {
    value = std::isnan(value) ? std::numeric_limits<T>::quiet_NaN() : value + T(0);
    std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t> key;
    std::memcpy(&key, &value, sizeof key);
    return turnedNegative(key);
  }
  else if constexpr (std::is_same_v<T, std::uint64_t>)
  {
    return std::int64_t(value - kFirstNegative);
  }
  else
  {
    return value;
  }
}

/// The value of a key: NaN for all NaNs, +0 for both zeros.
template <typename T>
T valueOfKey(std::int64_t key)
{
  if constexpr (std::is_floating_point_v<T>)
  {
    const auto bits = turnedNegative(decltype(orderedKey(T()))(key));
    T value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }
  else if constexpr (std::is_same_v<T, std::uint64_t>)
  {
    return std::uint64_t(key) + kFirstNegative;
  }
  else
  {
    return T(key);
  }
}

/// Keeps the tuples of the points of each voxel, and finds the mode or the median of each component. Of
/// floating-point numbers all NaNs are one value, the largest, and both zeros are one, which is written as
/// +0; nothing depends on the order of the points.
///
/// Memory: the tuples themselves, and 8 bytes a voxel.
class AttributeTuples : public AttributeReducer
{
public:
  /// @pre @p statistic is Mode or Median
  explicit AttributeTuples(const AttributeView& view, AttributeStatistic statistic = AttributeStatistic::Mode)
    : view_(view)
    , statistic_(statistic)
  {
  }

  void prepare(const std::int64_t* counts, std::int64_t voxels, std::int64_t mostPoints,
    const Executor& executor) override;
  void add(const std::int64_t* points, const std::int64_t* voxels, int count) override;
  simd::VoxelTally takeTally() override;
  /// @pre each voxel has as many tuples as it was said to get.
  bool write(const std::int64_t* counts, void* values, const Executor& executor,
    ProgressObserver* observer) const override;

protected:
  /// Adds a tuple of so many bytes, all of it.
  void addTuple(const void* tuple, std::size_t bytes, std::int64_t voxel)
  {
    const auto i = std::size_t(ends_[std::size_t(voxel)]++);
    std::memcpy(reinterpret_cast<char*>(tuples_.data()) + bytes * i, tuple, bytes);
  }

private:
  std::int64_t voxels() const { return std::int64_t(ends_.size()); }
  /// Of its tuples. @pre all have been added.
  std::int64_t begin(std::int64_t voxel) const { return voxel == 0 ? 0 : ends_[std::size_t(voxel - 1)]; }
  std::int64_t end(std::int64_t voxel) const { return ends_[std::size_t(voxel)]; }
  void makeRoom(std::int64_t tuples);
  template <typename T>
  T* tuple(std::int64_t i) const
  {
    return reinterpret_cast<T*>(tuples_.data()) + view_.components * i;
  }
  template <typename T>
  void tallyValues(simd::TallyValues& to) const;
  template <typename T>
  void writeValues(std::int64_t first, std::int64_t last, T* to) const;

  AttributeView view_;
  AttributeStatistic statistic_;
  Buffer<std::uint64_t> tuples_;   ///< Those of a voxel after each other.
  std::vector<std::int64_t> ends_; ///< Where the next tuple of each voxel goes.
};

} // namespace pointhaptics
