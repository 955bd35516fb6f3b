#include "IO/E57/E57Pages.h"

#include "Bytes/LittleEndian.h"
#include "ReadTask.h"

#include "vtkSMPTools.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace pointhaptics::io
{

namespace
{

/// CRC-32C (Castagnoli: polynomial 0x1EDC6F41, bits reflected, all ones before and after) of @p size bytes.
/// Any thread. Source: RFC 3720, appendix B.4.
std::uint32_t crc32c(const char* bytes, std::size_t size) noexcept;

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

constexpr const char* kDamaged = "the file is damaged: copy or write it again";
/// Pages between two reports of progress: 16 MB.
constexpr std::size_t kPagesPerReport = 16384;

/// Stored with the most significant byte first, unlike all other numbers of the file.
std::uint32_t storedChecksum(const char* page)
{
  std::uint32_t value = 0;
  for (std::size_t i = E57Pages::kContent; i < E57Pages::kPage; ++i)
  {
    value = value << 8 | static_cast<unsigned char>(page[i]);
  }
  return value;
}

} // namespace

E57Pages::E57Pages(std::string_view bytes)
{
  if (bytes.size() < kPage)
  {
    failTruncated("the file ends at byte " + std::to_string(bytes.size()) + " inside its first page of " +
      std::to_string(kPage) + " bytes");
  }
  const char* header = bytes.data();
  major_ = loadLittle<std::uint32_t>(header + 8);
  minor_ = loadLittle<std::uint32_t>(header + 12);
  const std::uint64_t length = loadLittle<std::uint64_t>(header + 16);
  const std::uint64_t xml = loadLittle<std::uint64_t>(header + 24);
  xmlLength_ = loadLittle<std::uint64_t>(header + 32);
  const std::uint64_t page = loadLittle<std::uint64_t>(header + 40);
  if (major_ != 1)
  {
    failFormat(
      "byte 8: version " + version() + ", but 1.0 is read here", "export it as E57 1.0 (ASTM E2807)");
  }
  if (page != kPage)
  {
    failFormat(
      "byte 40: pages of " + std::to_string(page) + " bytes, but E57 has " + std::to_string(kPage), kDamaged);
  }
  if (length > bytes.size())
  {
    failTruncated("byte 16: the header says " + std::to_string(length) + " bytes, but the file has " +
      std::to_string(bytes.size()));
  }
  if (length < kPage || length % kPage != 0)
  {
    failFormat(
      "byte 16: a length of " + std::to_string(length) + " bytes, which are no whole pages", kDamaged);
  }
  bytes_ = bytes.substr(0, length);
  xmlOffset_ = logical(xml, "byte 24: the XML section");
  if (xmlLength_ > size() - xmlOffset_)
  {
    failTruncated("byte 32: an XML section of " + std::to_string(xmlLength_) + " bytes, but only " +
      std::to_string(size() - xmlOffset_) + " follow byte " + std::to_string(xml));
  }
}

void E57Pages::check(const ReadTask& task, double part) const
{
  const std::size_t pages = bytes_.size() / kPage;
  for (std::size_t begin = 0; begin < pages; begin += kPagesPerReport)
  {
    const std::size_t end = std::min(begin + kPagesPerReport, pages);
    std::atomic<std::size_t> firstWrong{ pages };
    vtkSMPTools::For(static_cast<vtkIdType>(begin), static_cast<vtkIdType>(end), 256,
      [&](vtkIdType from, vtkIdType to)
      {
        for (std::size_t i = static_cast<std::size_t>(from); i < static_cast<std::size_t>(to); ++i)
        {
          const char* page = bytes_.data() + i * kPage;
          if (crc32c(page, kContent) != storedChecksum(page))
          {
            std::size_t known = firstWrong;
            while (i < known && !firstWrong.compare_exchange_weak(known, i))
            {
            }
            return;
          }
        }
      });
    if (firstWrong < pages)
    {
      failFormat("byte " + std::to_string(firstWrong * kPage) + ": page " + std::to_string(firstWrong + 1) +
          " of " + std::to_string(pages) + " does not have the content of its checksum (CRC-32C)",
        kDamaged);
    }
    task.progress(part * static_cast<double>(end) / static_cast<double>(pages));
  }
}

std::string E57Pages::version() const
{
  return std::to_string(major_) + "." + std::to_string(minor_);
}

std::uint64_t E57Pages::logical(std::uint64_t physical, const std::string& what) const
{
  if (physical >= bytes_.size() || physical % kPage >= kContent || physical < kFileHeader)
  {
    failFormat(what + " is at byte " + std::to_string(physical) + " of " + std::to_string(bytes_.size()) +
        ", where no content is",
      kDamaged);
  }
  return physical / kPage * kContent + physical % kPage;
}

void E57Pages::copy(std::uint64_t logicalOffset, std::size_t count, char* to) const noexcept
{
  std::uint64_t page = logicalOffset / kContent;
  std::size_t inPage = static_cast<std::size_t>(logicalOffset % kContent);
  while (count > 0)
  {
    const std::size_t part = std::min(count, kContent - inPage);
    std::copy_n(bytes_.data() + page * kPage + inPage, part, to);
    to += part;
    count -= part;
    inPage = 0;
    ++page;
  }
}

} // namespace pointhaptics::io
