#include "FormatReaders.h"

#include "CloudColumns.h"
#include "CloudFormat.h"
#include "DecimalColumn.h"
#include "TextScan.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pointhaptics::io
{

namespace
{

constexpr std::size_t kMostNumbers = 7;

/// The numbers of one line, at most kMostNumbers of them.
struct Numbers
{
  std::array<std::string_view, kMostNumbers> words;
  std::array<double, kMostNumbers> values{};
  std::size_t count = 0;
};

Numbers parseNumbers(std::string_view line, std::size_t lineNumber)
{
  Numbers numbers;
  for (std::string_view word = takeWord(line); !word.empty(); word = takeWord(line))
  {
    if (word.front() == '#')
    {
      break;
    }
    if (numbers.count == kMostNumbers || !parseNumber(word, numbers.values[numbers.count]))
    {
      failFormat("line " + std::to_string(lineNumber) + ": " + inQuotes(word) +
          (numbers.count == kMostNumbers ? " is one number too many" : " is not a number"),
        "a vertex is: v x y z, with r g b after it if it is coloured");
    }
    numbers.words[numbers.count++] = word;
  }
  return numbers;
}

struct ObjContent
{
  std::array<DecimalColumn, 3> position;
  std::array<std::vector<double>, 3> colour;
  std::array<DecimalColumn, 3> normal;

  std::size_t count() const { return position[0].values().size(); }
  bool isColoured() const { return colour[0].size() == count(); }
  bool hasNormalPerVertex() const { return normal[0].values().size() == count(); }
};

void addVertex(ObjContent& content, const Numbers& numbers, std::size_t lineNumber)
{
  // x y z, x y z w, x y z r g b, x y z w r g b
  if (numbers.count < 3 || numbers.count == 5)
  {
    failFormat(
      "line " + std::to_string(lineNumber) + ": a vertex of " + std::to_string(numbers.count) + " numbers",
      "a vertex is: v x y z, with r g b after it if it is coloured");
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    content.position[axis].add(numbers.words[axis], numbers.values[axis]);
    if (numbers.count >= 6)
    {
      content.colour[axis].push_back(numbers.values[numbers.count - 3 + axis]);
    }
  }
}

void addNormal(ObjContent& content, const Numbers& numbers, std::size_t lineNumber)
{
  if (numbers.count != 3)
  {
    failFormat(
      "line " + std::to_string(lineNumber) + ": a normal of " + std::to_string(numbers.count) + " numbers",
      "a normal is: vn x y z");
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    content.normal[axis].add(numbers.words[axis], numbers.values[axis]);
  }
}

ObjContent parseObj(const ReadTask& task, std::string_view text)
{
  ObjContent content;
  LineReader lines(text);
  std::string_view line;
  while (lines.next(line))
  {
    const std::size_t number = lines.lineNumber();
    const std::string_view keyword = takeWord(line);
    if (keyword == "v")
    {
      addVertex(content, parseNumbers(line, number), number);
    }
    else if (keyword == "vn")
    {
      addNormal(content, parseNumbers(line, number), number);
    }
    if (number % static_cast<std::size_t>(kProgressRows) == 0)
    {
      task.progress(static_cast<double>(lines.position()) / static_cast<double>(text.size()));
    }
  }
  return content;
}

void copyValues(const std::vector<double>& values, ColumnView target)
{
  copyStrided({ reinterpret_cast<const char*>(values.data()), sizeof(double), VTK_DOUBLE }, target,
    static_cast<vtkIdType>(values.size()));
}

/// Colours as bytes. Files hold 0..1; some programs write 0..255.
void copyColour(const std::vector<double>& values, double scale, ColumnView target)
{
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const double scaled = std::isfinite(values[i]) ? std::round(scale * values[i]) : 0.0;
    storeNumber(target, static_cast<vtkIdType>(i), std::clamp(scaled, 0.0, 255.0));
  }
}

} // namespace

void readObj(ReadTask& task, vtkPolyData* cloud)
{
  task.format = "OBJ";
  const ObjContent content = parseObj(task, withoutByteOrderMark(task.bytes));
  if (content.count() == 0)
  {
    failNoPoints();
  }
  std::vector<Column> names;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    names.push_back({ std::string(1, "xyz"[axis]), content.position[axis].floatingType() });
  }
  for (std::size_t axis = 0; axis < 3 && content.hasNormalPerVertex(); ++axis)
  {
    names.push_back({ std::string("n") + "xyz"[axis], content.normal[axis].floatingType() });
  }
  const std::size_t colours = names.size();
  if (content.isColoured())
  {
    names.push_back({ "RGB", VTK_TYPE_UINT8, 3 });
  }
  CloudColumns columns(names, static_cast<vtkIdType>(content.count()));
  double brightest = 0.0;
  for (const std::vector<double>& channel : content.colour)
  {
    brightest =
      channel.empty() ? brightest : std::max(brightest, *std::max_element(channel.begin(), channel.end()));
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    copyValues(content.position[axis].values(), columns.target(axis));
    if (content.hasNormalPerVertex())
    {
      copyValues(content.normal[axis].values(), columns.target(3 + axis));
    }
    if (content.isColoured())
    {
      copyColour(
        content.colour[axis], brightest > 1.0 ? 1.0 : 255.0, columns.target(colours, static_cast<int>(axis)));
    }
  }
  columns.moveTo(cloud);
}

} // namespace pointhaptics::io
