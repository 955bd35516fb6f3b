#include "Bytes/Checks.h"
#include "ReadTask.h"

#include "Bytes/NumericType.h"
#include "IO/Columns/CloudColumns.h"
#include "IO/Columns/TextRecords.h"
#include "IO/Info/FieldText.h"
#include "IO/Pcd/PcdHeader.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

namespace pointhaptics::io
{

namespace
{

/// Format: a control byte below 32 stands before that many and one literal bytes; others hold 3 bits of
/// length (7: one more byte adds to it) and, with the byte after, 13 bits of distance back.
class LzfStream
{
public:
  /// @p packed must outlive this object.
  explicit LzfStream(std::string_view packed)
    : packed_(packed)
  {
  }
  /// The next @p size bytes, which stay until the next call; null when the packed bytes are damaged or end
  /// before.
  const char* next(std::size_t size)
  {
    const std::size_t kept = std::min(begin_, kFarthest);
    window_.erase(0, begin_ - kept);
    begin_ = kept;
    window_.reserve(begin_ + size + kLongest);
    while (window_.size() < begin_ + size)
    {
      if (!this->unpackOne())
      {
        return nullptr;
      }
    }
    begin_ += size;
    return window_.data() + begin_ - size;
  }
  /// True if everything was unpacked and handed out.
  bool isAtEnd() const { return at_ == packed_.size() && begin_ == window_.size(); }
  /// How many packed bytes were used, up to the fault where there is one.
  std::size_t position() const { return at_; }

private:
  bool unpackOne()
  {
    const std::size_t left = packed_.size() - at_;
    const auto byteAt = [&](std::size_t i) { return static_cast<std::uint8_t>(packed_[at_ + i]); };
    const std::size_t control = left > 0 ? byteAt(0) : 0;
    const bool isLiteral = control < 32;
    const bool isLong = control >> 5 == 7;
    const std::size_t used = isLiteral ? control + 2 : isLong ? 3 : 2;
    if (used > left)
    {
      return false;
    }
    if (isLiteral)
    {
      window_.append(packed_, at_ + 1, control + 1);
      at_ += used;
      return true;
    }
    const std::size_t length = (control >> 5) + 2 + (isLong ? byteAt(1) : 0);
    const std::size_t distance = ((control & 31) << 8 | byteAt(used - 1)) + 1;
    const std::size_t end = window_.size();
    if (distance > end)
    {
      return false;
    }
    // A reference may reach into what it writes: byte by byte.
    window_.resize(end + length);
    char* const to = &window_[end];
    const char* const from = to - distance;
    for (std::size_t i = 0; i < length; ++i)
    {
      to[i] = from[i];
    }
    at_ += used;
    return true;
  }

  static constexpr std::size_t kFarthest = 8192; ///< 13 bits of distance
  static constexpr std::size_t kLongest = 264;   ///< of one control byte

