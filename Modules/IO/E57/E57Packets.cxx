#include "IO/E57/E57Packets.h"

#include "Bytes/LittleEndian.h"
#include "FileProblem.h"
#include "ReadTask.h"

#include "vtkSMPTools.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>

namespace pointhaptics::io
{

namespace
{

constexpr const char* kCure = "the file is damaged: copy or write it again";

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
      "byte 40: pages of " + std::to_string(page) + " bytes, but E57 has " + std::to_string(kPage), kCure);
  }
  if (length > bytes.size())
  {
    failTruncated("byte 16: the header says " + std::to_string(length) + " bytes, but the file has " +
      std::to_string(bytes.size()));
  }
  if (length < kPage || length % kPage != 0)
  {
    failFormat("byte 16: a length of " + std::to_string(length) + " bytes, which are no whole pages", kCure);
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
      failFormat(atByte(firstWrong * kPage) + "page " + std::to_string(firstWrong + 1) + " of " +
          std::to_string(pages) + " does not have the content of its checksum (CRC-32C)",
        kCure);
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
      kCure);
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

namespace
{

constexpr std::size_t kSectionHeader = 32;
constexpr std::size_t kPacketHeader = 4;     ///< of any packet: type, flags, length - 1
constexpr std::size_t kDataPacketHeader = 6; ///< and the number of streams
constexpr unsigned kCompressedVectorSection = 1;
constexpr unsigned kIndexPacket = 0;
constexpr unsigned kDataPacket = 1;
constexpr unsigned kEmptyPacket = 2;

std::string atLogical(std::uint64_t logical)
{
  return atByte(E57Pages::physical(logical));
}

} // namespace

E57Packets::E57Packets(const E57Pages& pages, E57Scan& scan, const std::string& where, ReadTask& task)
  : pages_(pages)
  , where_(where)
  , streams_(scan.fields.size())
{
  const std::uint64_t firstPacket = findSection(scan);
  planStreams(scan);
  walk(firstPacket);
  if (unfinished_ > 0)
  {
    endEarly(scan, task);
  }
}

/// @return the logical offset of the first packet.
std::uint64_t E57Packets::findSection(const E57Scan& scan)
{
  begin_ = pages_.logical(scan.fileOffset, where_ + ": the section of its points");
  std::array<char, kSectionHeader> header{};
  if (pages_.size() - begin_ < header.size())
  {
    failTruncated(atLogical(begin_) + "the file ends inside the section of the points of " + where_);
  }
  pages_.copy(begin_, header.size(), header.data());
  const unsigned kind = static_cast<unsigned char>(header[0]);
  const std::uint64_t length = loadLittle<std::uint64_t>(header.data() + 8);
  if (kind != kCompressedVectorSection)
  {
    failFormat(atLogical(begin_) + "a section of kind " + std::to_string(kind) + " where the points of " +
        where_ + " are said to be",
      kCure);
  }
  if (length < kSectionHeader || length > pages_.size() - begin_)
  {
    failTruncated(atLogical(begin_) + "a section of " + std::to_string(length) + " bytes, but only " +
      std::to_string(pages_.size() - begin_) + " follow");
  }
  end_ = begin_ + length;
  const std::uint64_t first =
    pages_.logical(loadLittle<std::uint64_t>(header.data() + 16), where_ + ": its first packet");
  if (first < begin_ + kSectionHeader || first > end_)
  {
    failFormat(atLogical(begin_) + "the first packet of " + where_ + " is at byte " +
        std::to_string(E57Pages::physical(first)) + ", outside of its section",
      kCure);
  }
  return first;
}

void E57Packets::planStreams(const E57Scan& scan)
{
  std::uint64_t bitsOfRecord = 0;
  for (std::size_t i = 0; i < streams_.size(); ++i)
  {
    const std::uint64_t bits = scan.fields[i].bits;
    bitsOfRecord += bits;
    // Records beyond 2^56 are more than any file has, and make no sum here overflow.
    const std::uint64_t records = std::min(scan.records, std::uint64_t{ 1 } << 56);
    streams_[i].needed = bits == 0 ? 0 : (records / 8) * bits + (records % 8 * bits + 7) / 8;
    unfinished_ += streams_[i].needed > 0 ? 1 : 0;
  }
  if (bitsOfRecord == 0 && scan.records > end_ - begin_)
  {
    failFormat(
      where_ + ": " + std::to_string(scan.records) + " points that are all the same by their description",
      kCure);
  }
}

