#include "IO/E57/E57Packets.h"

#include "Bytes/LittleEndian.h"
#include "FileProblem.h"
#include "ReadTask.h"

#include <algorithm>
#include <array>
#include <atomic>

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

/// CRC-32C (Castagnoli: polynomial 0x1EDC6F41, bits reflected, all ones before and after) of @p size bytes.
/// Any thread. Source: RFC 3720, appendix B.4.
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

constexpr std::size_t kSectionHeader = 32;
constexpr std::size_t kPacketHeader = 4;     ///< of any packet: type, flags, length - 1
constexpr std::size_t kDataPacketHeader = 6; ///< and the number of streams
constexpr unsigned kCompressedVectorSection = 1;
constexpr unsigned kDataPacket = 1;
constexpr unsigned kEmptyPacket = 2;

} // namespace

E57Pages::E57Pages(std::string_view bytes)
{
  failTruncatedIf(
    bytes.size() < kPage, "the file ends at byte {} inside its first page of {} bytes", bytes.size(), kPage);
  const char* header = bytes.data();
  major_ = loadLittle<std::uint32_t>(header + 8);
  minor_ = loadLittle<std::uint32_t>(header + 12);
  const std::uint64_t length = loadLittle<std::uint64_t>(header + 16);
  const std::uint64_t xml = loadLittle<std::uint64_t>(header + 24);
  xmlLength_ = loadLittle<std::uint64_t>(header + 32);
  const std::uint64_t page = loadLittle<std::uint64_t>(header + 40);
  failFormatIf(
    major_ != 1, "export it as E57 1.0 (ASTM E2807)", "byte 8: version {}, but 1.0 is read here", version());
  failDamagedIf(page != kPage, 40, "pages of {} bytes, but E57 has {}", page, kPage);
  failTruncatedIf(
    length > bytes.size(), "byte 16: the header says {} bytes, but the file has {}", length, bytes.size());
  failDamagedIf(
    length < kPage || length % kPage != 0, 16, "a length of {} bytes, which are no whole pages", length);
  bytes_ = bytes.substr(0, length);
  xmlOffset_ = logical(xml, "byte 24: the XML section");
  failTruncatedIf(xmlLength_ > size() - xmlOffset_,
    "byte 32: an XML section of {} bytes, but only {} follow byte {}", xmlLength_, size() - xmlOffset_, xml);
}

void E57Pages::check(const ReadTask& task, double part) const
{
  const std::size_t pages = bytes_.size() / kPage;
  std::atomic<std::size_t> firstWrong{ pages };
  const auto check = [&](vtkIdType from, vtkIdType to)
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
  };
  task.fillRows(static_cast<vtkIdType>(pages), check, part);
  failDamagedIf(firstWrong < pages, firstWrong * kPage,
    "page {} of {} does not have the content of its checksum (CRC-32C)", firstWrong + 1, pages);
}

std::string E57Pages::version() const
{
  return std::to_string(major_) + "." + std::to_string(minor_);
}

std::uint64_t E57Pages::logical(std::uint64_t physical, const std::string& what) const
{
  failFormatIf(physical >= bytes_.size() || physical % kPage >= kContent || physical < kFileHeader,
    kDamagedCure, "{} is at byte {} of {}, where no content is", what, physical, bytes_.size());
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
  failTruncatedIf(pages_.size() - begin_ < header.size(),
    "byte {}: the file ends inside the section of the points of {}", E57Pages::physical(begin_), where_);
  pages_.copy(begin_, header.size(), header.data());
  const unsigned kind = static_cast<unsigned char>(header[0]);
  const std::uint64_t length = loadLittle<std::uint64_t>(header.data() + 8);
  const std::uint64_t at = E57Pages::physical(begin_);
  failDamagedIf(kind != kCompressedVectorSection, at,
    "a section of kind {} where the points of {} are said to be", kind, where_);
  failTruncatedIf(length < kSectionHeader || length > pages_.size() - begin_,
    "byte {}: a section of {} bytes, but only {} follow", at, length, pages_.size() - begin_);
  end_ = begin_ + length;
  const std::uint64_t first =
    pages_.logical(loadLittle<std::uint64_t>(header.data() + 16), where_ + ": its first packet");
  failDamagedIf(first < begin_ + kSectionHeader || first > end_, at,
    "the first packet of {} is at byte {}, outside of its section", where_, E57Pages::physical(first));
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
  failFormatIf(bitsOfRecord == 0 && scan.records > end_ - begin_, kDamagedCure,
    "{}: {} points that are all the same by their description", where_, scan.records);
}

void E57Packets::walk(std::uint64_t at)
{
  while (unfinished_ > 0 && at + kPacketHeader <= end_)
  {
    std::array<char, kPacketHeader> header{};
    pages_.copy(at, header.size(), header.data());
    const unsigned kind = static_cast<unsigned char>(header[0]);
    const std::size_t length = std::size_t{ loadLittle<std::uint16_t>(header.data() + 2) } + 1;
    const std::uint64_t place = E57Pages::physical(at);
    failDamagedIf(kind > kEmptyPacket, place, "{}: a packet of kind {}, but 0 to 2 are known", where_, kind);
    failDamagedIf(length < kPacketHeader || length % 4 != 0 || length > end_ - at, place,
      "{}: a packet of {} bytes, with {} left in the section", where_, length, end_ - at);
    kind == kDataPacket ? addDataPacket(at, length) : void(); // the other kinds are passed over
    at += length;
  }
}

void E57Packets::addDataPacket(std::uint64_t at, std::size_t length)
{
  std::array<char, 65536> packet;
  const std::size_t streams = streams_.size();
  const std::size_t header = kDataPacketHeader + 2 * streams;
  pages_.copy(at, std::min(header, length), packet.data());
  failDamagedIf(header > length || loadLittle<std::uint16_t>(packet.data() + 4) != streams,
    E57Pages::physical(at), "{}: a packet that does not have the {} streams of the scan's fields", where_,
    streams);
  std::size_t inPacket = header;
  for (std::size_t i = 0; i < streams; ++i)
  {
    const std::size_t size = loadLittle<std::uint16_t>(packet.data() + kDataPacketHeader + 2 * i);
    failDamagedIf(size > length - inPacket, E57Pages::physical(at),
      "{}: a packet whose streams are longer than its {} bytes", where_, length);
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

void E57Packets::endEarly(E57Scan& scan, ReadTask& task) const
{
  std::uint64_t there = scan.records;
  std::string what;
  for (std::size_t i = 0; i < streams_.size(); ++i)
  {
    if (streams_[i].size < streams_[i].needed)
    {
      what = what.empty()
        ? fmt::format("{}: field {} has {} bytes, but {} points of {} bits are promised", where_,
            inQuotes(scan.fields[i].name), streams_[i].size, scan.records, scan.fields[i].bits)
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
