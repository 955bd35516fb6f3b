#include "FormatReaders.h"

#include "CloudColumns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace pointhaptics::io
{

namespace
{

constexpr std::size_t kSmallestHeader = 227;
constexpr std::size_t kHeaderOf14 = 375;
constexpr std::size_t kVlrHeader = 54;
constexpr std::size_t kNone = 0;

/// Byte offsets inside a record of each point format; 0 = the format has no such field.
struct PointFormat
{
  std::size_t size;
  std::size_t gpsTime;
  std::size_t rgb;
  std::size_t nearInfrared;
};
constexpr PointFormat kPointFormats[] = {
  { 20, kNone, kNone, kNone },
  { 28, 20, kNone, kNone },
  { 26, kNone, 20, kNone },
  { 34, 20, 28, kNone },
  { 57, 20, kNone, kNone },
  { 63, 20, 28, kNone },
  { 30, 22, kNone, kNone },
  { 36, 22, 30, kNone },
  { 38, 22, 30, 36 },
  { 59, 22, kNone, kNone },
  { 67, 22, 30, 36 },
};

/// Little-endian number at @p offset. @pre it lies inside @p bytes.
template <typename T>
T numberAt(std::string_view bytes, std::size_t offset)
{
  char raw[sizeof(T)];
  std::memcpy(raw, bytes.data() + offset, sizeof(T));
  if (!isLittleEndianHost())
  {
    std::reverse(raw, raw + sizeof(T));
  }
  T value;
  std::memcpy(&value, raw, sizeof(T));
  return value;
}

struct LasHeader
{
  int minorVersion = 0;
  int pointFormat = 0;
  std::size_t headerSize = 0;
  std::size_t pointsOffset = 0;
  std::size_t recordLength = 0;
  std::uint64_t count = 0;
  std::array<double, 3> scale{};
  std::array<double, 3> offset{};

  bool isExtended() const { return pointFormat >= 6; }
};

[[noreturn]] void failCompressed()
{
  throw FileProblem(vtkErrorCode::UnrecognizedFileTypeError,
    "the points are LAZ-compressed, which is not read here",
    "unpack it first: laszip -i in.laz -o out.las, las2las -i in.laz -o out.las, or pdal translate in.laz "
    "out.las");
}

/// Whether LASzip's record is among the variable length records between header and points.
bool hasLaszipRecord(std::string_view bytes, const LasHeader& header, std::uint32_t records)
{
  std::size_t at = header.headerSize;
  for (std::uint32_t i = 0; i < records && at + kVlrHeader <= std::min(bytes.size(), header.pointsOffset);
       ++i)
  {
    if (bytes.substr(at + 2, 14) == "laszip encoded" && numberAt<std::uint16_t>(bytes, at + 18) == 22204)
    {
      return true;
    }
    at += kVlrHeader + numberAt<std::uint16_t>(bytes, at + 20);
  }
  return false;
}

void checkScales(const LasHeader& header)
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    if (!std::isfinite(header.scale[axis]) || header.scale[axis] == 0.0 ||
      !std::isfinite(header.offset[axis]))
    {
      failFormat("byte " + std::to_string(131 + 8 * axis) + ": scale " + std::to_string(header.scale[axis]) +
          " and offset " + std::to_string(header.offset[axis]) + " of axis " + "xyz"[axis] + " are unusable",
        "write the file again with finite scales other than 0");
    }
  }
}

void checkLayout(std::string_view bytes, const LasHeader& header)
{
  const std::size_t needed = kPointFormats[header.pointFormat].size;
  if (header.recordLength < needed)
  {
    failFormat("byte 105: records of " + std::to_string(header.recordLength) +
        " bytes are too short for point format " + std::to_string(header.pointFormat) + ", which takes " +
        std::to_string(needed),
      "write the file again with another program");
  }
  if (header.pointsOffset < header.headerSize || header.pointsOffset > bytes.size())
  {
    failTruncated("byte 96: the points start at byte " + std::to_string(header.pointsOffset) +
      " of a file of " + std::to_string(bytes.size()) + " bytes");
  }
  if (header.count == 0)
  {
    failNoPoints();
  }
  const std::size_t available = bytes.size() - header.pointsOffset;
  if (header.count > available / header.recordLength)
  {
    failTruncated("the header counts " + std::to_string(header.count) + " points of " +
      std::to_string(header.recordLength) + " bytes, but only " + std::to_string(available) +
      " bytes follow (" + std::to_string(available / header.recordLength) + " points)");
  }
}

