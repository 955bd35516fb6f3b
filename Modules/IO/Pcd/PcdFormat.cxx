#include "FileProblem.h"
#include "ReadTask.h"

#include "Bytes/NumericType.h"
#include "IO/Columns/CloudColumns.h"
#include "IO/Columns/TextRecords.h"
#include "IO/Info/FieldText.h"
#include "IO/Pcd/PcdHeader.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkPolyData.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

namespace pointhaptics::io
{

namespace
{

/// Unpacks @p packed to @p to until @p most bytes are there. Format: a control byte below 32 stands before
/// that many and one literal bytes; others hold 3 bits of length (7: one more byte adds to it) and, with the
/// byte after, 13 bits of distance back. @return how many packed bytes were used, up to the fault where there
/// is one.
std::size_t unpackLzf(const ReadTask& task, std::string_view packed, std::string& to, std::size_t most)
{
  constexpr std::size_t kReport = 1 << 20;
  std::size_t at = 0;
  std::size_t said = 0;
  while (at < packed.size() && to.size() < most)
  {
    if (to.size() >= said + kReport)
    {
      said = to.size();
      task.progress(0.5 * static_cast<double>(said) / static_cast<double>(most));
    }
    const auto byteAt = [&](std::size_t i) { return static_cast<std::uint8_t>(packed[at + i]); };
    const std::size_t control = byteAt(0);
    const bool isLiteral = control < 32;
    const bool isLong = control >> 5 == 7;
    const std::size_t used = isLiteral ? control + 2 : isLong ? 3 : 2;
    if (used > packed.size() - at)
    {
      return at;
    }
    if (isLiteral)
    {
      to.append(packed, at + 1, control + 1);
    }
    else
    {
      const std::size_t distance = ((control & 31) << 8 | byteAt(used - 1)) + 1;
      if (distance > to.size())
      {
        return at;
      }
      // A reference may reach into what it writes: byte by byte.
      const std::size_t end = to.size();
      to.resize(end + (control >> 5) + 2 + (isLong ? byteAt(1) : 0));
      for (std::size_t i = end; i < to.size(); ++i)
      {
        to[i] = to[i - distance];
      }
    }
    at += used;
  }
  return at;
}

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
  ReadTask& task, const PcdHeader& header, const RowRange& wanted, const CloudColumns& columns)
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
  task.noteUncounted(begin + static_cast<std::size_t>(wanted.count()) * header.recordSize, header.recordSize);
}

/// Compressed files hold field after field, as a rule without padding.
void fillFromCompressed(const ReadTask& task, const PcdHeader& header, const CloudColumns& columns)
{
  const std::size_t packedAt = header.bodyOffset + 8;
  const std::size_t size = static_cast<std::size_t>(header.points * header.compressedRecordSize);
  std::string unpacked;
  unpacked.reserve(size);
  const std::size_t used =
    unpackLzf(task, task.bytes.substr(packedAt, header.compressedSize), unpacked, size);
  failDamagedIf(
    unpacked.size() < size, packedAt + used, "damaged LZF data after {} of {} bytes", unpacked.size(), size);
  failFormatIf(used < header.compressedSize || unpacked.size() > size,
    "the file is damaged or its header is wrong: copy it again", "{}more compressed data than points",
    atByte(packedAt + used));
  const bool hasPadding = header.compressedRecordSize == header.recordSize;
  const char* first = unpacked.data();
  std::vector<StoredColumn> stored;
  for (const PcdField& field : header.fields)
  {
    const std::ptrdiff_t stride = std::ptrdiff_t{ sizeOfType(field.type) } * field.count;
    addStored(field, first, stride, stored);
    first += field.isPadding() && !hasPadding ? 0 : stride * static_cast<std::ptrdiff_t>(header.points);
  }
  columns.fill(stored, task);
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
  task.noteUncounted(header.bodyOffset + lines.position(), 1);
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
