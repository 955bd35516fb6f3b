#include "IO/Las/LasHeader.h"

#include "Bytes/NumericType.h"
#include "FileProblem.h"
#include "IO/Las/LasCoordinateSystem.h"
#include "ReadTask.h"

#include <cmath>
#include <iterator>

namespace pointhaptics::io
{

namespace
{

constexpr std::size_t kEvlrHeader = 60;

std::string_view untilZero(std::string_view text)
{
  return text.substr(0, text.find('\0'));
}

/// All records of a file, which are loaded; a damaged list ends where it leaves the file.
std::vector<LasRecord> recordsOf(const ReadTask& task, const LasHeader& header)
{
  const std::string_view bytes = task.bytes;
  task.need(0, header.pointsOffset);
  std::vector<LasRecord> records = lasRecords(
    bytes.substr(0, header.pointsOffset), header.headerSize, numberAt<std::uint32_t>(bytes, 100), false);
  if (header.minorVersion >= 4 && header.headerSize >= kLasHeaderOf14 && bytes.size() >= kLasHeaderOf14)
  {
    for (const LasRecord& far :
      lasRecords(bytes, numberAt<std::uint64_t>(bytes, 235), numberAt<std::uint32_t>(bytes, 243), true,
        [&](std::size_t offset, std::size_t size) { task.need(offset, size); }))
    {
      far.user != "copc" ? task.need(far.at + kEvlrHeader, far.content.size()) : void();
      records.push_back(far);
    }
  }
  return records;
}

/// "LAZ" by the mark in the point format or by LASzip's record, "COPC" by its own; else empty.
std::string packingOf(const std::vector<LasRecord>& records, int formatByte)
{
  std::string found = (formatByte & kLasPackedMark) != 0 ? "LAZ" : "";
  for (const LasRecord& record : records)
  {
    const bool isLaszip = record.is(kLaszipUser, kLaszipRecord);
    found = record.is("copc", 1) ? "COPC" : found.empty() && isLaszip ? "LAZ" : found;
  }
  return found;
}

/// VTK's types for extra fields of data type 1 to 10.
constexpr int kExtraTypes[] = { VTK_TYPE_UINT8, VTK_TYPE_INT8, VTK_TYPE_UINT16, VTK_TYPE_INT16,
  VTK_TYPE_UINT32, VTK_TYPE_INT32, VTK_TYPE_UINT64, VTK_TYPE_INT64, VTK_FLOAT, VTK_DOUBLE };

LasExtraField parseExtraField(std::string_view descriptor, std::size_t offset)
{
  const int code = numberAt<std::uint8_t>(descriptor, 2);
  const int options = numberAt<std::uint8_t>(descriptor, 3);
  LasExtraField field;
  field.name = std::string(untilZero(descriptor.substr(4, 32)));
  field.offset = offset;
  if (code == 0) // bytes without meaning, their number in the place of the options
  {
    field.type = VTK_TYPE_UINT8;
    field.components = options;
    return field;
  }
  if (code > 30)
  {
    field.components = 0;
    return field;
  }
  // 11..20 are pairs and 21..30 triples of the types 1..10.
  field.type = kExtraTypes[(code - 1) % 10];
  field.components = (code - 1) / 10 + 1;
  field.isScaled = (options & 0x18) != 0;
  field.hasNoData = (options & 0x01) != 0;
  field.descriptor = descriptor;
  for (std::size_t i = 0; i < 3; ++i)
  {
    field.noData[i] = numberAt<std::int64_t>(descriptor, 40 + 8 * i);
    const bool isNarrow = field.type == VTK_FLOAT && (field.noData[i] >> 32) == 0;
    field.noDataAsFloat[i] = isNarrow ? static_cast<double>(numberAt<float>(descriptor, 40 + 8 * i))
                                      : numberAt<double>(descriptor, 40 + 8 * i);
    field.scale[i] = (options & 0x08) ? numberAt<double>(descriptor, 112 + 8 * i) : 1.0;
    field.shift[i] = (options & 0x10) ? numberAt<double>(descriptor, 136 + 8 * i) : 0.0;
  }
  return field;
}

/// True if a record is written anew, or means nothing beside the points as they are written.
bool isOfPacking(const LasRecord& record)
{
  constexpr int kFirstWave = 100;
  constexpr int kLastWave = 354;
  const bool isWave = record.user == kLasSpecUser &&
    ((record.id >= kFirstWave && record.id <= kLastWave) || record.id == 65535);
  return isWave || record.user == "copc" || record.is(kLaszipUser, kLaszipRecord);
}

void parseRecords(std::string_view bytes, const std::vector<LasRecord>& records, LasHeader& header)
{
  std::string_view descriptors;
  LasCoordinateSystem system;
  for (const LasRecord& record : records)
  {
    if (!isOfPacking(record))
    {
      (record.isFar ? header.origin.farRecords : header.origin.records) += record.whole;
    }
    descriptors = record.is(kLasSpecUser, kLasExtraBytesRecord) ? record.content : descriptors;
    record.user == kLasProjectionUser ? system.addRecord(record.id, record.content) : void();
  }
  header.extraFields = lasExtraFields(descriptors, header.fields().size, header.recordLength);
  header.origin.header = bytes.substr(0, std::min(header.headerSize, kLasHeaderOf14));
  header.coordinateSystem = system.name();
  header.lengthUnit = system.lengthUnit();
  header.heightUnit = isOtherUnit(system.heightUnit(), header.lengthUnit) ? system.heightUnit() : "";
}

void checkScales(const LasHeader& header)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    failFormatIf(
      !std::isfinite(header.scale[axis]) || header.scale[axis] == 0.0 || !std::isfinite(header.offset[axis]),
      "write the file again with finite scales other than 0",
      "byte {}: scale {:f} and offset {:f} of axis {} are unusable", 131 + 8 * axis, header.scale[axis],
      header.offset[axis], "xyz"[axis]);
  }
}

