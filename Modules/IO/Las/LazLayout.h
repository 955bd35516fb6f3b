/// @file
/// What a LAZ file says of its own compression, checked before LASzip believes it.
#pragma once

#include <cstddef>
#include <string_view>

namespace pointhaptics::io
{

struct LasHeader;

/// Points may unpack to this many times the file's size, or to kLazFloor where that is more: honest clouds
/// stay far below, and the memory for what a header promises stays in proportion to the file.
constexpr std::size_t kMostLazRatio = 100;
constexpr std::size_t kLazFloor = std::size_t{ 1 } << 26;

/// Holds against the file: the variable length records (LASzip takes memory for as many as the header
/// counts), the one of them that describes the compression (its items must be those of the point format, each
/// once), place and size of the table of chunks, and the number of points. What remains for LASzip to find
/// out is whether the compressed data are sound. Layouts: LAZ Specification 1.4 R1.
/// @throws FileProblem with byte offset and value.
void checkLazLayout(std::string_view bytes, const LasHeader& header);

} // namespace pointhaptics::io
