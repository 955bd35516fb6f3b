#include "IO/Text/TextTable.h"

#include "IO/Columns/CloudColumns.h"
#include "IO/Info/FieldText.h"
#include "IO/Text/TextCells.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>

namespace pointhaptics::io
{

namespace
{

/// Bytes of a comment that may be a header: enough for kMostColumns one-letter names, and never more.
constexpr std::size_t kLongestHeader = 2 * kMostColumns;

std::string_view withoutCommentMark(std::string_view line)
{
  while (!line.empty() && (line.front() == '#' || line.front() == '/'))
  {
    line.remove_prefix(1);
  }
  return trimmed(line);
}

/// No cell is a number: names, not a line of data with a fault in it.
bool isHeader(const std::vector<std::string_view>& cells)
{
  double value = 0.0;
  return !cells.empty() &&
    std::none_of(cells.begin(), cells.end(), [&](std::string_view cell) { return parseCell(cell, value); });
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

/// Of @p columns; empty where @p comment names no coordinates: prose is no header, however long it is.
std::vector<std::string> namesInComment(std::string_view comment, std::size_t columns, std::size_t lineNumber)
{
  const std::string_view start = comment.substr(0, kLongestHeader);
  const std::vector<std::string> names = columnNames(cellsOf(start, separatorOf(start), lineNumber));
  return names.size() == columns && namesCoordinates(names) ? names : std::vector<std::string>();
}

/// Walks over the lines of data and shows each cell to a Sink: number(column, value, shape), empty(column),
/// text(column, cell, lineNumber), endRow().
template <typename Sink>
class TableWalk
{
public:
  TableWalk(const TextLayout& layout, std::size_t bytes, Sink& sink)
    : layout_(layout)
    , sink_(sink)
    , remainingLines_(layout.hasPointCount ? 0 : std::numeric_limits<unsigned long long>::max())
    , bytes_(bytes)
  {
  }
  void run(const ReadTask& task, std::string_view text, double from, double to);

private:
  void addLine(std::string_view line);
  void addWords(std::string_view line);
  void addSeparated(std::string_view line);
  void startBlock(std::string_view line);
  std::string where() const { return "line " + std::to_string(lineNumber_); }
  [[noreturn]] void failColumns(std::string_view line) const;

  const TextLayout& layout_;
  Sink& sink_;
  unsigned long long remainingLines_;
  std::size_t bytes_;
  std::size_t lineNumber_ = 0;
};

template <typename Sink>
void TableWalk<Sink>::failColumns(std::string_view line) const
{
  failFormat(where() + ": " + std::to_string(cellsOf(line, layout_.separator, lineNumber_).size()) +
      " columns where " + std::to_string(layout_.columns) + " were expected",
    "write the same number of columns on every line");
}

template <typename Sink>
void TableWalk<Sink>::startBlock(std::string_view line)
{
  if (!parseCount(trimmed(line), remainingLines_))
  {
    failFormat(where() + ": " + inQuotes(line) + " stands where a count of points was expected",
      "write the right number of points in the first line");
  }
  if (remainingLines_ > bytes_)
  {
    failTruncated(where() + ": the count of points is " + std::to_string(remainingLines_) + " in a file of " +
      std::to_string(bytes_) + " bytes");
  }
}

template <typename Sink>
void TableWalk<Sink>::addWords(std::string_view line)
{
  std::string_view rest = line;
  for (std::size_t column = 0; column < layout_.columns; ++column)
  {
    double value = 0.0;
    NumberShape shape;
    if (!takeNumber(rest, value, &shape))
    {
      std::string_view cell;
      if (!takeCell(rest, ' ', cell))
      {
        failColumns(line);
      }
      if (!parseCell(cell, value, &shape))
      {
        sink_.text(column, cell, lineNumber_);
        continue;
      }
    }
    sink_.number(column, value, shape);
  }
  const std::string_view extra = takeWord(rest);
  if (!extra.empty() && !isComment(extra))
  {
    failColumns(line);
  }
}

template <typename Sink>
void TableWalk<Sink>::addSeparated(std::string_view line)
{
  std::string_view rest = line;
  std::string_view cell;
  std::size_t column = 0;
  while (takeCell(rest, layout_.separator, cell))
  {
    if (column >= layout_.columns)
    {
      if (!cell.empty()) // a separator at the end of a line is common
      {
        failColumns(line);
      }
      continue;
    }
    double value = 0.0;
    NumberShape shape;
    if (cell.empty())
    {
      sink_.empty(column); // a spreadsheet's way to say: not measured
    }
    else if (parseCell(cell, value, &shape))
    {
      sink_.number(column, value, shape);
    }
    else if (parseCell(withoutComment(cell), value, &shape))
    {
      sink_.number(column, value, shape);
      rest = {};
    }
    else
    {
      sink_.text(column, cell, lineNumber_);
    }
    ++column;
  }
  if (column < layout_.columns)
  {
    failColumns(line);
  }
}

template <typename Sink>
void TableWalk<Sink>::addLine(std::string_view line)
{
  if (remainingLines_ == 0)
  {
    startBlock(line);
    return;
  }
  layout_.separator == ' ' ? addWords(line) : addSeparated(line);
  sink_.endRow();
  --remainingLines_;
}

template <typename Sink>
void TableWalk<Sink>::run(const ReadTask& task, std::string_view text, double from, double to)
{
  LineReader lines(text.substr(layout_.bodyOffset), layout_.bodyLine);
  std::string_view line;
  while (lines.next(line))
  {
    line = trimmed(line, layout_.separator);
    lineNumber_ = lines.lineNumber();
    if (!line.empty() && !isComment(line))
    {
      addLine(line);
    }
    if (lineNumber_ % static_cast<std::size_t>(kProgressRows) == 0)
    {
      const double part =
        static_cast<double>(layout_.bodyOffset + lines.position()) / static_cast<double>(text.size());
      task.progress(from + (to - from) * part);
    }
  }
  if (layout_.hasPointCount && remainingLines_ > 0)
  {
    failTruncated("the file ends " + std::to_string(remainingLines_) +
      " points before the count in its first line is reached");
  }
}

struct SurveySink
{
  TextTable table;

  void number(std::size_t column, double value, NumberShape shape)
  {
    table.columns[column].numbers.add(value, shape);
  }
  void empty(std::size_t column) { table.columns[column].numbers.addEmpty(); }
  void text(std::size_t column, std::string_view cell, std::size_t line)
  {
    table.columns[column].texts.add(cell, line);
    this->empty(column);
  }
  void endRow() { ++table.rows; }
};

struct StoreSink
{
  const std::vector<ColumnView>& targets;
  vtkIdType row = 0;

  void number(std::size_t column, double value, NumberShape)
  {
    const ColumnView& target = targets[column];
    if (!target.first)
    {
      return; // left out
    }
    char* to = target.first + row * target.stride;
    switch (target.type)
    {
      case VTK_FLOAT:
        return put(to, static_cast<float>(value));
      case VTK_DOUBLE:
        return put(to, value);
      case VTK_TYPE_UINT8:
        return put(to, static_cast<unsigned char>(value));
      case VTK_TYPE_UINT16:
        return put(to, static_cast<std::uint16_t>(value));
      default:
        return put(to, static_cast<int>(value));
    }
  }
  void empty(std::size_t column) { number(column, std::numeric_limits<double>::quiet_NaN(), {}); }
  void text(std::size_t column, std::string_view, std::size_t) { this->empty(column); }
  void endRow() { ++row; }

  template <typename T>
  static void put(char* to, T value)
  {
    std::memcpy(to, &value, sizeof(T));
  }
};

} // namespace

void CellTexts::add(std::string_view cell, std::size_t line)
{
  if (count_++ == 0)
  {
    line_ = line;
    cell = withoutQuotes(cell);
    std::copy_n(cell.data(), std::min(cell.size(), first_.size() - 1), first_.data());
  }
}

void CellTexts::add(const CellTexts& later)
{
  if (count_ == 0)
  {
    *this = later;
    return;
  }
  count_ += later.count_;
}

std::string CellTexts::first() const
{
  return first_.data();
}

void TextColumn::add(const TextColumn& later)
{
  numbers.add(later.numbers);
  texts.add(later.texts);
}

bool TextTable::isOfTexts(std::size_t i) const
{
  const std::int64_t texts = columns[i].texts.count();
  return texts > rows - columns[i].numbers.empty();
}

TextLayout inspectText(std::string_view text)
{
  TextLayout layout;
  std::string_view lastComment;
  std::string_view header;
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
      const std::string unit = unitOfComment(comment);
      layout.unit = isUnitWord(unit) ? unit : layout.unit;
      lastComment = comment.empty() || isUnitWord(unit) ? lastComment : comment;
      continue;
    }
    const char separator = isByTabs(header, line) ? '\t' : separatorOf(line);
    const std::vector<std::string_view> cells = cellsOf(line, separator, lines.lineNumber());
    unsigned long long count = 0;
    if (layout.names.empty() && isHeader(cells))
    {
      header = line;
      layout.names = columnNames(cells);
      layout.separator = separator;
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
    layout.names = namesInComment(lastComment, layout.columns, lines.lineNumber());
  }
  // A cell may be empty at the end of the first line: the header has the number of columns.
  if (layout.separator != ' ' && layout.columns < layout.names.size())
  {
    layout.columns = layout.names.size();
  }
  return layout;
}

TextTable surveyTable(const ReadTask& task, std::string_view text, const TextLayout& layout)
{
  SurveySink sink;
  sink.table.columns.resize(layout.columns);
  TableWalk<SurveySink>(layout, text.size(), sink).run(task, text, 0.0, 0.5);
  return std::move(sink.table);
}

void storeTable(const ReadTask& task, std::string_view text, const TextLayout& layout,
  const std::vector<ColumnView>& targets)
{
  StoreSink sink{ targets };
  TableWalk<StoreSink>(layout, text.size(), sink).run(task, text, 0.5, 1.0);
}

} // namespace pointhaptics::io
