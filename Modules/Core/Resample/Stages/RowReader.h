/// @file
/// The rows of records, as those who read them expect them.
#pragma once

#include "Core/Base/Buffer.h"
#include "Core/Resample/Kernel/VoxelKernel.h"
#include "Core/Resample/PointRows.h"

#include <cstdint>
#include <numeric>

namespace pointhaptics
{
namespace simd
{

/// Reads the rows of at most kBlockRecords points at a time, which are valid until the next call.
class RowReader
{
public:
  explicit RowReader(const RowLayout& layout)
    : layout_(layout)
  {
    std::iota(slots_, slots_ + kBlockRecords, 0);
  }
  /// Those of a block of records, from what RowLayout::bin() has written beside them.
  PointRows read(const char* binned, int count)
  {
    return layout_.areGathered() ? gather(reinterpret_cast<const std::int64_t*>(binned), count)
                                 : PointRows{ binned, layout_.bytes(), layout_.offsets() };
  }
  /// Those of points, from the caller's arrays.
  PointRows gather(const std::int64_t* points, int count)
  {
    rows_.reserve(kBlockRecords * layout_.bytes());
    layout_.copy(points, slots_, count, rows_.data());
    return { rows_.data(), layout_.bytes(), layout_.offsets() };
  }

private:
  const RowLayout& layout_;
  std::uint32_t slots_[kBlockRecords];
  Buffer<char> rows_;
};

} // namespace simd
} // namespace pointhaptics
