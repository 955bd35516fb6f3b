#include "IO/Text/TextCells.h"

#include "FileProblem.h"
#include "IO/Columns/CloudColumns.h"

#include <algorithm>
#include <limits>

namespace pointhaptics::io
{

namespace
{

/// parseNumber() with @p mark in the place of the character at @p at. @return false where there is none.
bool parseWith(char mark, std::size_t at, std::string_view cell, double& value, NumberShape* shape)
{
  char copy[64];
  if (at == 0 || at >= cell.size() || cell.size() > sizeof(copy))
  {
    return false;
  }
  std::copy(cell.begin(), cell.end(), copy);
  copy[at] = mark;
  return parseNumber(std::string_view(copy, cell.size()), value, shape);
}

/// "0,25" as a spreadsheet of many countries writes it. @return false when it is no such number.
bool parseWithComma(std::string_view cell, double& value, NumberShape* shape)
{
  const std::size_t comma = cell.find(',');
  return comma + 1 != cell.size() && cell.find('.') == std::string_view::npos &&
    parseWith('.', comma, cell, value, shape);
}

/// One past the cell at the front of @p line that stands in quotation marks; 0 where none does.
std::size_t endOfQuoted(std::string_view line, char separator)
{
  const bool isQuoted = !line.empty() && line.front() == '"';
  std::size_t mark = isQuoted ? line.find('"', 1) : std::string_view::npos;
  for (; mark != std::string_view::npos; mark = line.find('"', mark + 1))
  {
    std::size_t after = mark + 1;
    while (separator != ' ' && after < line.size() && line[after] != separator && isBlank(line[after]))
    {
      ++after;
    }
    if (after == line.size() || (separator == ' ' ? isBlank(line[after]) : line[after] == separator))
    {
      return after;
    }
  }
  return 0;
}

struct CellCounts
{
  std::size_t cells = 0;
  std::size_t numbers = 0;
  bool hasEmpty = false;
};

CellCounts countCells(std::string_view line, char separator)
{
  CellCounts counts;
  std::string_view cell;
  double value = 0.0;
  while (counts.cells <= kMostColumns && takeCell(line, separator, cell))
  {
    ++counts.cells;
    counts.numbers += parseCell(cell, value) ? 1 : 0;
    counts.hasEmpty = counts.hasEmpty || cell.empty();
  }
  return counts;
}

/// "1.0D+00" of Fortran, and what Windows writes for NaN and infinity. @return false when it is no such
/// number.
bool parseForeign(std::string_view cell, double& value, NumberShape* shape)
{
  const std::string_view size = cell.substr(!cell.empty() && (cell[0] == '-' || cell[0] == '+') ? 1 : 0);
  constexpr std::size_t kMark = 3;
  if (size.substr(0, kMark) == "1.#")
  {
    const std::string_view word = size.substr(kMark);
    const bool isInfinite = equalNoCase(word.substr(0, 3), "INF");
    value = isInfinite ? std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
    value = isInfinite && cell[0] == '-' ? -value : value;
    shape ? void(*shape = { false, true }) : void();
    return isInfinite || equalNoCase(word.substr(0, 4), "QNAN") || equalNoCase(word.substr(0, 4), "SNAN") ||
      equalNoCase(word.substr(0, 3), "IND");
  }
  return parseWith('e', cell.find_first_of("dDqQ"), cell, value, shape);
}

constexpr std::string_view kSeparators = ",;|\t";

/// Separators on the line of text that holds the place @p at.
std::size_t separatorsAbout(std::string_view text, std::size_t at)
{
  const std::size_t end = std::min(text.find('\n', at), text.size());
  std::size_t count = 0;
  for (std::size_t i = text.rfind('\n', at == 0 ? 0 : at - 1) + 1; i < end; ++i)
  {
    count += kSeparators.find(text[i]) == std::string_view::npos ? 0 : 1;
  }
  return count;
}

/// Whether the marks at @p open and @p close are inches of two rows, each of which is as long as the row
/// before.
bool areOfTwoRows(std::string_view text, std::size_t open, std::size_t close)
{
  const std::size_t before = text.rfind('\n', open);
  const std::size_t count = separatorsAbout(text, open);
  return before != std::string_view::npos && before > 0 && count > 0 &&
    separatorsAbout(text, before - 1) == count && separatorsAbout(text, close) == count;
}

} // namespace

bool isComment(std::string_view text)
{
  return !text.empty() &&
    (std::string_view("#%!;>").find(text.front()) != std::string_view::npos || text.substr(0, 2) == "//");
}

std::string_view withoutQuotes(std::string_view cell)
{
  while (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"')
  {
    cell = trimmed(cell.substr(1, cell.size() - 2));
  }
  return cell;
}

std::string withoutLineEndsInCells(std::string_view text)
{
  constexpr std::size_t kLongestCell = std::size_t{ 1 } << 16;
  const auto isEnd = [&](std::size_t at)
  {
    return at >= text.size() || text[at] == '\r' || text[at] == '\n' ||
      kSeparators.find(text[at]) < kSeparators.size();
  };
  std::string joined;
  std::size_t open = text.find('"');
  while (open != std::string_view::npos)
  {
    const bool isFirst = open == 0 || isEnd(text.find_last_not_of(' ', open - 1));
    const std::string_view rest = text.substr(0, open + (isFirst ? kLongestCell : 1));
    std::size_t close = rest.find('"', open + 1);
    while (close != std::string_view::npos && rest.substr(close + 1, 1) == "\"")
    {
      close = rest.find('"', close + 2); // two are one within quotation marks
    }
    const bool isClosed = close != std::string_view::npos;
    if (isClosed && isEnd(text.find_first_not_of(' ', close + 1)) &&
      text.substr(open, close - open).find_first_of("\r\n") != std::string_view::npos &&
      !areOfTwoRows(text, open, close))
    {
      joined = joined.empty() ? std::string(text) : std::move(joined);
      std::replace(joined.begin() + std::ptrdiff_t(open), joined.begin() + std::ptrdiff_t(close), '\n', ' ');
      std::replace(joined.begin() + std::ptrdiff_t(open), joined.begin() + std::ptrdiff_t(close), '\r', ' ');
    }
    open = text.find('"', isClosed ? close + 1 : rest.size()); // no cell begins within one that does not end
  }
  return joined;
}

bool parseUnusualCell(std::string_view cell, double& value, NumberShape* shape)
{
  cell = withoutQuotes(cell);
  return parseNumber(cell, value, shape) || parseWithComma(cell, value, shape) ||
    parseForeign(cell, value, shape);
}

char separatorOf(std::string_view line)
{
  char best = ' ';
  CellCounts most;
  for (const char separator : { ';', ',', '|' })
  {
    const CellCounts counts = countCells(line, separator);
    if (separator == ';' && counts.cells >= 3)
    {
      return ';'; // it marks no decimals
    }
    if (counts.cells > 1 && (best == ' ' || counts.numbers > most.numbers))
    {
      best = separator;
      most = counts;
    }
  }
  const CellCounts words = countCells(line, ' ');
  // Tabs that stand alone separate where words would tear cells apart: "1\t2\t3\tHigh Vegetation".
  const CellCounts tabs = countCells(line, '\t');
  const bool isTorn =
    tabs.cells >= 3 && !tabs.hasEmpty && tabs.cells < words.cells && tabs.numbers >= words.numbers;
  if (best == ' ' || words.numbers > most.numbers)
  {
    return isTorn ? '\t' : ' ';
  }
  return best;
}

bool isByTabs(std::string_view header, std::string_view line)
{
  const CellCounts names = countCells(header, '\t');
  const CellCounts tabs = countCells(line, '\t');
  return names.cells >= 3 && !names.hasEmpty && tabs.cells > 1 && tabs.cells <= names.cells &&
    tabs.numbers >= countCells(line, ' ').numbers;
}

std::string_view trimmed(std::string_view line, char separator)
{
  if (separator != '\t')
  {
    return trimmed(line);
  }
  while (!line.empty() && line.front() != '\t' && isBlank(line.front()))
  {
    line.remove_prefix(1);
  }
  while (!line.empty() && line.back() != '\t' && isBlank(line.back()))
  {
    line.remove_suffix(1);
  }
  return line;
}

bool takeUnusualCell(std::string_view& line, char separator, std::string_view& cell)
{
  line = trimmed(line, separator);
  const std::size_t quoted = endOfQuoted(line, separator);
  if (separator == ' ')
  {
    cell = quoted > 0 ? line.substr(0, quoted) : takeWord(line);
    line.remove_prefix(quoted);
    return !cell.empty();
  }
  const std::size_t end = quoted > 0 ? quoted : line.find(separator);
  cell = trimmed(line.substr(0, end));
  line = end >= line.size() ? std::string_view{} : line.substr(end + 1);
  return true;
}

std::string_view withoutComment(std::string_view cell)
{
  const std::size_t mark = std::min(cell.find(" #"), cell.find(" //"));
  return mark == std::string_view::npos ? cell : trimmed(cell.substr(0, mark));
}

std::vector<std::string_view> cellsOf(std::string_view line, char separator, std::size_t lineNumber)
{
  std::vector<std::string_view> cells;
  std::string_view cell;
  while (takeCell(line, separator, cell) && !(separator == ' ' && isComment(cell)))
  {
    failFormatIf(cells.size() == kMostColumns, "write one point per line", "line {}: more than {} columns",
      lineNumber, kMostColumns);
    cells.push_back(cell);
    double value = 0.0;
    const std::string_view beforeComment = withoutComment(cell);
    if (beforeComment.size() < cell.size() && parseCell(beforeComment, value))
    {
      cells.back() = beforeComment;
      break;
    }
  }
  while (!cells.empty() && cells.back().empty())
  {
    cells.pop_back();
  }
  return cells;
}

std::vector<std::string> columnNames(const std::vector<std::string_view>& cells)
{
  std::vector<std::string> names;
  for (const std::string_view cell : cells)
  {
    const bool isQuoted = cell.size() > 1 && cell.front() == '"' && cell.back() == '"';
    std::string& name = names.emplace_back(isQuoted ? cell.substr(1, cell.size() - 2) : cell);
    for (std::size_t at = name.find("\"\""); at != std::string::npos; at = name.find("\"\"", at + 1))
    {
      name.erase(at, 1); // within quotation marks one stands twice
    }
  }
  return names;
}

} // namespace pointhaptics::io
