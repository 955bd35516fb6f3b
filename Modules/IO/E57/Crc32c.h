/// @file
/// The checksum of E57's pages.
#pragma once

#include <cstddef>
#include <cstdint>

namespace pointhaptics::io
{

/// CRC-32C (Castagnoli: polynomial 0x1EDC6F41, bits reflected, all ones before and after) of @p size bytes.
/// Any thread. Source: RFC 3720, appendix B.4.
std::uint32_t crc32c(const char* bytes, std::size_t size) noexcept;

} // namespace pointhaptics::io
