/// @file
/// Compression of the points in a LAZ file: LASzip's variable length record. Source: LAZ Specification 1.4
/// R1.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace pointhaptics::io
{

struct LasHeader;

/// The items of a record: what lies where, and in which version it is coded; offset 0: there is none.
struct LazSchema
{
  enum class Compressor
  {
    Pointwise = 1, ///< one run without chunks, of the first versions
    Chunked = 2,
    Layered = 3,
  };
  struct Item
  {
    std::size_t offset = 0;
    int version = 0;
  };

  Compressor compressor = Compressor::Chunked;
  std::uint32_t chunkSize = 50000; ///< points; kVariableChunks: the table of chunks says
  int pointFormat = 0;
  std::size_t recordLength = 0;
  Item point;   ///< at 0
  Item gpsTime; ///< of pointwise files
  Item color;
  Item nearInfrared;
  Item wavePacket;
  Item extraBytes;

  bool isChunkSizeTold = true; ///< Else chunks vary, or have the usual size; their table decides.

  static constexpr std::uint32_t kVariableChunks = 0xffffffffu;
  bool isLayered() const { return compressor == Compressor::Layered; }
  /// Number of bytes after the fixed fields of a record.
  std::size_t numberOfExtraBytes() const
  {
    return extraBytes.offset != 0 ? recordLength - extraBytes.offset : 0;
  }
  /// Layers of a chunk of a layered file, in their order.
  std::size_t numberOfLayers() const;
};

/// Reads LASzip's record in @p bytes for the points that @p header describes. Its items must be those of the
/// point format, each once. @throws FileProblem with byte offset and value; versions of items that are not
/// known are refused with their number.
LazSchema parseLazSchema(std::string_view bytes, const LasHeader& header);

/// Schema for a file of this point format and record length.
LazSchema makeLazSchema(int pointFormat, std::size_t recordLength);

/// The content of LASzip's record for @p schema.
std::string lazRecord(const LazSchema& schema);

} // namespace pointhaptics::io
