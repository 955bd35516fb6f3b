/// @file
/// The compression records of a LAZ file, checked before LASzip uses them.
#pragma once

#include <cstddef>
#include <string_view>

namespace pointhaptics::io
{

struct LasHeader;

/// Points may unpack to this many times the file's size, or to kLazFloor where that is more: real clouds stay
/// far below, and memory for the sizes in a header stays in proportion to the file.
constexpr std::size_t kMostLazRatio = 100;
constexpr std::size_t kLazFloor = std::size_t{ 1 } << 26;

/// Checks against the size of the file: the variable length records (LASzip takes memory for as many as the
/// header counts), the one of them that describes the compression (its items must be those of the point
/// format, each once), place and size of the table of chunks, and the number of points. LASzip itself checks
/// only whether the compressed data are sound. Layouts: LAZ Specification 1.4 R1.
/// @throws FileProblem with byte offset and value.
void checkLazLayout(std::string_view bytes, const LasHeader& header);

} // namespace pointhaptics::io
