#include "FormatReaders.h"

#include "CloudColumns.h"
#include "NumericType.h"
#include "PcdHeader.h"
#include "PcdPcl.h"
#include "TextScan.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>

namespace pointhaptics::io
{

namespace
{

/// Stores one number of an ASCII record in its place in a binary record.
void storeInRecord(char* record, const PcdField& field, int component, std::string_view word, double value,
  std::size_t lineNumber)
{
  char* first = record + field.offset + static_cast<std::size_t>(component * sizeOfType(field.type));
  if (!storeNumber({ first, 0, field.type }, 0, value))
  {
    failFormat("line " + std::to_string(lineNumber) + ": field " + inQuotes(field.name) + " is " +
        inQuotes(word) + ", which its integer type cannot hold",
      "give the field TYPE F in the header");
  }
}

void parseAsciiRecord(std::string_view line, std::size_t lineNumber, const PcdHeader& header, char* record)
{
  for (const PcdField& field : header.fields)
  {
    for (int component = 0; component < field.count; ++component)
    {
      const std::string_view word = takeWord(line);
      double value = 0.0;
      if (!parseNumber(word, value))
      {
        failFormat("line " + std::to_string(lineNumber) + ": field " + inQuotes(field.name) + " is " +
            (word.empty() ? std::string("missing") : inQuotes(word) + ", not a number"),
          "write one number per field and one point per line");
      }
      storeInRecord(record, field, component, word, value, lineNumber);
    }
  }
  const std::string_view extra = takeWord(line);
  if (!extra.empty())
  {
    failFormat("line " + std::to_string(lineNumber) + ": " + inQuotes(extra) + " follows the last field",
      "write as many numbers per line as the header has fields");
  }
}

/// The ASCII points as binary records. Not left to PCL, which names no line when a number is malformed.
std::vector<std::uint8_t> readAsciiRecords(const ReadTask& task, const PcdHeader& header)
{
  std::vector<std::uint8_t> records(header.points * header.recordSize);
  LineReader lines(task.bytes.substr(header.bodyOffset), header.bodyLine);
  std::string_view line;
  unsigned long long point = 0;
  while (point < header.points && lines.next(line))
  {
    if (trimmed(line).empty())
    {
      continue;
    }
    char* record = reinterpret_cast<char*>(records.data()) + point * header.recordSize;
    parseAsciiRecord(line, lines.lineNumber(), header, record);
    if (++point % kProgressRows == 0)
    {
      task.progress(static_cast<double>(point) / static_cast<double>(header.points));
    }
  }
  if (point < header.points)
  {
    failTruncated("the file ends at line " + std::to_string(lines.lineNumber()) + " after " +
      std::to_string(point) + " of " + std::to_string(header.points) + " points");
  }
  return records;
}

/// PCD packs colours as 0xAARRGGBB.
void unpackColours(ConstColumnView packed, const CloudColumns& columns, std::size_t column, int channels,
  vtkIdType row, vtkIdType count)
{
  char* to = columns.target(column).fromRow(row).first;
  const char* from = packed.first;
  for (vtkIdType i = 0; i < count; ++i, from += packed.stride, to += channels)
  {
    std::uint32_t colour = 0;
    std::memcpy(&colour, from, sizeof(colour));
    const std::uint32_t bytes[4] = { colour >> 16, colour >> 8, colour, colour >> 24 };
    for (int channel = 0; channel < channels; ++channel)
    {
      to[channel] = static_cast<char>(static_cast<std::uint8_t>(bytes[channel] & 0xff));
    }
  }
}

std::vector<Column> columnsOf(const std::vector<PcdField>& fields)
{
  std::vector<Column> columns;
  for (const PcdField& field : fields)
  {
    if (field.isPackedColour())
    {
      const bool hasAlpha = field.name == "rgba";
      columns.push_back({ hasAlpha ? "RGBA" : "RGB", VTK_TYPE_UINT8, hasAlpha ? 4 : 3 });
    }
    else
    {
      columns.push_back({ field.name, field.type, field.count });
    }
  }
  return columns;
}

void fillColumns(const ReadTask& task, const PcdHeader& header, const std::vector<PcdField>& fields,
  const char* records, const CloudColumns& columns)
{
  const vtkIdType rows = static_cast<vtkIdType>(header.points);
  const std::ptrdiff_t stride = static_cast<std::ptrdiff_t>(header.recordSize);
  for (vtkIdType row = 0; row < rows; row += kProgressRows)
  {
    const vtkIdType count = std::min(kProgressRows, rows - row);
    for (std::size_t i = 0; i < fields.size(); ++i)
    {
      const char* first = records + row * stride + fields[i].offset;
      if (fields[i].isPackedColour())
      {
        unpackColours(
          { first, stride, fields[i].type }, columns, i, fields[i].name == "rgba" ? 4 : 3, row, count);
        continue;
      }
      for (int component = 0; component < fields[i].count; ++component)
      {
        copyStrided({ first + component * sizeOfType(fields[i].type), stride, fields[i].type },
          columns.target(i, component).fromRow(row), count);
      }
    }
    task.progress(0.5 + 0.5 * static_cast<double>(row + count) / static_cast<double>(rows));
  }
}

void addFieldData(const PcdHeader& header, vtkPolyData* cloud)
{
  vtkNew<vtkDoubleArray> viewpoint;
  viewpoint->SetName("Viewpoint");
  viewpoint->SetNumberOfComponents(7);
  viewpoint->InsertNextTuple(header.viewpoint.data());
  cloud->GetFieldData()->AddArray(viewpoint);
  const unsigned long long most = std::numeric_limits<int>::max();
  if (header.height > 1 && header.width <= most && header.height <= most)
  {
    vtkNew<vtkIntArray> dimensions;
    dimensions->SetName("OrganizedDimensions");
    dimensions->SetNumberOfComponents(2);
    const int values[2] = { static_cast<int>(header.width), static_cast<int>(header.height) };
    dimensions->InsertNextTypedTuple(values);
    cloud->GetFieldData()->AddArray(dimensions);
  }
}

} // namespace

void readPcd(ReadTask& task, vtkPolyData* cloud)
{
  const PcdHeader header = parsePcdHeader(task.bytes);
  task.format = std::string("PCD (") + nameOf(header.encoding) + ")";
  std::vector<PcdField> fields;
  std::copy_if(header.fields.begin(), header.fields.end(), std::back_inserter(fields),
    [](const PcdField& field) { return !field.isPadding(); });
  task.progress(0.0);
  const std::vector<std::uint8_t> records = header.encoding == PcdEncoding::Ascii
    ? readAsciiRecords(task, header)
    : readPcdRecords(task.path, header);
  CloudColumns columns(columnsOf(fields), static_cast<vtkIdType>(header.points));
  fillColumns(task, header, fields, reinterpret_cast<const char*>(records.data()), columns);
  columns.moveTo(cloud);
  addFieldData(header, cloud);
}

} // namespace pointhaptics::io
