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

/// Gathers rows from the caller's arrays, a block at a time.
class RowCollector
{
public:
  explicit RowCollector(const RowLayout& layout)
    : layout_(layout)
  {
    std::iota(slots_, slots_ + kBlockRecords, 0);
  }
  /// Those of at most kBlockRecords points, until the next call.
  PointRows collect(const std::int64_t* points, int count)
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

/// Reads rows that are binned whole, or whose point numbers are.
class RowReader
{
public:
  RowReader(const RowLayout& rows, const RowLayout& binned)
    : rows_(rows)
    , collector_(rows)
    , areWhole_(rows.bytes() == binned.bytes())
  {
  }
  /// Of a block of records, until the next call.
  PointRows read(const char* binned, int count)
  {
    return areWhole_ ? PointRows{ binned, rows_.bytes(), rows_.offsets() }
                     : collector_.collect(reinterpret_cast<const std::int64_t*>(binned), count);
  }

private:
  const RowLayout& rows_;
  RowCollector collector_;
  bool areWhole_;
};

} // namespace simd
} // namespace pointhaptics