LasHeader parseHeader(std::string_view bytes)
{
  if (bytes.size() < kSmallestHeader)
  {
    failTruncated("the file ends at byte " + std::to_string(bytes.size()) + " inside its header");
  }
  LasHeader header;
  header.minorVersion = numberAt<std::uint8_t>(bytes, 25);
  const int major = numberAt<std::uint8_t>(bytes, 24);
  if (major != 1 || header.minorVersion > 4)
  {
    failFormat("byte 24: version " + std::to_string(major) + "." + std::to_string(header.minorVersion),
      "convert it to LAS 1.0 to 1.4");
  }
  header.headerSize = numberAt<std::uint16_t>(bytes, 94);
  if (header.headerSize < kSmallestHeader)
  {
    failFormat("byte 94: a header of " + std::to_string(header.headerSize) + " bytes",
      "LAS headers take at least 227");
  }
  header.pointsOffset = numberAt<std::uint32_t>(bytes, 96);
  const int format = numberAt<std::uint8_t>(bytes, 104);
  if ((format & 0xc0) != 0 || hasLaszipRecord(bytes, header, numberAt<std::uint32_t>(bytes, 100)))
  {
    failCompressed();
  }
  if (format > 10)
  {
    failFormat(
      "byte 104: unknown point format " + std::to_string(format), "convert it to point format 0 to 10");
  }
  header.pointFormat = format;
  header.recordLength = numberAt<std::uint16_t>(bytes, 105);
  header.count = numberAt<std::uint32_t>(bytes, 107);
  if (header.minorVersion == 4 && header.headerSize >= kHeaderOf14 && bytes.size() >= kHeaderOf14)
  {
    const std::uint64_t count = numberAt<std::uint64_t>(bytes, 247);
    header.count = count ? count : header.count;
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    header.scale[axis] = numberAt<double>(bytes, 131 + 8 * axis);
    header.offset[axis] = numberAt<double>(bytes, 155 + 8 * axis);
  }
  checkLayout(bytes, header);
  checkScales(header);
  return header;
}

/// Indices into the list of columns, in its order.
enum LasColumn : std::size_t
{
  kX,
  kY,
  kZ,
  kIntensity,
  kReturnNumber,
  kNumberOfReturns,
  kClassification,
  kScanAngle,
  kUserData,
  kPointSourceId,
  kFixedColumns
};

/// The fields every format has, by their place in the record.
class RecordBlock
{
public:
  RecordBlock(
    const LasHeader& header, const CloudColumns& columns, const char* first, vtkIdType row, vtkIdType count)
    : header_(header)
    , columns_(columns)
    , first_(first)
    , row_(row)
    , count_(count)
  {
  }
  void copy(std::size_t offset, int type, std::size_t column, int component = 0) const
  {
    copyStrided({ first_ + offset, static_cast<std::ptrdiff_t>(header_.recordLength), type },
      columns_.target(column, component).fromRow(row_), count_, !isLittleEndianHost());
  }
  /// Applies @p change to each value of type T in the array of @p column.
  template <typename T, typename Change>
  void modify(std::size_t column, Change change) const
  {
    const ColumnView view = columns_.target(column).fromRow(row_);
    char* at = view.first;
    for (vtkIdType i = 0; i < count_; ++i, at += view.stride)
    {
      T* value = reinterpret_cast<T*>(at);
      *value = change(*value);
    }
  }
  void fillPosition() const;
  void fillAttributes() const;

private:
  const LasHeader& header_;
  const CloudColumns& columns_;
  const char* first_;
  vtkIdType row_;
  vtkIdType count_;
};

void RecordBlock::fillPosition() const
{
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    copy(4 * axis, VTK_TYPE_INT32, kX + axis);
    const double scale = header_.scale[axis];
    const double offset = header_.offset[axis];
    modify<double>(kX + axis, [=](double raw) { return raw * scale + offset; });
  }
}