void checkLayout(ReadTask& task, const std::vector<LasRecord>& records, LasHeader& header)
{
  const std::size_t needed = header.fields().size;
  failFormatIf(header.recordLength < needed, kRewriteCure,
    "byte 105: records of {} bytes are too short for point format {}, which takes {}", header.recordLength,
    header.pointFormat, needed);
  failTruncatedIf(header.pointsOffset < header.headerSize || header.pointsOffset > task.bytes.size(),
    "byte 96: the points start at byte {} of a file of {} bytes", header.pointsOffset, task.bytes.size());
  std::size_t end = task.bytes.size();
  for (const LasRecord& record : records)
  {
    const bool isBehind = header.count == 0 && record.isFar && record.at >= header.pointsOffset;
    end = isBehind ? std::min(end, record.at) : end;
  }
  const std::size_t available = end - header.pointsOffset;
  const std::uint64_t there = header.packing.empty() ? available / header.recordLength : header.count;
  header.count == 0 && there == 0 ? failNoPoints() : void();
  if (header.count > there || header.count == 0) // 0: its writer did not come to the end
  {
    header.count = task.endAt(there, header.count,
      fmt::format("the header counts {} points of {} bytes, but {}{} bytes follow ({} points)", header.count,
        header.recordLength, header.count > 0 ? "only " : "", available, there));
  }
}

} // namespace

bool startsLikeCopc(std::string_view start)
{
  return start.size() >= 395 && start.substr(0, 4) == "LASF" &&
    start.substr(377, 5) == std::string_view("copc", 5) && numberAt<std::uint16_t>(start, 393) == 1;
}

int LasExtraField::arrayType() const
{
  const bool isFloat = sizeOfType(type) < 4 && !isScaled;
  return !isScaled && (!hasNoData || isFloatingType(type)) ? type : isFloat ? VTK_FLOAT : VTK_DOUBLE;
}

std::vector<LasExtraField> lasExtraFields(std::string_view descriptors, std::size_t first, std::size_t length)
{
  std::vector<LasExtraField> fields;
  std::size_t at = first;
  for (std::size_t i = 0; i + kLasExtraDescriptor <= descriptors.size(); i += kLasExtraDescriptor)
  {
    const LasExtraField field = parseExtraField(descriptors.substr(i, kLasExtraDescriptor), at);
    const std::size_t size = static_cast<std::size_t>(field.components * sizeOfType(field.type));
    if (size == 0 || size > length - at)
    {
      fields.clear();
      at = first;
      break;
    }
    fields.push_back(field);
    at += size;
  }
  if (at < length)
  {
    LasExtraField rest;
    rest.name = "ExtraBytes";
    rest.type = VTK_TYPE_UINT8;
    rest.components = static_cast<int>(length - at);
    rest.offset = at;
    fields.push_back(rest);
  }
  return fields;
}

