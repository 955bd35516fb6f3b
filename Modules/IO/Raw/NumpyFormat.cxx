#include "Bytes/LittleEndian.h"
#include "Bytes/NumericType.h"
#include "IO/Bytes/TextScan.h"
#include "IO/Columns/CloudColumns.h"
#include "IO/Columns/ColumnGuess.h"
#include "IO/Formats/FormatLooks.h"
#include "ReadTask.h"

#include "Bytes/Checks.h"
#include <algorithm>
#include <cmath>

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
  int type = VTK_VOID;
  bool isSwapped = false;
  std::size_t offset = 0;
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
  field.type = type.substr(1) == "b1" ? VTK_TYPE_UINT8 : typeOfKind(type[1], size);
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
    offset += static_cast<std::size_t>(sizeOfType(field.type));
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

/// Values of @p sources, for names: all of them for the range, the first ones as a sample.
std::vector<ColumnEvidence> evidenceOf(
  const std::vector<ConstColumnView>& sources, vtkIdType rows, bool isSwapped)
{
  std::vector<ColumnEvidence> evidence;
  std::vector<double> values(static_cast<std::size_t>(rows));
  for (const ConstColumnView& source : sources)
  {
    copyStrided(
      source, { reinterpret_cast<char*>(values.data()), sizeof(double), VTK_DOUBLE }, rows, isSwapped);
    const bool isWhole =
      std::all_of(values.begin(), values.end(), [](double v) { return std::isnan(v) || v == std::floor(v); });
    ColumnEvidence column = ColumnEvidence::of(values, isWhole);
    column.sample.resize(std::min(column.sample.size(), kGuessedRows));
    evidence.push_back(std::move(column));
  }
  return evidence;
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
  const std::size_t value = static_cast<std::size_t>(sizeOfType(last.type));
  const std::size_t record = hasNames ? last.offset + value : static_cast<std::size_t>(columns) * value;
  const bool isByColumns = header.isByColumns != isTurned && !hasNames;
  const std::uint64_t rows =
    rowsOf(task, shape, (task.bytes.size() - header.bodyOffset) / record, isByColumns);
  std::vector<Column> planned;
  std::vector<ConstColumnView> sources;
  for (std::size_t i = 0; i < columns; ++i)
  {
    const NumpyField& field = hasNames ? header.fields[i] : header.fields[0];
    const std::size_t at =
      hasNames ? field.offset : value * i * (isByColumns ? static_cast<std::size_t>(rows) : 1);
    planned.push_back({ field.name, field.type });
    sources.push_back({ task.bytes.data() + header.bodyOffset + at,
      static_cast<std::ptrdiff_t>(isByColumns ? value : record), field.type });
  }
  const vtkIdType count = static_cast<vtkIdType>(rows);
  if (!hasNames)
  {
    const std::vector<std::string> names =
      guessColumnNames(evidenceOf(sources, count, last.isSwapped), false);
    for (std::size_t i = 0; i < columns; ++i)
    {
      planned[i].name = names[i];
    }
    if (columns > 3)
    {
      task.notes.push_back(guessNote(names));
    }
  }
  CloudColumns target(planned, count);
  std::vector<StoredColumn> stored;
  for (std::size_t i = 0; i < columns; ++i)
  {
    stored.push_back({ sources[i], i, 0, (hasNames ? header.fields[i] : last).isSwapped });
  }
  target.fill(stored, task);
  target.moveTo(cloud, task);
}

} // namespace pointhaptics::io
