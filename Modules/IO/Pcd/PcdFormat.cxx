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
#include <cstring>
#include <limits>
#include <memory>
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
    , window_(new std::uint8_t[kCapacity])
  {
  }
  /// Fills all of @p to. @return false when the packed bytes are damaged or end before.
  bool read(char* to, std::size_t size)
  {
    while (size > 0)
    {
      if (begin_ == end_ && !this->fill())
      {
        return false;
      }
      const std::size_t piece = std::min(size, end_ - begin_);
      std::memcpy(to, window_.get() + begin_, piece);
      begin_ += piece;
      to += piece;
      size -= piece;
    }
    return true;
  }
  /// True if everything was unpacked and handed out.
  bool isAtEnd() const { return at_ == packed_.size() && begin_ == end_; }
  /// How many packed bytes were used, up to the fault where there is one.
  std::size_t position() const { return at_; }

private:
  bool fill()
  {
    if (end_ > kFarthest)
    {
      const std::size_t dropped = end_ - kFarthest;
      std::memmove(window_.get(), window_.get() + dropped, kFarthest);
      end_ = kFarthest;
    }
    begin_ = end_;
    while (end_ < kFarthest + kBlock && at_ < packed_.size())
    {
      if (!this->unpackOne())
      {
        return false;
      }
    }
    return end_ > begin_;
  }
  bool unpackOne()
  {
    const std::size_t left = packed_.size() - at_;
    const auto byteAt = [&](std::size_t i) { return static_cast<std::uint8_t>(packed_[at_ + i]); };
    const std::size_t control = byteAt(0);
    if (control < 32)
    {
      const std::size_t length = control + 1;
      if (length >= left)
      {
        return false;
      }
      std::memcpy(window_.get() + end_, packed_.data() + at_ + 1, length);
      at_ += 1 + length;
      end_ += length;
      return true;
    }
    const bool isLong = control >> 5 == 7;
    const std::size_t used = isLong ? 3 : 2;
    if (used > left)
    {
      return false;
    }
    const std::size_t length = (control >> 5) + 2 + (isLong ? byteAt(1) : 0);
    const std::size_t distance = ((control & 31) << 8 | byteAt(used - 1)) + 1;
    if (distance > end_)
    {
      return false;
    }
    // A reference may reach into what it writes: byte by byte.
    const std::uint8_t* from = window_.get() + end_ - distance;
    std::uint8_t* to = window_.get() + end_;
    for (std::size_t i = 0; i < length; ++i)
    {
      to[i] = from[i];
    }
    at_ += used;
    end_ += length;
    return true;
  }

  static constexpr std::size_t kFarthest = 8192; ///< 13 bits of distance
  static constexpr std::size_t kLongest = 264;   ///< of one control byte
  static constexpr std::size_t kBlock = 65536;
  static constexpr std::size_t kCapacity = kFarthest + kBlock + kLongest;

  std::string_view packed_;
  std::size_t at_ = 0;
  std::unique_ptr<std::uint8_t[]> window_; ///< what references may reach, then what was not handed out yet
  std::size_t begin_ = 0;                  ///< the first byte that was not handed out
  std::size_t end_ = 0;
};

/// Bytes of one field that are unpacked at a time: they stay in the cache.
constexpr std::size_t kBlockBytes = 1 << 18;

/// The fields that are read, each with its place in the output.
struct PcdTable
{
  struct Entry
  {
    PcdField field;
    std::size_t column = 0; ///< unless the field is padding
  };
  std::vector<Entry> entries;
  std::vector<Column> columns;

  explicit PcdTable(const PcdHeader& header)
  {
    for (const PcdField& field : header.fields)
    {
      entries.push_back({ field, columns.size() });
      if (!field.isPadding())
      {
        columns.push_back(field.column());
      }
    }
  }
};

/// Adds the columns of one field, whose first value lies at @p first: of colours, packed as 0xAARRGGBB, each
/// byte; of padding none.
void addStored(
  const PcdTable::Entry& entry, const char* first, std::ptrdiff_t stride, std::vector<StoredColumn>& stored)
{
  constexpr std::ptrdiff_t kBytes[] = { 2, 1, 0, 3 }; // of red, green, blue and alpha
  const PcdField& field = entry.field;
  const bool isPacked = field.isPackedColor();
  for (int i = 0; !field.isPadding() && i < field.column().components; ++i)
  {
    stored.push_back({ { first + (isPacked ? kBytes[i] : i * sizeOfType(field.type)), stride,
                         isPacked ? VTK_TYPE_UINT8 : field.type },
      entry.column, i });
  }
}

