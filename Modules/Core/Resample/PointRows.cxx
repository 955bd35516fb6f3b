#include "Core/Resample/PointRows.h"

#include "Core/Resample/Kernel/Fetch.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace pointhaptics
{
namespace
{

/// Far enough that a line comes in time, near enough that it is still there.
constexpr std::size_t kBytesAhead = 128;

/// The largest power of two that divides a size, at most that of the largest number.
std::size_t alignmentOf(std::size_t bytes)
{
  return std::clamp<std::size_t>(bytes & ~(bytes - 1), 1, sizeof(double));
}

std::size_t roundedUp(std::size_t bytes, std::size_t alignment)
{
  return (bytes + alignment - 1) / alignment * alignment;
}

/// @tparam Bytes of a tuple, if the compiler is to know.
template <std::size_t Bytes>
void copyTuples(const TupleSource& source, const std::int64_t* points, const std::uint32_t* slots, int count,
  char* to, std::size_t rowBytes)
{
  const auto* from = static_cast<const char*>(source.values);
  const std::size_t bytes = Bytes > 0 ? Bytes : source.bytes;
  const std::size_t step = source.step();
  for (int i = 0; i < count; ++i)
  {
    std::memcpy(to + rowBytes * slots[i], from + step * std::size_t(points[i]), bytes);
  }
}

void copyNumbers(
  const std::int64_t* points, const std::uint32_t* slots, int count, char* to, std::size_t rowBytes)
{
  for (int i = 0; i < count; ++i)
  {
    std::memcpy(to + rowBytes * slots[i], points + i, sizeof *points);
  }
}

using Copy = void (*)(const TupleSource&, const std::int64_t*, const std::uint32_t*, int, char*, std::size_t);

template <std::size_t... Bytes>
Copy copyAmong(std::index_sequence<Bytes...> /*known*/, std::size_t bytes)
{
  Copy copy = &copyTuples<0>;
  static_cast<void>(((bytes == Bytes && (copy = &copyTuples<Bytes>)) || ...));
  return copy;
}

Copy copyFor(std::size_t bytes)
{
  // One to four numbers of all types.
  return copyAmong(std::index_sequence<1, 2, 3, 4, 6, 8, 12, 16, 24, 32>(), bytes);
}

}

void RowLayout::choose(const std::vector<TupleSource>& sources)
{
  sources_ = sources;
  offsets_.clear();
  bytes_ = 0;
  std::size_t alignment = 1;
  for (const TupleSource& source : sources)
  {
    const std::size_t ours = alignmentOf(source.bytes);
    alignment = std::max(alignment, ours);
    offsets_.push_back(roundedUp(bytes_, ours));
    bytes_ = offsets_.back() + source.bytes;
  }
  bytes_ = roundedUp(bytes_, alignment);
}

void RowLayout::copy(const std::int64_t* points, const std::uint32_t* slots, int count, char* rows) const
{
  // Points in the order of their memory need no fetching.
  const bool areScattered = count > 0 && points[count - 1] - points[0] != count - 1;
  for (const TupleSource& source : sources_)
  {
    const auto* from = static_cast<const char*>(source.values);
    for (int i = 0; areScattered && from && i < count; ++i)
    {
      const char* tuple = from + source.step() * std::size_t(points[i]);
      simd::fetch(tuple);
      simd::fetch(tuple + source.bytes - 1);
    }
  }
  for (std::size_t s = 0; s < sources_.size(); ++s)
  {
    char* to = rows + offsets_[s];
    if (sources_[s].values)
    {
      copyFor(sources_[s].bytes)(sources_[s], points, slots, count, to, bytes_);
    }
    else
    {
      copyNumbers(points, slots, count, to, bytes_);
    }
  }
}

void RowLayout::bin(const std::int64_t* points, const std::uint32_t* slots, int count, char* rows) const
{
  // Where the rows of points to come go: after this one's.
  for (int i = 0; i < count; ++i)
  {
    simd::fetchToWrite(rows + binnedBytes() * slots[i] + kBytesAhead);
  }
  areGathered() ? copyNumbers(points, slots, count, rows, binnedBytes()) : copy(points, slots, count, rows);
}

} // namespace pointhaptics
