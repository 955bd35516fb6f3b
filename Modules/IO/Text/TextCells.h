/// @file
/// The cells of a line of text: what separates them, and the numbers in them.
#pragma once

#include "IO/Bytes/TextScan.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace pointhaptics::io
{

/// True if @p text starts with the mark of a comment: # // % ! ; or >.
bool isComment(std::string_view text);

/// @p cell without the quotation marks around it.
std::string_view withoutQuotes(std::string_view cell);

/// @p text with blanks in the place of line ends within cells in quotation marks, as spreadsheets write them;
/// empty where there are none.
std::string withoutLineEndsInCells(std::string_view text);

/// parseCell() of what is no plain number.
bool parseUnusualCell(std::string_view cell, double& value, NumberShape* shape);

/// A number with a point or a comma, also within quotation marks. @return false when @p cell is none.
inline bool parseCell(std::string_view cell, double& value, NumberShape* shape = nullptr)
{
  return parseNumber(cell, value, shape) || parseUnusualCell(cell, value, shape);
}

/// Separator of the cells of @p line: ';', ',', '|' or '\t', or ' ' for any white space. It is the one that
/// leaves the most numbers: white space for "0,25 1 3,5", as a comma may mark decimals.
char separatorOf(std::string_view line);

/// True if tabs separate the cells of @p line, as its @p header has names between single tabs.
bool isByTabs(std::string_view header, std::string_view line);

/// @p line without white space at its ends; tabs stay where they separate.
std::string_view trimmed(std::string_view line, char separator);

/// takeCell() of words, and of a cell that starts with a quotation mark.
bool takeUnusualCell(std::string_view& line, char separator, std::string_view& cell);

/// Takes the next cell, trimmed, off the front of @p line: up to the next @p separator that stands in no
/// quotation marks. @return false when there is none left.
inline bool takeCell(std::string_view& line, char separator, std::string_view& cell)
{
  if (line.data() == nullptr)
  {
    return false;
  }
  const std::size_t end = line.find(separator);
  cell = trimmed(line.substr(0, end));
  if (separator == ' ' || (!cell.empty() && cell.front() == '"'))
  {
    return takeUnusualCell(line, separator, cell);
  }
  line = end == std::string_view::npos ? std::string_view{} : line.substr(end + 1);
  return true;
}

/// The number before a comment, such as "3" for "3 # a corner". All of @p cell where it holds none.
std::string_view withoutComment(std::string_view cell);

/// All cells before a comment, without empty ones at the end. @throws FileProblem when they are more than
/// kMostColumns.
std::vector<std::string_view> cellsOf(std::string_view line, char separator, std::size_t lineNumber);

/// The names in a header, as the arrays are to be called.
std::vector<std::string> columnNames(const std::vector<std::string_view>& cells);

} // namespace pointhaptics::io