void fillFromRecords(const ReadTask& task, const PcdHeader& header, const RowRange& wanted,
  const PcdTable& table, const CloudColumns& columns)
{
  const std::size_t begin = header.bodyOffset + static_cast<std::size_t>(wanted.first) * header.recordSize;
  task.need(begin, static_cast<std::size_t>(wanted.count()) * header.recordSize);
  std::vector<StoredColumn> stored;
  for (const PcdTable::Entry& entry : table.entries)
  {
    addStored(entry, task.bytes.data() + begin + entry.field.offset,
      static_cast<std::ptrdiff_t>(header.recordSize), stored);
  }
  columns.fill(stored, task);
}

/// Compressed files hold field after field, as a rule without padding.
void fillFromCompressed(
  const ReadTask& task, const PcdHeader& header, const PcdTable& table, const CloudColumns& columns)
{
  const std::size_t packedAt = header.bodyOffset + 8;
  LzfStream stream(task.bytes.substr(packedAt, header.compressedSize));
  const vtkIdType rows = static_cast<vtkIdType>(header.points);
  std::vector<char> block;
  std::size_t done = 0;
  const bool hasPadding = header.compressedRecordSize == header.recordSize;
  for (const PcdTable::Entry& entry : table.entries)
  {
    const PcdField& field = entry.field;
    if (field.isPadding() && !hasPadding)
    {
      continue;
    }
    const std::size_t size = static_cast<std::size_t>(sizeOfType(field.type) * field.count);
    const vtkIdType most = std::max<vtkIdType>(1, static_cast<vtkIdType>(kBlockBytes / size));
    for (vtkIdType row = 0; row < rows; row += most)
    {
      const vtkIdType count = std::min(most, rows - row);
      block.resize(size * static_cast<std::size_t>(count));
      const bool isRead = stream.read(block.data(), block.size());
      failIf(!isRead,
        { atByte(packedAt + stream.position()), "damaged LZF data in field ", inQuotes(field.name) },
        "the file is damaged: copy or write it again");
      std::vector<StoredColumn> stored;
      addStored(entry, block.data(), static_cast<std::ptrdiff_t>(size), stored);
      for (const StoredColumn& each : stored)
      {
        copyStrided(each.source, columns.target(each.column, each.component).fromRow(row), count);
      }
      done += block.size();
      task.progress(
        static_cast<double>(done) / static_cast<double>(header.points * header.compressedRecordSize));
    }
  }
  failIf(!stream.isAtEnd(), { atByte(packedAt + stream.position()), "more compressed data than points" },
    "the file is damaged or its header is wrong: copy it again");
}

/// A line of numbers for each point. Packed colours are read as the numbers that they are, and unpacked then.
void fillFromAscii(
  ReadTask& task, const PcdHeader& header, const PcdTable& table, const CloudColumns& columns)
{
  const vtkIdType rows = static_cast<vtkIdType>(header.points);
  std::vector<TextField> fields;
  std::vector<std::vector<std::uint32_t>> packed(table.entries.size());
  for (std::size_t i = 0; i < table.entries.size(); ++i)
  {
    const PcdTable::Entry& entry = table.entries[i];
    packed[i].resize(entry.field.isPackedColor() ? static_cast<std::size_t>(rows) : 0);
    for (int component = 0; component < entry.field.count; ++component)
    {
      fields.push_back({ entry.field.name,
        entry.field.isPadding() ? ColumnView{}
          : entry.field.isPackedColor()
          ? ColumnView{ reinterpret_cast<char*>(packed[i].data()), 4, entry.field.type }
          : columns.target(entry.column, component) });
    }
  }
  LineReader lines(task.bytes.substr(header.bodyOffset), header.bodyLine);
  TextRecords(lines, fields, { "field", "point", "points", "give the field TYPE F in the header" }, true)
    .storeAll(task, header.points, header.points);
  std::vector<StoredColumn> colors;
  for (std::size_t i = 0; i < table.entries.size(); ++i)
  {
    packed[i].empty()
      ? void()
      : addStored(table.entries[i], reinterpret_cast<const char*>(packed[i].data()), 4, colors);
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
  task.format = "PCD (" + nameOf(header.encoding) + ")";
  const PcdTable table(header);
  if (header.encoding != PcdEncoding::Binary)
  {
    task.takeWhole(); // text has no records of one size, compressed files have field after field
  }
  const RowRange rows = task.rowsOf(header.points);
  CloudColumns columns(table.columns, static_cast<vtkIdType>(rows.count()));
  switch (header.encoding)
  {
    case PcdEncoding::Ascii:
      fillFromAscii(task, header, table, columns);
      break;
    case PcdEncoding::Binary:
      fillFromRecords(task, header, rows, table, columns);
      break;
    case PcdEncoding::Compressed:
      fillFromCompressed(task, header, table, columns);
      break;
  }
  columns.moveTo(cloud, task);
  if (task.pointsThere < header.points) // no grid of the scanner
  {
    header.height = 1;
  }
  addFieldData(task, header, cloud);
}

} // namespace pointhaptics::io
