#include "FormatReaders.h"

#include "CloudColumns.h"
#include "CloudFormat.h"
#include "IO/Text/TextPart.h"
#include "IO/Text/TextTable.h"

#include <algorithm>

namespace pointhaptics::io
{

namespace
{

/// Integers as colours of 8 or 16 bits are.
bool areColors(const std::vector<NumberColumn>& table, std::size_t first)
{
  return std::all_of(table.begin() + first, table.begin() + first + 3,
    [](const NumberColumn& column) { return column.isInteger(65535.0); });
}

/// Names for a table without header.
std::vector<std::string> guessNames(const std::vector<NumberColumn>& table)
{
  const std::size_t count = table.size();
  if (count == 4)
  {
    return { "x", "y", "z", "intensity" };
  }
  if (count == 6 && areColors(table, 3))
  {
    return { "x", "y", "z", "red", "green", "blue" };
  }
  if (count == 6)
  {
    return { "x", "y", "z", "nx", "ny", "nz" };
  }
  if (count == 7 && areColors(table, 4))
  {
    return { "x", "y", "z", "intensity", "red", "green", "blue" };
  }
  std::vector<std::string> names = { "x", "y", "z" };
  for (std::size_t i = 4; i <= count; ++i)
  {
    names.push_back("column_" + std::to_string(i));
  }
  return names;
}

bool isOneOf(const std::string& name, std::initializer_list<const char*> known)
{
  return std::any_of(known.begin(), known.end(), [&](const char* each) { return equalNoCase(name, each); });
}

bool isColorName(const std::string& name)
{
  return isOneOf(name,
    { "red", "green", "blue", "alpha", "r", "g", "b", "a", "RGB_0", "RGB_1", "RGB_2", "RGB:0", "RGB:1",
      "RGB:2", "RGBA_0", "RGBA_1", "RGBA_2", "RGBA_3", "RGBA:0", "RGBA:1", "RGBA:2", "RGBA:3" });
}

int typeOf(const std::string& name, const NumberColumn& column)
{
  if (isOneOf(name, { "x", "y", "z", "nx", "ny", "nz", "normal_x", "normal_y", "normal_z" }))
  {
    return column.floatingType();
  }
  if (isColorName(name) && column.isInteger(255.0))
  {
    return VTK_TYPE_UINT8;
  }
  return isOneOf(name, { "red", "green", "blue", "r", "g", "b" }) && column.isInteger(65535.0)
    ? VTK_TYPE_UINT16
    : column.type();
}

const char* separatorName(const TextLayout& layout)
{
  switch (layout.separator)
  {
    case ',':
      return "comma separated";
    case ';':
      return "semicolon separated";
    default:
      return "space separated";
  }
}

/// What all ranks found, each in its lines.
TextTable ofAll(SharedReading& shared, const TextTable& own)
{
  TextTable all;
  all.columns.resize(own.columns.size());
  for (const std::string& bytes : shared.gather(bytesOfValues(own.columns)))
  {
    const auto columns = valuesOfBytes<NumberColumn>(bytes);
    for (std::size_t i = 0; i < columns.size() && i < all.columns.size(); ++i)
    {
      all.columns[i].add(columns[i]);
    }
  }
  for (const std::int64_t rows : shared.gatherValues(std::int64_t{ own.rows }))
  {
    all.rows += static_cast<vtkIdType>(rows);
  }
  return all;
}

/// The layout of a text, of which the start may be all that was loaded.
TextLayout layoutOf(ReadTask& task, std::string_view text)
{
  const std::string_view start = text.substr(0, kStartOfText);
  TextLayout layout;
  if (task.shared)
  {
    layout = inspectText(start.substr(0, start.rfind('\n') + 1));
  }
  if (layout.columns == 0 || layout.hasPointCount)
  {
    task.takeWhole();
    layout = inspectText(text);
  }
  return layout;
}

} // namespace

void readTable(ReadTask& task, std::string_view text, TextLayout layout, vtkPolyData* cloud)
{
  const TextPart part = partOfText(task, text, layout.bodyOffset, layout.bodyLine);
  text = text.substr(0, part.end);
  layout.bodyOffset = part.begin;
  layout.bodyLine = part.firstLine;
  const TextTable own = surveyTable(task, text, layout);
  const TextTable table = task.shared ? ofAll(*task.shared, own) : own;
  if (table.rows == 0)
  {
    failNoPoints();
  }
  const std::vector<std::string> names = layout.names.empty() ? guessNames(table.columns) : layout.names;
  std::vector<Column> planned;
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    planned.push_back({ names[i], typeOf(names[i], table.columns[i]) });
  }
  CloudColumns columns(planned, own.rows);
  std::vector<ColumnView> targets;
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    targets.push_back(columns.target(i));
  }
  storeTable(task, text, layout, targets);
  columns.moveTo(cloud, task.shared);
}

void readText(ReadTask& task, vtkPolyData* cloud)
{
  task.format = "text";
  task.need(0, kStartOfText);
  const std::string_view text = withoutByteOrderMark(task.bytes);
  const TextLayout layout = layoutOf(task, text);
  const bool isBlank = layout.columns == 0 && layout.names.empty();
  task.format = layout.hasPointCount ? "PTS"
    : isBlank                        ? "text"
                                     : std::string("text (") + separatorName(layout) + ")";
  if (layout.columns == 0)
  {
    failNoPoints();
  }
  if (layout.hasPointCount && layout.columns < 3)
  {
    failFormat("the first line of data has " + std::to_string(layout.columns) +
        (layout.columns == 1 ? " column" : " columns"),
      "write one point per line: x y z; a PTX file, with the scanner's place before its points, is not read: "
      "export it as E57 or PTS");
  }
  if (layout.columns < 3 || (!layout.names.empty() && layout.names.size() != layout.columns))
  {
    failFormat("the first line of data has " + std::to_string(layout.columns) +
        (layout.columns == 1 ? " column" : " columns") +
        (layout.names.empty() ? "" : " and the header names " + std::to_string(layout.names.size())),
      "write one point per line: x y z, then one column per name of the header");
  }
  readTable(task, text, layout, cloud);
}

} // namespace pointhaptics::io
