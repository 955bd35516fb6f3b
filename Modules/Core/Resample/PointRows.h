/// @file
/// What goes with points on their way to their voxels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pointhaptics
{

/// Something each point has: of point i the @p bytes from @p values + i bytes on. Null: the point's number,
/// as a std::int64_t, which is 8 bytes.
struct TupleSource
{
  const void* values = nullptr;
  std::size_t bytes = sizeof(std::int64_t);
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
  /// Writes rows of points: that of @p points[i] to rows + bytes() places[i]. Several threads may at once.
  void copy(const std::int64_t* points, const std::uint32_t* places, int count, char* rows) const;

private:
  std::vector<TupleSource> sources_;
  std::vector<std::size_t> offsets_;
  std::size_t bytes_ = 0;
};

/// Rows one after the other, as VoxelResampler::assign() hands them out.
struct PointRows
{
  const char* first = nullptr;
  std::size_t bytes = 0; ///< Of a row.
  const std::size_t* offsets = nullptr;

  /// The first row's tuple of a source; that of the next row is @p bytes further.
  const void* tuples(std::size_t source) const { return first + offsets[source]; }
};

} // namespace pointhaptics
