/// @file
/// Where the chunks of a LAZ file lie: its table of chunks, or what can be had without it. Source: LAZ
/// Specification 1.4 R1.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace pointhaptics::io
{

struct LasHeader;
struct LazSchema;
struct ReadTask;

/// Points that are compressed together, apart from all others.
struct LazChunk
{
  std::size_t offset = 0;  ///< in the file
  std::size_t size = 0;    ///< bytes; of one without a table: those up to the end of the file
  std::uint64_t first = 0; ///< number of its first point
  std::uint64_t count = 0;
};

struct LazChunks
{
  std::vector<LazChunk> all;
  /// False of a pointwise file without a table: each chunk begins where the one before ends, which only
  /// decoding it shows. Then the offset of the first chunk alone is set.
  bool arePlaced = true;
  bool isCoarse = false; ///< WantedPart::mostPoints left out chunks

  std::uint64_t points() const { return all.empty() ? 0 : all.back().first + all.back().count; }
};

/// Points may unpack to this many times the file's size, or to kLazFloor where that is more: real clouds stay
/// far below, and memory for the sizes in a header stays in proportion to the file.
constexpr std::size_t kMostLazRatio = 100;
constexpr std::size_t kLazFloor = std::size_t{ 1 } << 26;

/// The chunks of all points that @p header counts, each inside the file. @throws FileProblem with byte offset
/// and value where table, sizes or counts cannot be true. Bytes are loaded before they are looked at, and
/// where @p task salvages its endAt() decides what is done where the chunks hold fewer points.
LazChunks findLazChunks(ReadTask& task, const LasHeader& header, const LazSchema& schema);

/// @throws FileProblem where @p header counts more points than a file of its size is expected to hold.
void checkLazCount(std::string_view bytes, const LasHeader& header);

/// The table of chunks with @p chunks, which lie one behind the other in a file of @p schema.
std::string lazChunkTable(const std::vector<LazChunk>& chunks, const LazSchema& schema);

/// COPC Specification 1.0 (copc.io): chunks are the nodes of an octree, and pages list them. The chunks of
/// the nodes that touch the box of task.wanted and whose level is needed for its resolution, in the order of
/// the file, numbered from 0. Reads only the pages of the hierarchy that list such nodes (ReadTask::load).
/// The root has the points of the coarsest level; each level halves the distance between points, and the
/// points of all levels down to one make up the cloud at its resolution. Where they are more than
/// task.wanted.mostPoints, the finest levels are left out; the coarsest one that has points stays.
/// @throws FileProblem with byte offset and value where pages or nodes lie outside the file, in one another,
/// or lead in a circle, and where there are more points than @p header counts.
LazChunks findCopcChunks(const ReadTask& task, const LasHeader& header);

} // namespace pointhaptics::io
