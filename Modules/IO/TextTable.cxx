#include "TextTable.h"

#include <algorithm>
#include <limits>

namespace pointhaptics::io
{

namespace
{

std::string_view withoutCommentMark(std::string_view line)
{
  while (!line.empty() && (line.front() == '#' || line.front() == '/'))
  {
    line.remove_prefix(1);
  }
  return trimmed(line);
}

bool isComment(std::string_view line)
{
  return line.substr(0, 1) == "#" || line.substr(0, 2) == "//";
}

char separatorOf(std::string_view line)
{
  const bool semicolon = line.find(';') != std::string_view::npos;
  return semicolon ? ';' : line.find(',') != std::string_view::npos ? ',' : ' ';
}

/// Takes the next cell, trimmed, off the front of @p line. @return false when there is none left.
bool takeCell(std::string_view& line, char separator, std::string_view& cell)
{
  if (separator == ' ')
  {
    cell = takeWord(line);
    return !cell.empty();
  }
  if (line.data() == nullptr)
  {
    return false;
  }
  const std::size_t end = line.find(separator);
  cell = trimmed(line.substr(0, end));
  line = end == std::string_view::npos ? std::string_view{} : line.substr(end + 1);
  return true;
}

std::vector<std::string_view> cellsOf(std::string_view line, char separator)
{
  std::vector<std::string_view> cells;
  std::string_view cell;
  while (takeCell(line, separator, cell))
  {
    cells.push_back(cell);
  }
  while (!cells.empty() && cells.back().empty())
  {
    cells.pop_back();
  }
  return cells;
}

/// No cell is a number: names, not a line of data with a fault in it.
bool isHeader(const std::vector<std::string_view>& cells)
{
  double value = 0.0;
  return !cells.empty() &&
    std::none_of(cells.begin(), cells.end(), [&](std::string_view cell) { return parseNumber(cell, value); });
}

/// ParaView writes "Points:0" for x.
std::string columnName(std::string_view cell)
{
  while (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"')
  {
    cell = trimmed(cell.substr(1, cell.size() - 2));
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    if (equalNoCase(cell, "Points:" + std::to_string(axis)) ||
      equalNoCase(cell, "Points_" + std::to_string(axis)))
    {
      return std::string(1, "xyz"[axis]);
    }
  }
  return std::string(cell);
}

std::vector<std::string> columnNames(const std::vector<std::string_view>& cells)
{
  std::vector<std::string> names;
  for (const std::string_view cell : cells)
  {
    names.push_back(columnName(cell));
  }
  return names;
}

bool namesCoordinates(const std::vector<std::string>& names)
{
  for (const char* axis : { "x", "y", "z" })
  {
    if (std::none_of(
          names.begin(), names.end(), [&](const std::string& name) { return equalNoCase(name, axis); }))
    {
      return false;
    }
  }
  return true;
}

/// Parses the lines of data; one object per file.
class TableParser
{
public:
  TableParser(const TextLayout& layout, std::size_t bytes)
    : layout_(layout)
    , table_(layout.columns)
    , remainingLines_(layout.hasPointCount ? 0 : std::numeric_limits<unsigned long long>::max())
    , bytes_(bytes)
  {
  }
  void addLine(std::string_view line, std::size_t lineNumber);
  void finish() const;
  std::vector<DecimalColumn> take() { return std::move(table_); }

private:
  void startBlock(std::string_view line, std::size_t lineNumber);
  void addCell(std::size_t column, std::string_view cell, std::size_t lineNumber);

  const TextLayout& layout_;
  std::vector<DecimalColumn> table_;
  unsigned long long remainingLines_;
  std::size_t bytes_;
};

void TableParser::startBlock(std::string_view line, std::size_t lineNumber)
{
  const std::string where = "line " + std::to_string(lineNumber) + ": ";
  if (!parseCount(trimmed(line), remainingLines_))
  {
    failFormat(where + inQuotes(line) + " stands where a count of points was expected",
      "write the right number of points in the first line");
  }
  if (remainingLines_ > bytes_)
  {
    failTruncated(where + "the count of points is " + std::to_string(remainingLines_) + " in a file of " +
      std::to_string(bytes_) + " bytes");
  }
}

void TableParser::addCell(std::size_t column, std::string_view cell, std::size_t lineNumber)
{
  double value = std::numeric_limits<double>::quiet_NaN();
  if (cell.empty())
  {
    table_[column].add("nan", value); // a spreadsheet's way to say: not measured
    return;
  }
  if (!parseNumber(cell, value))
  {
    failFormat("line " + std::to_string(lineNumber) + ", column " + std::to_string(column + 1) + ": " +
        inQuotes(cell) + " is not a number",
      "write numbers with a decimal point, the same separator on every line, and comments after #");
  }
  table_[column].add(cell, value);
}

void TableParser::addLine(std::string_view line, std::size_t lineNumber)
{
  if (remainingLines_ == 0)
  {
    startBlock(line, lineNumber);
    return;
  }
  std::string_view rest = line;
  std::string_view cell;
  std::size_t column = 0;
  bool tooMany = false;
  while (takeCell(rest, layout_.separator, cell))
  {
    if (column < table_.size())
    {
      addCell(column++, cell, lineNumber);
    }
    else
    {
      tooMany = tooMany || !cell.empty(); // a separator at the end of a line is common
    }
  }
  if (column < table_.size() || tooMany)
  {
    failFormat("line " + std::to_string(lineNumber) + ": " +
        std::to_string(cellsOf(line, layout_.separator).size()) + " columns where " +
        std::to_string(table_.size()) + " were expected",
      "write the same number of columns on every line");
  }
  --remainingLines_;
}

void TableParser::finish() const
{
  if (layout_.hasPointCount && remainingLines_ > 0)
  {
    failTruncated("the file ends " + std::to_string(remainingLines_) +
      " points before the count in its first line is reached");
  }
}

} // namespace

TextLayout inspectText(std::string_view text)
{
  TextLayout layout;
  std::string_view lastComment;
  std::string_view line;
  LineReader lines(text);
  std::size_t lineStart = 0;
  for (; lines.next(line); lineStart = lines.position())
  {
    line = trimmed(line);
    if (line.empty())
    {
      continue;
    }
    if (isComment(line))
    {
      const std::string_view comment = withoutCommentMark(line);
      lastComment = comment.empty() ? lastComment : comment;
      continue;
    }
    const char separator = separatorOf(line);
    const std::vector<std::string_view> cells = cellsOf(line, separator);
    unsigned long long count = 0;
    if (layout.names.empty() && isHeader(cells))
    {
      layout.names = columnNames(cells);
      layout.bodyOffset = lines.position();
      layout.bodyLine = lines.lineNumber() + 1;
      continue;
    }
    if (layout.names.empty() && !layout.hasPointCount && cells.size() == 1 && parseCount(cells[0], count))
    {
      layout.hasPointCount = true;
      layout.bodyOffset = lineStart;
      layout.bodyLine = lines.lineNumber();
      continue;
    }
    layout.separator = separator;
    layout.columns = cells.size();
    break;
  }
  if (layout.names.empty() && !lastComment.empty())
  {
    const std::vector<std::string> names = columnNames(cellsOf(lastComment, separatorOf(lastComment)));
    if (names.size() == layout.columns && namesCoordinates(names))
    {
      layout.names = names;
    }
  }
  // A cell may be empty at the end of the first line: the header knows better.
  if (layout.separator != ' ' && layout.columns < layout.names.size())
  {
    layout.columns = layout.names.size();
  }
  return layout;
}

std::vector<DecimalColumn> parseTable(const ReadTask& task, std::string_view text, const TextLayout& layout)
{
  TableParser parser(layout, text.size());
  LineReader lines(text.substr(layout.bodyOffset), layout.bodyLine);
  std::string_view line;
  while (lines.next(line))
  {
    line = trimmed(line);
    if (!line.empty() && !isComment(line))
    {
      parser.addLine(line, lines.lineNumber());
    }
    if (lines.lineNumber() % static_cast<std::size_t>(kProgressRows) == 0)
    {
      task.progress(
        static_cast<double>(layout.bodyOffset + lines.position()) / static_cast<double>(text.size()));
    }
  }
  parser.finish();
  return parser.take();
}

} // namespace pointhaptics::io
