#include "IO/Las/LazLayout.h"

#include "FileProblem.h"
#include "IO/Las/LasHeader.h"

namespace pointhaptics::io
{

namespace
{

constexpr std::size_t kDescriptionStart = 34; ///< bytes of LASzip's record before its items
constexpr std::size_t kItemSize = 6;
constexpr std::size_t kWavePacketSize = 29;
constexpr std::uint64_t kTableAtTheEnd = 0xffffffffffffffff;
/// LASzip's numbers for the ways to compress.
enum Compressor
{
  kPointwise = 1, ///< one run without chunks, of the first versions
  kChunked = 2,
  kLayered = 3,
};

struct Item
{
  int type;
  std::size_t size;
};

template <typename T>
T numberAt(std::string_view bytes, std::size_t offset)
{
  return loadLittle<T>(bytes.data() + offset);
}

[[noreturn]] void failLayout(std::size_t byte, const std::string& what)
{
  failFormat("byte " + std::to_string(byte) + ": " + what, "the file is damaged: copy or compress it again");
}

/// Where the content of LASzip's record begins, and its size.
struct Description
{
  std::size_t at = 0;
  std::size_t size = 0;
};

Description findDescription(std::string_view bytes, const LasHeader& header)
{
  const std::uint32_t records = numberAt<std::uint32_t>(bytes, 100);
  const std::size_t end = header.pointsOffset;
  std::size_t at = header.headerSize;
  Description found;
  for (std::uint32_t i = 0; i < records; ++i)
  {
    if (at + kLasVlrHeader > end || at + kLasVlrHeader + numberAt<std::uint16_t>(bytes, at + 20) > end)
    {
      failLayout(100,
        "the header counts " + std::to_string(records) + " variable length records, but only " +
          std::to_string(i) + " lie before the points");
    }
    const std::string_view user = bytes.substr(at + 2, 16);
    const std::size_t size = numberAt<std::uint16_t>(bytes, at + 20);
    if (user.substr(0, user.find('\0')) == kLaszipUser &&
      numberAt<std::uint16_t>(bytes, at + 18) == kLaszipRecord)
    {
      if (found.at != 0)
      {
        failLayout(at, "a second record says how the points are compressed");
      }
      found = { at + kLasVlrHeader, size };
    }
    at += kLasVlrHeader + size;
  }
  if (found.at == 0)
  {
    failLayout(104, "the points are marked as compressed, but no record says how");
  }
  return found;
}

/// What LASzip stores for a record of this point format, in its order.
std::vector<Item> expectedItems(const LasHeader& header)
{
  const LasPointFormat& fields = header.fields();
  const bool isExtended = header.isExtended();
  std::vector<Item> items;
  std::size_t sum = 0;
  const auto add = [&](int type, std::size_t size)
  {
    items.push_back({ type, size });
    sum += size;
  };
  isExtended ? add(10, 30) : add(6, 20);
  if (fields.gpsTime != 0 && !isExtended)
  {
    add(7, 8);
  }
  if (fields.nearInfrared != 0)
  {
    add(12, 8);
  }
  else if (fields.rgb != 0)
  {
    add(isExtended ? 11 : 8, 6);
  }
  if (fields.size == sum + kWavePacketSize)
  {
    add(isExtended ? 13 : 9, kWavePacketSize);
  }
  if (header.recordLength > fields.size)
  {
    add(isExtended ? 14 : 0, header.recordLength - fields.size);
  }
  return items;
}

void checkItems(std::string_view bytes, const Description& description, const LasHeader& header)
{
  const std::vector<Item> expected = expectedItems(header);
  const std::size_t count = numberAt<std::uint16_t>(bytes, description.at + 32);
  bool same = count == expected.size() && description.size == kDescriptionStart + kItemSize * expected.size();
  for (std::size_t i = 0; same && i < count; ++i)
  {
    const std::size_t item = description.at + kDescriptionStart + kItemSize * i;
    same = numberAt<std::uint16_t>(bytes, item) == expected[i].type &&
      numberAt<std::uint16_t>(bytes, item + 2) == expected[i].size;
  }
  if (!same)
  {
    failLayout(description.at + 32,
      "what is compressed is not a record of point format " + std::to_string(header.pointFormat) + " with " +
        std::to_string(header.recordLength) + " bytes");
  }
}

/// Each chunk begins with a whole point.
void checkChunkTable(std::string_view bytes, const LasHeader& header)
{
  const std::size_t first = header.pointsOffset + 8;
  if (first > bytes.size())
  {
    failTruncated("the file ends at byte " + std::to_string(bytes.size()) + " before its first chunk");
  }
  std::uint64_t table = numberAt<std::uint64_t>(bytes, header.pointsOffset);
  if (table == header.pointsOffset)
  {
    return; // its writer was interrupted; LASzip then goes without
  }
  table = table == kTableAtTheEnd ? numberAt<std::uint64_t>(bytes, bytes.size() - 8) : table;
  if (table < first || bytes.size() < 8 || table > bytes.size() - 8)
  {
    failTruncated("byte " + std::to_string(header.pointsOffset) + ": the table of chunks is at byte " +
      std::to_string(table) + " of a file of " + std::to_string(bytes.size()) + " bytes");
  }
  const std::size_t at = static_cast<std::size_t>(table);
  const std::size_t chunks = numberAt<std::uint32_t>(bytes, at + 4);
  if (numberAt<std::uint32_t>(bytes, at) != 0 || chunks > (at - first) / header.recordLength + 1)
  {
    failLayout(at,
      "a table of " + std::to_string(chunks) + " chunks, which " + std::to_string(at - first) +
        " compressed bytes cannot be");
  }
}

void checkCount(std::string_view bytes, const LasHeader& header)
{
  const std::size_t most = std::max(kLazFloor, kMostLazRatio * bytes.size()) / header.recordLength;
  if (header.count > most)
  {
    failFormat("the header counts " + std::to_string(header.count) + " points, but a file of " +
        std::to_string(bytes.size()) + " bytes is not expected to hold more than " + std::to_string(most),
      "if this is no attack, unpack it first: laszip -i in.laz -o out.las");
  }
}

} // namespace

void checkLazLayout(std::string_view bytes, const LasHeader& header)
{
  const Description description = findDescription(bytes, header);
  if (description.size < kDescriptionStart)
  {
    failLayout(description.at,
      "a description of the compression of " + std::to_string(description.size) +
        " bytes, which takes at least " + std::to_string(kDescriptionStart));
  }
  const int compressor = numberAt<std::uint16_t>(bytes, description.at);
  if (compressor < kPointwise || compressor > kLayered)
  {
    failLayout(description.at, "unknown compressor " + std::to_string(compressor));
  }
  checkItems(bytes, description, header);
  if (compressor != kPointwise)
  {
    checkChunkTable(bytes, header);
  }
  checkCount(bytes, header);
}

} // namespace pointhaptics::io
