/// @file
/// Numbers in columns of text: how they are separated, what a header calls them, and their values.
#pragma once

#include "DecimalColumn.h"
#include "ReadTask.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace pointhaptics::io
{

/// What the first lines tell.
struct TextLayout
{
  char separator = ' ';           ///< ',' or ';', or ' ' for any white space
  std::vector<std::string> names; ///< of the header; empty when there is none
  bool hasPointCount = false;     ///< PTS: lines that hold only a count stand before blocks of points
  std::size_t bodyOffset = 0;     ///< first byte after the header, or the first byte of the data
  std::size_t bodyLine = 1;       ///< its line number
  std::size_t columns = 0;        ///< in the first line of data; 0 when there is none
};

/// Looks at the lines up to the first one that holds numbers.
TextLayout inspectText(std::string_view text);

/// Every column of @p text. @throws FileProblem with the line number of what is not a number, or of a line
/// with more or fewer columns than the first; ReadingStopped.
std::vector<DecimalColumn> parseTable(const ReadTask& task, std::string_view text, const TextLayout& layout);

} // namespace pointhaptics::io