void RecordBlock::fillAttributes() const
{
  using Byte = std::uint8_t;
  copy(12, VTK_TYPE_UINT16, kIntensity);
  copy(14, VTK_TYPE_UINT8, kReturnNumber);
  copy(14, VTK_TYPE_UINT8, kNumberOfReturns);
  if (header_.isExtended())
  {
    modify<Byte>(kReturnNumber, [](Byte b) { return static_cast<Byte>(b & 0x0f); });
    modify<Byte>(kNumberOfReturns, [](Byte b) { return static_cast<Byte>(b >> 4); });
    copy(16, VTK_TYPE_UINT8, kClassification);
    copy(17, VTK_TYPE_UINT8, kUserData);
    copy(18, VTK_TYPE_INT16, kScanAngle);
    modify<float>(
      kScanAngle, [](float steps) { return static_cast<float>(0.006 * static_cast<double>(steps)); });
    copy(20, VTK_TYPE_UINT16, kPointSourceId);
    return;
  }
  modify<Byte>(kReturnNumber, [](Byte b) { return static_cast<Byte>(b & 0x07); });
  modify<Byte>(kNumberOfReturns, [](Byte b) { return static_cast<Byte>((b >> 3) & 0x07); });
  copy(15, VTK_TYPE_UINT8, kClassification);
  modify<Byte>(kClassification, [](Byte b) { return static_cast<Byte>(b & 0x1f); });
  copy(16, VTK_TYPE_INT8, kScanAngle);
  copy(17, VTK_TYPE_UINT8, kUserData);
  copy(18, VTK_TYPE_UINT16, kPointSourceId);
}

/// 8-bit colours: the high byte, or the value itself in files that (against the standard) store 0..255.
void fillColours(const CloudColumns& columns, std::size_t wide, std::size_t narrow, vtkIdType rows)
{
  const std::uint16_t* from = reinterpret_cast<const std::uint16_t*>(columns.target(wide).first);
  std::uint8_t* to = reinterpret_cast<std::uint8_t*>(columns.target(narrow).first);
  const vtkIdType values = 3 * rows;
  const bool sixteenBit = std::any_of(from, from + values, [](std::uint16_t v) { return v > 255; });
  std::transform(from, from + values, to,
    [=](std::uint16_t v) { return static_cast<std::uint8_t>(sixteenBit ? v >> 8 : v); });
}

} // namespace

void readLas(ReadTask& task, vtkPolyData* cloud)
{
  if (task.bytes.size() > 25)
  {
    task.format = "LAS 1." + std::to_string(numberAt<std::uint8_t>(task.bytes, 25));
  }
  const LasHeader header = parseHeader(task.bytes);
  task.format += " (point format " + std::to_string(header.pointFormat) + ")";
  const PointFormat& fields = kPointFormats[header.pointFormat];

  std::vector<Column> names = { { "x", VTK_DOUBLE }, { "y", VTK_DOUBLE }, { "z", VTK_DOUBLE },
    { "Intensity", VTK_TYPE_UINT16 }, { "ReturnNumber", VTK_TYPE_UINT8 },
    { "NumberOfReturns", VTK_TYPE_UINT8 }, { "Classification", VTK_TYPE_UINT8 }, { "ScanAngle", VTK_FLOAT },
    { "UserData", VTK_TYPE_UINT8 }, { "PointSourceId", VTK_TYPE_UINT16 } };
  const auto addOptional = [&](std::size_t offset, const Column& column)
  {
    if (offset != kNone)
    {
      names.push_back(column);
    }
    return names.size() - 1;
  };
  const std::size_t gpsTime = addOptional(fields.gpsTime, { "GpsTime", VTK_DOUBLE });
  const std::size_t wide = addOptional(fields.rgb, { "Color16", VTK_TYPE_UINT16, 3 });
  const std::size_t narrow = addOptional(fields.rgb, { "RGB", VTK_TYPE_UINT8, 3 });
  const std::size_t nearInfrared = addOptional(fields.nearInfrared, { "NearInfrared", VTK_TYPE_UINT16 });

  const vtkIdType rows = static_cast<vtkIdType>(header.count);
  CloudColumns columns(names, rows);
  const char* records = task.bytes.data() + header.pointsOffset;
  for (vtkIdType row = 0; row < rows; row += kProgressRows)
  {
    const vtkIdType count = std::min(kProgressRows, rows - row);
    const RecordBlock block(
      header, columns, records + static_cast<std::size_t>(row) * header.recordLength, row, count);
    block.fillPosition();
    block.fillAttributes();
    if (fields.gpsTime != kNone)
    {
      block.copy(fields.gpsTime, VTK_DOUBLE, gpsTime);
    }
    for (int channel = 0; channel < 3 && fields.rgb != kNone; ++channel)
    {
      block.copy(fields.rgb + 2 * static_cast<std::size_t>(channel), VTK_TYPE_UINT16, wide, channel);
    }
    if (fields.nearInfrared != kNone)
    {
      block.copy(fields.nearInfrared, VTK_TYPE_UINT16, nearInfrared);
    }
    task.progress(static_cast<double>(row + count) / static_cast<double>(rows));
  }
  if (fields.rgb != kNone)
  {
    fillColours(columns, wide, narrow, rows);
  }
  columns.moveTo(cloud);
}

} // namespace pointhaptics::io
