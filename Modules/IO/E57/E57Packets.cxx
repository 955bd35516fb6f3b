#include "IO/E57/E57Packets.h"

#include "Bytes/LittleEndian.h"
#include "FileProblem.h"
#include "IO/E57/E57Pages.h"
#include "ReadTask.h"

#include <algorithm>
#include <array>
#include <limits>

namespace pointhaptics::io
{

namespace
{

constexpr const char* kCure = "the file is damaged: copy or write it again";
constexpr std::size_t kSectionHeader = 32;
constexpr std::size_t kPacketHeader = 4;     ///< of any packet: type, flags, length - 1
constexpr std::size_t kDataPacketHeader = 6; ///< and the number of streams
constexpr unsigned kCompressedVectorSection = 1;
constexpr unsigned kIndexPacket = 0;
constexpr unsigned kDataPacket = 1;
constexpr unsigned kEmptyPacket = 2;

std::string atByte(std::uint64_t logical)
{
  return "byte " + std::to_string(E57Pages::physical(logical)) + ": ";
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
    failTruncated(atByte(begin_) + "the file ends inside the section of the points of " + where_);
  }
  pages_.copy(begin_, header.size(), header.data());
  const unsigned kind = static_cast<unsigned char>(header[0]);
  const std::uint64_t length = loadLittle<std::uint64_t>(header.data() + 8);
  if (kind != kCompressedVectorSection)
  {
    failFormat(atByte(begin_) + "a section of kind " + std::to_string(kind) + " where the points of " +
        where_ + " are said to be",
      kCure);
  }
  if (length < kSectionHeader || length > pages_.size() - begin_)
  {
    failTruncated(atByte(begin_) + "a section of " + std::to_string(length) + " bytes, but only " +
      std::to_string(pages_.size() - begin_) + " follow");
  }
  end_ = begin_ + length;
  const std::uint64_t first =
    pages_.logical(loadLittle<std::uint64_t>(header.data() + 16), where_ + ": its first packet");
  if (first < begin_ + kSectionHeader || first > end_)
  {
    failFormat(atByte(begin_) + "the first packet of " + where_ + " is at byte " +
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
  failFormat(atByte(at) + where_ + ": a packet " + fault, kCure);
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
