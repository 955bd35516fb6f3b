#include "IO/Las/Laz/LazChunks.h"

#include "Bytes/DisjointRanges.h"
#include "FileProblem.h"
#include "IO/Las/LasHeader.h"
#include "ReadTask.h"

#include <array>
#include <cmath>
#include <map>

namespace pointhaptics::io
{

namespace
{

constexpr std::size_t kInfoAt = 375 + kLasVlrHeader; ///< the specification says where
constexpr std::size_t kInfoSize = 160;
constexpr std::size_t kEntrySize = 32;
constexpr int kMostLevel = 30; ///< cells of a level are counted by 32 bits

/// One line of a page: a node, or with count -1 the page of all that is below it.
struct Entry
{
  int level = 0;
  std::array<std::int32_t, 3> cell{};
  std::uint64_t offset = 0;
  std::int32_t size = 0;
  std::int32_t count = 0;
};

/// Walks the hierarchy of one file; one object per file.
class Hierarchy
{
public:
  Hierarchy(const ReadTask& task, const LasHeader& header)
    : task_(task)
    , header_(header)
  {
  }
  LazChunks find();

private:
  void readInfo();
  void readPage(std::uint64_t offset, std::uint64_t size);
  void readEntry(std::size_t at);
  bool isWanted(const Entry& entry) const;
  void take(std::uint64_t offset, std::uint64_t size, std::size_t at, const char* what);
  int lastLevelFor(std::uint64_t mostPoints) const;

  const ReadTask& task_;
  const LasHeader& header_;
  std::array<double, 3> origin_{};
  double side_ = 0.0; ///< of the root's cube
  int lastLevel_ = kMostLevel;
  DisjointRanges pages_;                                         ///< that were found, read or not
  DisjointRanges nodes_;                                         ///< that are wanted
  std::vector<std::pair<std::uint64_t, std::uint64_t>> pending_; ///< pages to read
  /// A wanted node; its chunk has no number yet.
  struct Node
  {
    int level;
    LazChunk chunk;
  };
  std::map<std::uint64_t, Node> found_; ///< by their offsets
};

void Hierarchy::readInfo()
{
  const std::string_view bytes = task_.bytes;
  const bool isHere = header_.headerSize == kLasHeaderOf14 && header_.pointsOffset >= kInfoAt + kInfoSize &&
    bytes.substr(377, 4) == "copc" && numberAt<std::uint16_t>(task_.bytes, 393) == 1;
  failDamagedIf(!isHere, 375, "the first variable length record does not describe the octree");
  const double half = numberAt<double>(task_.bytes, kInfoAt + 24);
  const double spacing = numberAt<double>(task_.bytes, kInfoAt + 32);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    origin_[axis] = numberAt<double>(task_.bytes, kInfoAt + 8 * axis) - half;
  }
  side_ = 2.0 * half;
  failDamagedIf(!std::isfinite(origin_[0] + origin_[1] + origin_[2] + side_) || !(half > 0.0) ||
      !(spacing > 0.0) || !std::isfinite(spacing),
    kInfoAt, "an octree of half size {:f} and spacing {:f}", half, spacing);
  if (task_.wanted.resolution > 0.0)
  {
    lastLevel_ = 0;
    for (double finer = spacing; finer > task_.wanted.resolution && lastLevel_ < kMostLevel; finer /= 2.0)
    {
      ++lastLevel_;
    }
  }
  pending_.emplace_back(
    numberAt<std::uint64_t>(task_.bytes, kInfoAt + 40), numberAt<std::uint64_t>(task_.bytes, kInfoAt + 48));
  take(pending_[0].first, pending_[0].second, kInfoAt + 40, "page");
}

/// Notes that a page or node lies at @p offset. @p at: of the entry that says so.
void Hierarchy::take(std::uint64_t offset, std::uint64_t size, std::size_t at, const char* what)
{
  const std::string shown = fmt::format("a {} of {} bytes at byte {}", what, size, offset);
  failDamagedIf(size == 0 || offset < kInfoAt + kInfoSize || offset > task_.bytes.size() ||
      size > task_.bytes.size() - offset,
    at, "{}, which is outside the file's {}", shown, task_.bytes.size());
  failDamagedIf(
    !(*what == 'p' ? pages_ : nodes_).add(offset, offset + size), at, "{} overlaps another", shown);
}

bool Hierarchy::isWanted(const Entry& entry) const
{
  if (entry.level > lastLevel_)
  {
    return false;
  }
  const double side = std::ldexp(side_, -entry.level);
  for (std::size_t axis = 0; axis < 3 && task_.wanted.hasBox(); ++axis)
  {
    // Points at the edge of a cell are rounded to the file's grid.
    const double slack = std::abs(header_.scale[axis]);
    const double low = origin_[axis] + side * entry.cell[axis];
    if (task_.wanted.box[2 * axis] > low + side + slack || task_.wanted.box[2 * axis + 1] < low - slack)
    {
      return false;
    }
  }
  return true;
}

void Hierarchy::readEntry(std::size_t at)
{
  Entry entry;
  entry.level = numberAt<std::int32_t>(task_.bytes, at);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    entry.cell[axis] = numberAt<std::int32_t>(task_.bytes, at + 4 + 4 * axis);
    failDamagedIf(entry.level < 0 || entry.level > kMostLevel || entry.cell[axis] < 0 ||
        entry.cell[axis] >> entry.level != 0,
      at, "cell {} of level {}", entry.cell[axis], entry.level);
  }
  entry.offset = numberAt<std::uint64_t>(task_.bytes, at + 16);
  entry.size = numberAt<std::int32_t>(task_.bytes, at + 24);
  entry.count = numberAt<std::int32_t>(task_.bytes, at + 28);
  failDamagedIf(
    entry.count < -1 || entry.size < 0, at, "a node of {} points in {} bytes", entry.count, entry.size);
  if (entry.count == 0 || !isWanted(entry))
  {
    return;
  }
  const std::uint64_t size = static_cast<std::uint64_t>(entry.size);
  take(entry.offset, size, at, entry.count < 0 ? "page" : "node");
  if (entry.count < 0)
  {
    pending_.emplace_back(entry.offset, size);
    return;
  }
  found_.emplace(entry.offset,
    Node{ entry.level,
      { static_cast<std::size_t>(entry.offset), static_cast<std::size_t>(size), 0,
        static_cast<std::uint64_t>(entry.count) } });
}