  std::string_view packed_;
  std::size_t at_ = 0;
  std::string window_;    ///< what references may reach, then what was not handed out yet
  std::size_t begin_ = 0; ///< the first byte that was not handed out
};

/// Bytes of one field that are unpacked at a time: they stay in the cache.
constexpr std::size_t kBlockBytes = 1 << 18;

std::vector<Column> columnsOf(const PcdHeader& header)
{
  std::vector<Column> columns;
  for (const PcdField& field : header.fields)
  {
    field.isPadding() ? void() : columns.push_back(field.column());
  }
  return columns;
}

/// Adds the columns of one field, whose first value lies at @p first: of colours, packed as 0xAARRGGBB, each
/// byte; of padding none.
void addStored(
  const PcdField& field, const char* first, std::ptrdiff_t stride, std::vector<StoredColumn>& stored)
{
  constexpr std::ptrdiff_t kBytes[] = { 2, 1, 0, 3 }; // of red, green, blue and alpha
  const bool isPacked = field.isPackedColor();
  for (int i = 0; !field.isPadding() && i < field.column().components; ++i)
  {
    stored.push_back({ { first + (isPacked ? kBytes[i] : i * sizeOfType(field.type)), stride,
                         isPacked ? VTK_TYPE_UINT8 : field.type },
      field.index, i });
  }
}

void fillFromRecords(
  const ReadTask& task, const PcdHeader& header, const RowRange& wanted, const CloudColumns& columns)
{
  const std::size_t begin = header.bodyOffset + static_cast<std::size_t>(wanted.first) * header.recordSize;
  task.need(begin, static_cast<std::size_t>(wanted.count()) * header.recordSize);
  std::vector<StoredColumn> stored;
  for (const PcdField& field : header.fields)
  {
    addStored(field, task.bytes.data() + begin + field.offset, static_cast<std::ptrdiff_t>(header.recordSize),
      stored);
  }
  columns.fill(stored, task);
}

/// Compressed files hold field after field, as a rule without padding.
void fillFromCompressed(const ReadTask& task, const PcdHeader& header, const CloudColumns& columns)
{
  const std::size_t packedAt = header.bodyOffset + 8;
  LzfStream stream(task.bytes.substr(packedAt, header.compressedSize));
  const vtkIdType rows = static_cast<vtkIdType>(header.points);
  std::size_t done = 0;
  const bool hasPadding = header.compressedRecordSize == header.recordSize;
  for (const PcdField& field : header.fields)
  {
    if (field.isPadding() && !hasPadding)
    {
      continue;
    }
    const std::size_t size = static_cast<std::size_t>(sizeOfType(field.type) * field.count);
    const vtkIdType most = std::max<vtkIdType>(1, static_cast<vtkIdType>(kBlockBytes / size));
    for (vtkIdType row = 0; row < rows; row += most)
    {
      const vtkIdType count = std::min(most, rows - row);
      const std::size_t bytes = size * static_cast<std::size_t>(count);
      const char* const block = stream.next(bytes);
      failDamagedIf(
        !block, packedAt + stream.position(), "damaged LZF data in field {}", inQuotes(field.name));
      std::vector<StoredColumn> stored;
      addStored(field, block, static_cast<std::ptrdiff_t>(size), stored);
      for (const StoredColumn& each : stored)
      {
        copyStrided(each.source, columns.target(each.column, each.component).fromRow(row), count);
      }
      done += bytes;
      task.progress(
        static_cast<double>(done) / static_cast<double>(header.points * header.compressedRecordSize));
    }
  }
  failFormatIf(!stream.isAtEnd(), "the file is damaged or its header is wrong: copy it again",
    "{}more compressed data than points", atByte(packedAt + stream.position()));
}

/// A line of numbers for each point. Packed colours are read as the numbers that they are, and unpacked then.
void fillFromAscii(ReadTask& task, const PcdHeader& header, const CloudColumns& columns)
{
  const vtkIdType rows = static_cast<vtkIdType>(header.points);
  std::vector<TextField> fields;
  std::vector<std::vector<std::uint32_t>> packed(header.fields.size());
  for (std::size_t i = 0; i < header.fields.size(); ++i)
  {
    const PcdField& field = header.fields[i];
    packed[i].resize(field.isPackedColor() ? static_cast<std::size_t>(rows) : 0);
    for (int component = 0; component < field.count; ++component)
    {
      fields.push_back({ field.name,
        field.isPadding()         ? ColumnView{}
          : field.isPackedColor() ? ColumnView{ reinterpret_cast<char*>(packed[i].data()), 4, field.type }
                                  : columns.target(field.index, component) });
    }
  }
  LineReader lines(task.bytes.substr(header.bodyOffset), header.bodyLine);
  TextRecords(lines, fields, { "field", "point", "points", "give the field TYPE F in the header" }, true)
    .storeAll(task, header.points, header.points);
  std::vector<StoredColumn> colors;
  for (std::size_t i = 0; i < header.fields.size(); ++i)
  {
    packed[i].empty()
      ? void()
      : addStored(header.fields[i], reinterpret_cast<const char*>(packed[i].data()), 4, colors);
  }
  columns.fill(colors, task);
}

void addFieldData(ReadTask& task, const PcdHeader& header, vtkPolyData* cloud)
{
  header.comments.moveTo(cloud, task.notes);
  addFieldNumbers<vtkDoubleArray>(cloud, "Viewpoint", header.viewpoint);
  const unsigned long long most = std::numeric_limits<int>::max();
  if (header.height > 1 && header.width <= most && header.height <= most)
  {
    addFieldNumbers<vtkIntArray>(cloud, "OrganizedDimensions",
      std::array{ static_cast<int>(header.width), static_cast<int>(header.height) });
  }
}

} // namespace

void readPcd(ReadTask& task, vtkPolyData* cloud)
{
  task.need(0, kStartOfText);
  if (task.bytes.substr(0, kStartOfText).find("DATA") == std::string_view::npos)
  {
    task.takeWhole();
  }
  PcdHeader header = parsePcdHeader(task);
  task.format = "PCD (" + spaced(kPcdEncodings[static_cast<std::size_t>(header.encoding)]) + ")";
  if (header.encoding != PcdEncoding::Binary)
  {
    task.takeWhole(); // text has no records of one size, compressed files have field after field
  }
  const RowRange rows = task.rowsOf(header.points);
  CloudColumns columns(columnsOf(header), static_cast<vtkIdType>(rows.count()));
  header.encoding == PcdEncoding::Ascii      ? fillFromAscii(task, header, columns)
    : header.encoding == PcdEncoding::Binary ? fillFromRecords(task, header, rows, columns)
                                             : fillFromCompressed(task, header, columns);
  columns.moveTo(cloud, task);
  header.height = task.pointsThere < header.points ? 1 : header.height; // no grid of the scanner
  addFieldData(task, header, cloud);
}

} // namespace pointhaptics::io
