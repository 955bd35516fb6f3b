#include "IO/E57/Crc32c.h"

#include "Bytes/LittleEndian.h"

#include <array>

namespace pointhaptics::io
{

namespace
{

constexpr std::uint32_t kReflectedPolynomial = 0x82f63b78;
constexpr std::size_t kSlices = 8;

using Tables = std::array<std::array<std::uint32_t, 256>, kSlices>;

/// tables[k][b]: what byte b adds to the checksum when k more bytes follow it.
constexpr Tables makeTables()
{
  Tables tables{};
  for (std::uint32_t byte = 0; byte < 256; ++byte)
  {
    std::uint32_t crc = byte;
    for (int bit = 0; bit < 8; ++bit)
    {
      crc = crc & 1 ? crc >> 1 ^ kReflectedPolynomial : crc >> 1;
    }
    tables[0][byte] = crc;
  }
  for (std::size_t slice = 1; slice < kSlices; ++slice)
  {
    for (std::size_t byte = 0; byte < 256; ++byte)
    {
      const std::uint32_t before = tables[slice - 1][byte];
      tables[slice][byte] = before >> 8 ^ tables[0][before & 0xff];
    }
  }
  return tables;
}

constexpr Tables kTables = makeTables();

} // namespace

std::uint32_t crc32c(const char* bytes, std::size_t size) noexcept
{
  std::uint32_t crc = ~std::uint32_t{ 0 };
  // Eight bytes at once: one table each, none of which waits for another.
  for (; size >= kSlices; size -= kSlices, bytes += kSlices)
  {
    const std::uint64_t eight = loadLittle<std::uint64_t>(bytes) ^ crc;
    crc = 0;
    for (std::size_t i = 0; i < kSlices; ++i)
    {
      crc ^= kTables[kSlices - 1 - i][eight >> 8 * i & 0xff];
    }
  }
  for (; size > 0; --size, ++bytes)
  {
    crc = crc >> 8 ^ kTables[0][(crc ^ static_cast<unsigned char>(*bytes)) & 0xff];
  }
  return ~crc;
}

} // namespace pointhaptics::io
