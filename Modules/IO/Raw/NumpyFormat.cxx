#include "Bytes/LittleEndian.h"
#include "Bytes/NumericType.h"
#include "FileProblem.h"
#include "IO/Bytes/TextScan.h"
#include "IO/Columns/CloudColumns.h"
#include "IO/Columns/ColumnGuess.h"
#include "IO/Formats/FormatLooks.h"
#include "IO/Text/TextTable.h"
#include "ReadTask.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <limits>

namespace pointhaptics::io
{

namespace
{

constexpr const char* kCure =
  "write an array of n rows with x, y, z: numpy.save('cloud.npy', points.astype('f4'))";
/// An array of no more rows and of more columns has its points in columns.
constexpr std::uint64_t kMostTurned = 16;

/// One column as the array stores it.
struct NumpyField
{
  std::string name;
  int type = VTK_VOID; ///< Of the values; halves are read as floats.
  std::size_t size = 0;
  bool isSwapped = false;
  std::size_t offset = 0;

  bool isHalf() const { return type == VTK_FLOAT && size == 2; }
};

struct NumpyHeader
{
  std::vector<NumpyField> fields; ///< One without a name of an array without names.
  std::vector<std::uint64_t> shape;
  bool isByColumns = false; ///< As Fortran stores it.
  std::size_t bodyOffset = 0;
};

/// Text behind "'key':" in @p text.
std::string_view valueOf(std::string_view text, const std::string& key)
{
  const std::size_t at = text.find("'" + key + "':");
  failFormatIf(at == std::string_view::npos, kCure, "the header has no {}", inQuotes(key));
  return trimmed(text.substr(at + key.size() + 3));
}

std::string_view quoted(std::string_view& text)
{
  const std::size_t begin = std::min(text.find('\''), text.size());
  const std::size_t end = std::min(text.find('\'', begin + 1), text.size());
  const std::string_view word = text.substr(std::min(begin + 1, end), end - std::min(begin + 1, end));
  text.remove_prefix(std::min(end + 1, text.size()));
  return word;
}

/// "<f4": byte order, kind, bytes.
NumpyField fieldOf(std::string_view type)
{
  NumpyField field;
  unsigned long long size = 0;
  failFormatIf(
    type.size() < 3 || !parseCount(type.substr(2), size), kCure, "the values are of type {}", inQuotes(type));
  const bool isHalf = type.substr(1) == "f2";
  field.type = type.substr(1) == "b1" ? VTK_TYPE_UINT8 : isHalf ? VTK_FLOAT : typeOfKind(type[1], size);
  field.size = static_cast<std::size_t>(size);
  failFormatIf(
    field.type == VTK_VOID, kCure, "the values are of type {}, which is not read here", inQuotes(type));
  field.isSwapped = (type[0] == '>') == kIsLittleEndianHost && (type[0] == '>' || type[0] == '<');
  return field;
}

/// "[('x', '<f4'), ('y', '<f4')]", or a type alone.
std::vector<NumpyField> fieldsOf(std::string_view descr)
{
  if (descr.empty() || descr.front() != '[')
  {
    return { fieldOf(quoted(descr)) };
  }
  std::vector<NumpyField> fields;
  std::string_view list = descr.substr(1, descr.find(']') - 1);
  std::size_t offset = 0;
  while (list.find('(') != std::string_view::npos && fields.size() < kMostColumns)
  {
    list.remove_prefix(list.find('('));
    std::string_view entry = list.substr(0, list.find(')'));
    const std::string_view name = quoted(entry);
    NumpyField field = fieldOf(quoted(entry));
    failFormatIf(
      entry.find('(') != std::string_view::npos, kCure, "the field {} holds arrays", inQuotes(name));
    field.name = name;
    field.offset = offset;
    offset += field.size;
    fields.push_back(field);
    list.remove_prefix(entry.size());
    list.remove_prefix(std::min<std::size_t>(list.size(), 1));
  }
  return fields;
}

NumpyHeader parseHeader(std::string_view bytes)
{
  const bool isLong = bytes.size() > 12 && bytes[6] > 1;
  const std::size_t begin = isLong ? 12 : 10;
  failTruncatedIf(bytes.size() < begin, "the file ends at byte {} inside its header", bytes.size());
  const std::size_t size =
    isLong ? loadLittle<std::uint32_t>(bytes.data() + 8) : loadLittle<std::uint16_t>(bytes.data() + 8);
  failTruncatedIf(
    size > bytes.size() - begin, "byte 8: a header of {} bytes in a file of {}", size, bytes.size());
  const std::string_view text = bytes.substr(begin, size);
  NumpyHeader header;
  header.bodyOffset = begin + size;
  header.fields = fieldsOf(valueOf(text, "descr"));
  header.isByColumns = valueOf(text, "fortran_order").substr(0, 4) == "True";
  std::string_view shape = valueOf(text, "shape");
  shape = shape.substr(std::min<std::size_t>(1, shape.size()), shape.find(')') - 1);
  while (!trimmed(shape).empty() && header.shape.size() < 4)
  {
    const std::size_t comma = std::min(shape.find(','), shape.size());
    unsigned long long length = 0;
    failFormatIf(!parseCount(trimmed(shape.substr(0, comma)), length), kCure,
      "the shape has {} where a count was expected", inQuotes(shape));
    header.shape.push_back(length);
    shape.remove_prefix(std::min(comma + 1, shape.size()));
  }
  return header;
}

/// @param most that the file has room for. One that is stored by columns is not read in part.
std::uint64_t rowsOf(
  ReadTask& task, const std::vector<std::uint64_t>& shape, std::uint64_t most, bool isByColumns)
{
  constexpr std::uint64_t kMany = std::uint64_t{ 1 } << 62;
  std::uint64_t rows = 1;
  for (const std::uint64_t length : shape)
  {
    length == 0 ? failNoPoints() : void();
    rows = length > kMany / rows ? kMany : rows * length;
  }
  return rows <= most ? rows
                      : task.endAt(isByColumns ? 0 : most, rows,
                          "the header has more rows than the " + std::to_string(most) + " that follow");
}

/// Values of the columns, for names: all of them for the range, the first ones as a sample.
std::vector<ColumnEvidence> evidenceOf(const std::vector<StoredColumn>& stored, vtkIdType rows)
{
  std::vector<ColumnEvidence> evidence;
  std::vector<double> values(static_cast<std::size_t>(rows));
  for (const StoredColumn& each : stored)
  {
    copyStrided(each.source, { reinterpret_cast<char*>(values.data()), sizeof(double), VTK_DOUBLE }, rows,
      each.isSwapped);
    NumberColumn column;
    for (const double value : values)
    {
      column.add(value, { std::isnan(value) || value == std::floor(value), false });
    }
    evidence.push_back(std::move(column));
  }
  return evidence;
}

/// The value of a number of 16 bits (IEEE 754 binary16).
float ofHalf(std::uint16_t bits)
{
  const int exponent = bits >> 10 & 31;
  const float fraction = static_cast<float>(bits & 1023);
  const float none = fraction > 0.0f ? std::numeric_limits<float>::quiet_NaN() : INFINITY;
  const float size = exponent == 31 ? none
    : exponent == 0                 ? std::ldexp(fraction, -24)
                                    : std::ldexp(1024.0f + fraction, exponent - 25);
  return bits >> 15 != 0 ? -size : size;
}

/// Replaces a column of halves by one of floats, which @p floats keeps.
void widen(StoredColumn& stored, vtkIdType rows, std::deque<std::vector<float>>& floats)
{
  std::vector<std::uint16_t> halves(static_cast<std::size_t>(rows));
  const ConstColumnView source{ stored.source.first, stored.source.stride, VTK_TYPE_UINT16 };
  copyStrided(source, { reinterpret_cast<char*>(halves.data()), 2, VTK_TYPE_UINT16 }, rows, stored.isSwapped);
  std::vector<float>& wide = floats.emplace_back(halves.size());
  std::transform(halves.begin(), halves.end(), wide.begin(), &ofHalf);
  stored.source = { reinterpret_cast<const char*>(wide.data()), sizeof(float), VTK_FLOAT };
  stored.isSwapped = false;
}

/// What the columns are called: as the user says, as the array does, or as their values suggest.
std::vector<std::string> namesFor(
  ReadTask& task, std::vector<std::string> names, const std::vector<StoredColumn>& stored, vtkIdType rows)
{
  failFormatIf(!task.columns.empty() && task.columns.size() != names.size(),
    "name each column, or give - for one that is left out",
    "--columns has {} names, and the array {} columns", task.columns.size(), names.size());
  if (task.columns.empty() && names[0].empty())
  {
    const GuessedColumns guessed = guessColumnNames(evidenceOf(stored, rows), false);
    const bool isSaid = names.size() > 3 || guessed.mayBeSwapped;
    isSaid ? task.notes.push_back(guessNote(guessed.names, guessed.mayBeSwapped)) : void();
    return guessed.names;
  }
  return task.columns.empty() ? names : task.columns;
}

} // namespace

bool looksLikeNumpy(const FormatStart& start)
{
  return start.bytes.substr(0, 6) == "\x93NUMPY";
}

/// An array of n rows (or h x w) with x, y, z and more, or of records with these names.
void readNumpy(ReadTask& task, vtkPolyData* cloud)
{
  task.format = "NumPy";
  const NumpyHeader header = parseHeader(task.bytes);
  const bool hasNames = !header.fields.empty() && !header.fields[0].name.empty();
  std::vector<std::uint64_t> shape = header.shape;
  const bool isTurned =
    !hasNames && shape.size() == 2 && shape[0] >= 3 && shape[0] <= kMostTurned && shape[1] > kMostTurned;
  if (isTurned)
  {
    std::swap(shape[0], shape[1]);
    task.notes.emplace_back("the points are the columns of the array, not its rows");
  }
  const std::uint64_t columns = hasNames ? header.fields.size() : shape.size() > 1 ? shape.back() : 0;
  if (!hasNames && !shape.empty())
  {
    shape.pop_back();
  }
  failFormatIf(columns < 3 || columns > kMostColumns || header.fields.empty(), kCure,
    "the array has {} columns", columns);
  const NumpyField& last = header.fields.back();
  const std::size_t value = last.size;
  const std::size_t record = hasNames ? last.offset + value : static_cast<std::size_t>(columns) * value;
  const bool isByColumns = header.isByColumns != isTurned && !hasNames;
  const std::uint64_t rows =
    rowsOf(task, shape, (task.bytes.size() - header.bodyOffset) / record, isByColumns);
  const vtkIdType count = static_cast<vtkIdType>(rows);
  std::vector<StoredColumn> stored;
  std::vector<std::string> names;
  std::deque<std::vector<float>> floats;
  for (std::size_t i = 0; i < columns; ++i)
  {
    const NumpyField& field = hasNames ? header.fields[i] : header.fields[0];
    const std::size_t at =
      hasNames ? field.offset : value * i * (isByColumns ? static_cast<std::size_t>(rows) : 1);
    names.push_back(field.name);
    stored.push_back({ { task.bytes.data() + header.bodyOffset + at,
                         static_cast<std::ptrdiff_t>(isByColumns ? value : record), field.type },
      0, 0, field.isSwapped });
    field.isHalf() ? widen(stored.back(), count, floats) : void();
  }
  names = namesFor(task, std::move(names), stored, count);
  std::vector<Column> planned;
  std::vector<StoredColumn> wanted;
  for (std::size_t i = 0; i < columns; ++i)
  {
    if (names[i] != "-") // left out
    {
      stored[i].column = planned.size();
      planned.push_back({ names[i], stored[i].source.type });
      wanted.push_back(stored[i]);
    }
  }
  CloudColumns target(planned, count);
  target.fill(wanted, task);
  target.moveTo(cloud, task);
}

} // namespace pointhaptics::io
