/// @file
/// The attribute tuples of points, copied into rows that follow the points to their voxels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pointhaptics
{

/// An attribute of each point: @p bytes bytes at @p values + i step() for point i. Null: the point's index,
/// as a std::int64_t, which is 8 bytes.
struct TupleSource
{
  const void* values = nullptr;
  std::size_t bytes = sizeof(std::int64_t);
  std::size_t stride = 0; ///< Bytes from one tuple to the next; 0: none lie between.

  std::size_t step() const { return stride > 0 ? stride : bytes; }
};

/// How the tuples of one point lie in a row. Numbers whose tuple is a power of two times an odd number of
/// bytes are aligned to that power, up to 8, if the rows are aligned to 8.
class RowLayout
{
public:
  /// Copies of what is in @p sources are made while that lives.
  void choose(const std::vector<TupleSource>& sources);
  /// Of a row.
  std::size_t bytes() const { return bytes_; }
  const std::size_t* offsets() const { return offsets_.data(); }
  /// Writes rows of points: that of @p points[i] to rows + bytes() slots[i]. Several threads may at once.
  void copy(const std::int64_t* points, const std::uint32_t* slots, int count, char* rows) const;

  /// Rows so wide that they cost more memory beside the points' records than their locality is worth: the
  /// numbers of the points lie there, and the rows are copied later.
  bool areGathered() const { return bytes_ > kMostBinnedBytes; }
  /// Of what lies beside a record.
  std::size_t binnedBytes() const { return areGathered() ? sizeof(std::int64_t) : bytes_; }
  /// Writes that as copy() writes rows.
  void bin(const std::int64_t* points, const std::uint32_t* slots, int count, char* rows) const;

private:
  static constexpr std::size_t kMostBinnedBytes = 64;

  std::vector<TupleSource> sources_;
  std::vector<std::size_t> offsets_;
  std::size_t bytes_ = 0;
};

/// Rows one after the other, as VoxelResampler::visitPointsByVoxel() passes them on.
struct PointRows
{
  const char* first = nullptr;
  std::size_t bytes = 0; ///< Of a row.
  const std::size_t* offsets = nullptr;

  /// The first row's tuple of a source; that of the next row is @p bytes further.
  const void* tuples(std::size_t source) const { return first + offsets[source]; }
};

} // namespace pointhaptics
