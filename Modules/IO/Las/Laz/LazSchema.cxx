#include "IO/Las/Laz/LazSchema.h"

#include "FileProblem.h"
#include "IO/Las/LasHeader.h"

#include <vector>

namespace pointhaptics::io
{

namespace
{

constexpr std::size_t kDescriptionStart = 34; ///< bytes of LASzip's record before its items
constexpr std::size_t kItemSize = 6;
constexpr std::size_t kWavePacketSize = 29;

/// LASzip's numbers for the items.
enum ItemType
{
  kBytes = 0,
  kPoint10 = 6,
  kGpsTime11 = 7,
  kColor12 = 8,
  kWavePacket13 = 9,
  kPoint14 = 10,
  kColor14 = 11,
  kColorNearInfrared14 = 12,
  kWavePacket14 = 13,
  kBytes14 = 14,
};

/// One item of a record.
struct RecordItem
{
  int type;
  std::size_t size;
  LazSchema::Item LazSchema::*place; ///< Its place in a schema.

  /// The version that is written.
  int version() const { return type >= kPoint14 ? 3 : type == kWavePacket13 ? 1 : 2; }
};

/// LASzip's record.
LasRecord findDescription(std::string_view bytes, const LasHeader& header)
{
  const std::uint32_t records = numberAt<std::uint32_t>(bytes, 100);
  std::uint32_t whole = 0;
  LasRecord found;
  for (const LasRecord& record :
    lasRecords(bytes.substr(0, header.pointsOffset), header.headerSize, records, false))
  {
    whole += record.whole.empty() ? 0 : 1;
    if (record.is(kLaszipUser, kLaszipRecord))
    {
      failDamagedIf(found.at != 0, record.at, "a second record says how the points are compressed");
      found = record;
    }
  }
  failDamagedIf(whole < records, 100,
    "the header counts {} variable length records, but only {} lie before the points", records, whole);
  failDamagedIf(found.at == 0, 104, "the points are marked as compressed, but no record says how");
  found.at += kLasVlrHeader; // to its content, of which messages speak
  failDamagedIf(found.content.size() < kDescriptionStart, found.at,
    "a description of the compression of {} bytes, which takes at least {}", found.content.size(),
    kDescriptionStart);
  return found;
}

/// Items that LASzip stores for a record of the schema's point format, in its order.
std::vector<RecordItem> itemsOf(const LazSchema& schema)
{
  const LasPointFormat& fields = kLasPointFormats[schema.pointFormat];
  const bool isExtended = schema.pointFormat >= 6;
  std::vector<RecordItem> items;
  std::size_t sum = 0;
  const auto addIf = [&](bool isThere, RecordItem item)
  {
    isThere ? items.push_back(item) : void();
    sum += isThere ? item.size : 0;
  };
  addIf(!isExtended, { kPoint10, 20, &LazSchema::point });
  addIf(isExtended, { kPoint14, 30, &LazSchema::point });
  addIf(fields.gpsTime != 0 && !isExtended, { kGpsTime11, 8, &LazSchema::gpsTime });
  addIf(fields.nearInfrared != 0, { kColorNearInfrared14, 8, &LazSchema::color });
  addIf(
    fields.rgb != 0 && fields.nearInfrared == 0, { isExtended ? kColor14 : kColor12, 6, &LazSchema::color });
  addIf(fields.size == sum + kWavePacketSize,
    { isExtended ? kWavePacket14 : kWavePacket13, kWavePacketSize, &LazSchema::wavePacket });
  addIf(schema.recordLength > fields.size,
    { isExtended ? kBytes14 : kBytes, schema.recordLength - fields.size, &LazSchema::extraBytes });
  return items;
}

/// The versions of an item that are read here.
bool isKnownVersion(int type, int version)
{
  return type >= kPoint14 ? version == 3 : version == 1 || (version == 2 && type != kWavePacket13);
}

void place(LazSchema& schema, const RecordItem& item, std::size_t offset, int version)
{
  schema.*item.place = { offset, version };
  schema.nearInfrared =
    item.type == kColorNearInfrared14 ? LazSchema::Item{ offset + 6, version } : schema.nearInfrared;
}

void placeItems(std::string_view bytes, const LasRecord& description, LazSchema& schema)
{
  const std::vector<RecordItem> expected = itemsOf(schema);
  const std::size_t count = numberAt<std::uint16_t>(bytes, description.at + 32);
  bool same =
    count == expected.size() && description.content.size() >= kDescriptionStart + kItemSize * expected.size();
  std::size_t offset = 0;
  for (std::size_t i = 0; same && i < count; ++i)
  {
    const std::size_t at = description.at + kDescriptionStart + kItemSize * i;
    same = numberAt<std::uint16_t>(bytes, at) == expected[i].type &&
      numberAt<std::uint16_t>(bytes, at + 2) == expected[i].size;
    const int version = numberAt<std::uint16_t>(bytes, at + 4);
    failFormatIf(same && !isKnownVersion(expected[i].type, version),
      "unpack it with the program that wrote it, or compress it with LASzip 3",
      "byte {}: item {} is compressed in version {}, which is not supported: 1 to 3 are", at + 4,
      expected[i].type, version);
    place(schema, expected[i], offset, version);
    offset += expected[i].size;
  }
  failDamagedIf(!same, description.at + 32,
    "what is compressed is not a record of point format {} with {} bytes", schema.pointFormat,
    schema.recordLength);
}

} // namespace

std::size_t LazSchema::numberOfLayers() const
{
  constexpr std::size_t kOfPoint14 = 9;
  return kOfPoint14 + (color.offset != 0 ? 1 : 0) + (nearInfrared.offset != 0 ? 1 : 0) +
    (wavePacket.offset != 0 ? 1 : 0) + numberOfExtraBytes();
}

LazSchema parseLazSchema(std::string_view bytes, const LasHeader& header)
{
  const LasRecord description = findDescription(bytes, header);
  LazSchema schema;
  const int compressor = numberAt<std::uint16_t>(bytes, description.at);
  const int coder = numberAt<std::uint16_t>(bytes, description.at + 2);
  const bool isLayered = compressor == static_cast<int>(LazSchema::Compressor::Layered);
  failDamagedIf(compressor < 1 || compressor > 3 || isLayered != header.isExtended(), description.at,
    "unknown compressor {} for point format {}", compressor, header.pointFormat);
  failDamagedIf(coder != 0, description.at + 2, "unknown coder {}", coder);
  schema.compressor = static_cast<LazSchema::Compressor>(compressor);
  schema.chunkSize = numberAt<std::uint32_t>(bytes, description.at + 12);
  schema.pointFormat = header.pointFormat;
  schema.recordLength = header.recordLength;
  schema.isChunkSizeTold = schema.chunkSize != 0;
  schema.chunkSize = schema.isChunkSizeTold ? schema.chunkSize : LazSchema::kVariableChunks;
  placeItems(bytes, description, schema);
  return schema;
}

LazSchema makeLazSchema(int pointFormat, std::size_t recordLength)
{
  LazSchema schema;
  schema.compressor = pointFormat >= 6 ? LazSchema::Compressor::Layered : LazSchema::Compressor::Chunked;
  schema.pointFormat = pointFormat;
  schema.recordLength = recordLength;
  std::size_t offset = 0;
  for (const RecordItem& item : itemsOf(schema))
  {
    place(schema, item, offset, item.version());
    offset += item.size;
  }
  return schema;
}

std::string lazRecord(const LazSchema& schema)
{
  const std::vector<RecordItem> items = itemsOf(schema);
  std::string record(kDescriptionStart + kItemSize * items.size(), '\0');
  putLittle(record, 0, static_cast<std::uint16_t>(schema.compressor)); // coder 0, the only one
  record[4] = 3;                                                       // version of the format's description
  record[5] = 4;
  putLittle(record, 12, schema.chunkSize);
  record.replace(16, 16, 16, '\xff'); // no special records
  putLittle(record, 32, static_cast<std::uint16_t>(items.size()));
  for (std::size_t i = 0; i < items.size(); ++i)
  {
    const std::size_t at = kDescriptionStart + kItemSize * i;
    putLittle(record, at, static_cast<std::uint16_t>(items[i].type));
    putLittle(record, at + 2, static_cast<std::uint16_t>(items[i].size));
    putLittle(record, at + 4, static_cast<std::uint16_t>(items[i].version()));
  }
  return record;
}

} // namespace pointhaptics::io