void Hierarchy::readPage(std::uint64_t offset, std::uint64_t size)
{
  task_.need(static_cast<std::size_t>(offset), static_cast<std::size_t>(size));
  for (std::size_t at = 0; at + kEntrySize <= size; at += kEntrySize)
  {
    readEntry(static_cast<std::size_t>(offset) + at);
  }
}

/// The finest level down to which there are no more points; the coarsest one that has any at least.
int Hierarchy::lastLevelFor(std::uint64_t mostPoints) const
{
  std::array<std::uint64_t, kMostLevel + 1> counts{};
  for (const auto& [start, node] : found_)
  {
    counts[static_cast<std::size_t>(node.level)] += node.chunk.count;
  }
  std::uint64_t sum = 0;
  for (int level = 0; level <= kMostLevel; ++level)
  {
    const bool hasCoarser = sum > 0;
    sum += counts[static_cast<std::size_t>(level)];
    if (sum > mostPoints)
    {
      return hasCoarser ? level - 1 : level;
    }
  }
  return kMostLevel;
}

LazChunks Hierarchy::find()
{
  readInfo();
  while (!pending_.empty())
  {
    const auto page = pending_.back();
    pending_.pop_back();
    readPage(page.first, page.second);
  }
  const std::uint64_t most = task_.wanted.mostPoints;
  const int lastLevel = most > 0 ? lastLevelFor(most) : kMostLevel;
  LazChunks chunks;
  std::uint64_t sum = 0;
  for (auto& [start, node] : found_)
  {
    sum += node.chunk.count;
    node.chunk.first = chunks.points();
    node.level > lastLevel ? void(chunks.isCoarse = true) : chunks.all.push_back(node.chunk);
  }
  failDamagedIf(sum > header_.count, kInfoAt + 40, "the nodes hold {} points, but the header counts {}", sum,
    header_.count);
  return chunks;
}

} // namespace

LazChunks findCopcChunks(const ReadTask& task, const LasHeader& header)
{
  return Hierarchy(task, header).find();
}

} // namespace pointhaptics::io
