/// @file
/// Shared by the tests of LAZ: files of any records in every layout that LAZ knows, and their records again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// Bytes of a record of point format 0 to 10 without extra bytes.
constexpr std::size_t kRecordLengths[] = { 20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67 };

/// How a LAZ file says where its chunks are.
enum class LazTable
{
  Behind,   ///< its offset before the points, as writers do that can seek
  AtTheEnd, ///< its offset in the last 8 bytes, as writers of streams do
  Missing,  ///< its writer was interrupted
  NoChunks, ///< of the first versions: one run of points (point formats 0 to 5)
};

struct LazLayout
{
  std::uint32_t chunkSize = 50000; ///< points
  bool isVariable = false;         ///< chunks have 1, 2, 3 ... points, and the table says so
  LazTable table = LazTable::Behind;
};

struct LazFile
{
  std::string bytes;
  std::size_t description = 0; ///< where the content of LASzip's record begins
  std::size_t points = 0;      ///< where the offset of the table of chunks is
  std::size_t table = 0;       ///< where the table of chunks is; 0: there is none
};

/// The LAS 1.4 file of the same point records.
std::string lasOf(int format, std::size_t extra, const std::string& records);
LazFile lazOf(int format, std::size_t extra, const std::string& records, const LazLayout& layout = {});

/// A cloud optimised point cloud of point format 6 with an octree of four levels about 0..1024 on each axis,
/// whose points lie in the cells of their nodes. The root page has nodes of levels 0 and 1; a page of its own
/// lists those of levels 2 and 3.
struct CopcFile
{
  std::string bytes;
  std::string records;      ///< of all points in the file's order
  std::size_t info = 0;     ///< where the content of the octree's record begins
  std::size_t rootPage = 0; ///< 32 bytes an entry
  std::size_t secondPage = 0;
  std::vector<std::size_t> chunks; ///< offsets of the nodes' chunks, in the order of the pages
};
CopcFile makeCopc(std::size_t pointsOfNode = 200);

/// Every bit of every field, but for gps times that are NaN, whose bits need not survive. Neighbours share
/// most bytes where @p calm.
std::string randomRecords(
  int format, std::size_t extra, std::size_t count, std::uint64_t seed, bool calm = false);

/// The records of a LAZ file in the file's order. @throws pointhaptics::io::FileProblem.
std::string recordsOf(const std::string& bytes);

/// SHA-256 of @p bytes as 64 hexadecimal digits (FIPS 180-4).
std::string sha256(const std::string& bytes);
