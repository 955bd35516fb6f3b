#include "IO/WriteTask.h"

#include "Bytes/NumericType.h"
#include "IO/Text/TextCells.h"

#include <charconv>
#include <cstring>
#include <iomanip>
#include <sstream>

namespace pointhaptics::io
{

namespace
{

constexpr std::size_t kLongestNumber = 32;
constexpr std::size_t kFlushAt = 1 << 16;

/// Appends one number to the line: a function per type, chosen once per column.
using Append = char* (*)(const char* from, char* to);

template <typename T>
char* appendNumber(const char* from, char* to)
{
  T value;
  std::memcpy(&value, from, sizeof(T));
  if constexpr (sizeof(T) == 1)
  {
    return std::to_chars(to, to + kLongestNumber, static_cast<int>(value)).ptr;
  }
  else
  {
    return std::to_chars(to, to + kLongestNumber, value).ptr;
  }
}

struct TableColumn
{
  ConstColumnView view;
  Append append = nullptr;
};

std::string nameOf(const OutputArray& array, int component, const WriteTask& task, char separator)
{
  if (array.role == ArrayRole::Points)
  {
    const bool isHeight = component == 2 && task.comments.unit.rfind("deg", 0) == 0; // a length
    const std::string& unit = isHeight ? task.comments.heightUnit : task.comments.unit;
    return std::string(1, "xyz"[component]) + (separator == ',' && !unit.empty() ? " [" + unit + "]" : "");
  }
  const std::string name = array.componentName(component);
  const bool isBare =
    separator == ' ' || (name.find_first_of(",;|\"# /") == std::string::npos && !isComment(name));
  if (isBare)
  {
    return name;
  }
  std::ostringstream quoted;
  quoted << std::quoted(name, '"', '"');
  return quoted.str();
}

/// A column per component and a line of their names; each number with the fewest digits that give it back
/// exactly. Between spaces the names are a comment ("//x y z ..."), which programs that take bare numbers
/// leave out, and white space inside a name becomes '_'. A unit and such names stand in comments behind it;
/// between commas the unit stands in brackets after x, y and z.
void writeTable(WriteTask& task, char separator)
{
  std::vector<OutputArray> arrays = outputArrays(task.cloud, task.notes);
  const auto columnsOf = [](const OutputArray& array)
  {
    std::vector<Column> columns = columnsByComponent(array);
    for (std::size_t i = 0; i < columns.size(); ++i)
    {
      columns[i].type = VTK_FLOAT; // columns of text have no types
      columns[i].name = array.role == ArrayRole::Points ? std::string(1, "xyz"[i]) : columns[i].name;
    }
    return columns;
  };
  const bool isCsv = separator == ',';
  chooseNames(arrays, columnsOf,
    { isCsv ? NameRule::Any : NameRule::Cells, std::string::npos, isCsv ? nullptr : &task.comments },
    task.notes);
  const std::string mark = separator == ' ' ? "//" : "";
  std::string header;
  std::vector<TableColumn> columns;
  for (const OutputArray& array : arrays)
  {
    for (int component = 0; component < array.components(); ++component)
    {
      header += header.empty() ? mark : std::string(1, separator);
      header += nameOf(array, component, task, separator);
      TableColumn column;
      column.view = array.column(component);
      withType(array.type(), [&](auto zero) { column.append = &appendNumber<decltype(zero)>; });
      columns.push_back(column);
    }
  }
  task.out.write(header + "\n" + (isCsv ? "" : task.comments.lines("//")));
  std::vector<char> buffer(kFlushAt + columns.size() * (kLongestNumber + 1));
  char* end = buffer.data();
  const vtkIdType rows = arrays[0].array->GetNumberOfTuples();
  for (vtkIdType row = 0; row < rows; ++row)
  {
    if (row % kProgressRows == 0)
    {
      task.progress(static_cast<double>(row) / static_cast<double>(rows));
    }
    for (const TableColumn& column : columns)
    {
      end = column.append(column.view.first + row * column.view.stride, end);
      *end++ = separator;
    }
    end[-1] = '\n';
    if (static_cast<std::size_t>(end - buffer.data()) >= kFlushAt)
    {
      task.out.write(buffer.data(), static_cast<std::size_t>(end - buffer.data()));
      end = buffer.data();
    }
  }
  task.out.write(buffer.data(), static_cast<std::size_t>(end - buffer.data()));
  task.progress(1.0);
}

} // namespace

void writeCsv(WriteTask& task)
{
  writeTable(task, ',');
}

void writeXyz(WriteTask& task)
{
  writeTable(task, ' ');
}

} // namespace pointhaptics::io
