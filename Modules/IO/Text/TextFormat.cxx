#include "FormatReaders.h"

#include "CloudColumns.h"
#include "CloudFormat.h"
#include "IO/Text/TextTable.h"

#include <algorithm>

namespace pointhaptics::io
{

namespace
{

bool areBytes(const std::vector<NumberColumn>& table, std::size_t first)
{
  return table[first].isByte() && table[first + 1].isByte() && table[first + 2].isByte();
}

/// Names for a table without header.
std::vector<std::string> guessNames(const std::vector<NumberColumn>& table)
{
  const std::size_t count = table.size();
  if (count == 4)
  {
    return { "x", "y", "z", "intensity" };
  }
  if (count == 6 && areBytes(table, 3))
  {
    return { "x", "y", "z", "red", "green", "blue" };
  }
  if (count == 6)
  {
    return { "x", "y", "z", "nx", "ny", "nz" };
  }
  if (count == 7 && areBytes(table, 4))
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
  return isColorName(name) && column.isByte() ? VTK_TYPE_UINT8 : column.type();
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

} // namespace

void readTable(const ReadTask& task, std::string_view text, const TextLayout& layout, vtkPolyData* cloud)
{
  const TextTable table = surveyTable(task, text, layout);
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
  CloudColumns columns(planned, table.rows);
  std::vector<ColumnView> targets;
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    targets.push_back(columns.target(i));
  }
  storeTable(task, text, layout, targets);
  columns.moveTo(cloud);
}

void readText(ReadTask& task, vtkPolyData* cloud)
{
  task.format = "text";
  const std::string_view text = withoutByteOrderMark(task.bytes);
  const TextLayout layout = inspectText(text);
  task.format = layout.hasPointCount ? "PTS" : std::string("text (") + separatorName(layout) + ")";
  if (layout.columns == 0)
  {
    failNoPoints();
  }
  if (layout.columns < 3 || (!layout.names.empty() && layout.names.size() != layout.columns))
  {
    failFormat("the first line of data has " + std::to_string(layout.columns) + " columns" +
        (layout.names.empty() ? "" : " and the header names " + std::to_string(layout.names.size())),
      "write one point per line: x y z, then one column per name of the header");
  }
  readTable(task, text, layout, cloud);
}

} // namespace pointhaptics::io