std::vector<LasRecord> lasRecords(std::string_view bytes, std::uint64_t at, std::uint32_t count, bool far,
  const std::function<void(std::size_t, std::size_t)>& need)
{
  const std::size_t head = far ? kEvlrHeader : kLasVlrHeader;
  std::vector<LasRecord> records;
  while (records.size() < count && at < bytes.size() && bytes.size() - at >= head)
  {
    const std::size_t start = static_cast<std::size_t>(at);
    need(start, head);
    const std::size_t left = bytes.size() - start - head;
    const std::uint64_t claimed =
      far ? numberAt<std::uint64_t>(bytes, start + 20) : numberAt<std::uint16_t>(bytes, start + 20);
    const std::size_t size = static_cast<std::size_t>(std::min<std::uint64_t>(left, claimed));
    records.push_back({ start, claimed <= left ? bytes.substr(start, head + size) : std::string_view(),
      untilZero(bytes.substr(start + 2, 16)), numberAt<std::uint16_t>(bytes, start + 18),
      bytes.substr(start + head, size), far });
    at += head + size;
  }
  return records;
}

std::vector<LasRecord> lasRecords(const LasOrigin& origin)
{
  constexpr std::uint32_t kAll = ~std::uint32_t{ 0 };
  std::vector<LasRecord> records = lasRecords(origin.records, 0, kAll, false);
  const std::vector<LasRecord> far = lasRecords(origin.farRecords, 0, kAll, true);
  records.insert(records.end(), far.begin(), far.end());
  const auto isCut = [](const LasRecord& record) { return record.whole.empty(); };
  records.erase(std::remove_if(records.begin(), records.end(), isCut), records.end());
  return records;
}

int lasTypeCode(int type)
{
  const auto* const found = std::find(std::begin(kExtraTypes), std::end(kExtraTypes), fixedSizeType(type));
  return static_cast<int>(found - std::begin(kExtraTypes)) + 1;
}

std::string lasRecordHeader(std::string_view user, int id, std::size_t size, std::string_view description)
{
  std::string header(kLasVlrHeader, '\0');
  header.replace(2, user.size(), user);
  putLittle(header, 18, static_cast<std::uint16_t>(id));
  putLittle(header, 20, static_cast<std::uint16_t>(size));
  header.replace(22, description.size(), description);
  return header;
}

LasHeader parseLasHeader(ReadTask& task)
{
  const std::string_view bytes = task.bytes;
  failTruncatedIf(bytes.size() < kLasHeaderOf12, "the file ends at byte {} inside its header", bytes.size());
  LasHeader header;
  header.minorVersion = numberAt<std::uint8_t>(bytes, 25);
  const int major = numberAt<std::uint8_t>(bytes, 24);
  failFormatIf(major != 1 || header.minorVersion > 4, "convert it to LAS 1.0 to 1.4",
    "byte 24: version {}.{}", major, header.minorVersion);
  header.globalEncoding = numberAt<std::uint16_t>(bytes, 6);
  header.generator = untilZero(bytes.substr(58, 32));
  header.headerSize = numberAt<std::uint16_t>(bytes, 94);
  failFormatIf(header.headerSize < kLasHeaderOf12, "LAS headers take at least 227",
    "byte 94: a header of {} bytes", header.headerSize);
  header.pointsOffset = numberAt<std::uint32_t>(bytes, 96);
  const int formatByte = numberAt<std::uint8_t>(bytes, 104);
  const std::vector<LasRecord> records = recordsOf(task, header);
  header.packing = packingOf(records, formatByte);
  const int format = header.packing.empty() ? formatByte : formatByte & ~kLasPackedMark;
  failFormatIf(format > kMostLasFormat, "convert it to point format 0 to 10",
    "byte 104: unknown point format {}", format);
  header.pointFormat = format;
  header.recordLength = numberAt<std::uint16_t>(bytes, 105);
  header.count = numberAt<std::uint32_t>(bytes, 107);
  if (header.minorVersion == 4 && header.headerSize >= kLasHeaderOf14 && bytes.size() >= kLasHeaderOf14)
  {
    const std::uint64_t count = numberAt<std::uint64_t>(bytes, 247);
    header.count = count ? count : header.count;
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    header.scale[axis] = numberAt<double>(bytes, 131 + 8 * axis);
    header.offset[axis] = numberAt<double>(bytes, 155 + 8 * axis);
  }
  checkLayout(task, records, header);
  checkScales(header);
  parseRecords(bytes, records, header);
  return header;
}

} // namespace pointhaptics::io