void E57Packets::walk(std::uint64_t at)
{
  while (unfinished_ > 0 && at + kPacketHeader <= end_)
  {
    std::array<char, kPacketHeader> header{};
    pages_.copy(at, header.size(), header.data());
    const unsigned kind = static_cast<unsigned char>(header[0]);
    const std::size_t length = std::size_t{ loadLittle<std::uint16_t>(header.data() + 2) } + 1;
    if (kind > kEmptyPacket)
    {
      failPacket(at, "of kind " + std::to_string(kind) + ", but 0 to 2 are known");
    }
    if (length < kPacketHeader || length % 4 != 0 || length > end_ - at)
    {
      failPacket(at,
        "of " + std::to_string(length) + " bytes, with " + std::to_string(end_ - at) +
          " left in the section");
    }
    static_assert(kIndexPacket == 0 && kDataPacket == 1, "the other kinds are passed over");
    if (kind == kDataPacket)
    {
      addDataPacket(at, length);
    }
    at += length;
  }
}

void E57Packets::addDataPacket(std::uint64_t at, std::size_t length)
{
  std::array<char, 65536> packet;
  const std::size_t streams = streams_.size();
  const std::size_t header = kDataPacketHeader + 2 * streams;
  pages_.copy(at, std::min(header, length), packet.data());
  if (header > length || loadLittle<std::uint16_t>(packet.data() + 4) != streams)
  {
    failPacket(at, "that does not have the " + std::to_string(streams) + " streams of the scan's fields");
  }
  std::size_t inPacket = header;
  for (std::size_t i = 0; i < streams; ++i)
  {
    const std::size_t size = loadLittle<std::uint16_t>(packet.data() + kDataPacketHeader + 2 * i);
    if (size > length - inPacket)
    {
      failPacket(at, "whose streams are longer than its " + std::to_string(length) + " bytes");
    }
    Stream& stream = streams_[i];
    if (size > 0 && stream.size < stream.needed)
    {
      stream.parts.push_back({ stream.size, at + inPacket });
      stream.size += size;
      unfinished_ -= stream.size >= stream.needed ? 1 : 0;
    }
    inPacket += size;
  }
}

void E57Packets::failPacket(std::uint64_t at, const std::string& fault) const
{
  failFormat(atLogical(at) + where_ + ": a packet " + fault, kCure);
}

void E57Packets::endEarly(E57Scan& scan, ReadTask& task) const
{
  std::uint64_t there = scan.records;
  std::string what;
  for (std::size_t i = 0; i < streams_.size(); ++i)
  {
    if (streams_[i].size < streams_[i].needed)
    {
      what = what.empty() ? where_ + ": field " + inQuotes(scan.fields[i].name) + " has " +
          std::to_string(streams_[i].size) + " bytes, but " + std::to_string(scan.records) + " points of " +
          std::to_string(scan.fields[i].bits) + " bits are promised"
                          : what;
      there = std::min(there, streams_[i].size * 8 / scan.fields[i].bits);
    }
  }
  task.endAt(there, scan.records, what);
  task.pointsThere = ~std::uint64_t{ 0 }; // other scans follow
  scan.records = there;
}

void E57Packets::gather(std::size_t field, std::uint64_t first, std::size_t count, char* to) const noexcept
{
  const Stream& stream = streams_[field];
  auto part = std::upper_bound(stream.parts.begin(), stream.parts.end(), first,
    [](std::uint64_t at, const Part& candidate) { return at < candidate.before; });
  part -= part == stream.parts.begin() ? 0 : 1;
  for (; count > 0 && part != stream.parts.end(); ++part)
  {
    const std::uint64_t end = part + 1 == stream.parts.end() ? stream.size : (part + 1)->before;
    if (first >= end)
    {
      break;
    }
    const std::size_t size = static_cast<std::size_t>(std::min<std::uint64_t>(count, end - first));
    pages_.copy(part->at + (first - part->before), size, to);
    first += size;
    to += size;
    count -= size;
  }
  std::fill_n(to, count, '\0');
}

} // namespace pointhaptics::io
