/// @file
/// Numbers in columns of text: how they are separated, what a header calls them, and their values.
#pragma once

#include "Bytes/StridedCopy.h"
#include "IO/Text/NumberColumn.h"
#include "ReadTask.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

class vtkPolyData;

namespace pointhaptics::io
{

/// The layout found in the first lines.
struct TextLayout
{
  char separator = ' ';           ///< ',' or ';', or ' ' for any white space
  std::vector<std::string> names; ///< of the header; empty when there is none
  bool hasPointCount = false;     ///< PTS: lines that hold only a count stand before blocks of points
  std::size_t bodyOffset = 0;     ///< first byte after the header, or the first byte of the data
  std::size_t bodyLine = 1;       ///< its line number
  std::size_t columns = 0;        ///< in the first line of data; 0 when there is none
};

/// Reads the lines up to the first one that holds numbers. @throws FileProblem when one of them has more
/// than kMostColumns columns.
TextLayout inspectText(std::string_view text);

/// The results of a first pass over the text.
struct TextTable
{
  std::vector<NumberColumn> columns;
  vtkIdType rows = 0;
};

/// Parses every number of @p text and stores none: it finds the size and type of each array.
/// @throws FileProblem with the line number of what is not a number, or of a line with more or fewer columns
/// than the first; StoppedOnRequest.
TextTable surveyTable(const ReadTask& task, std::string_view text, const TextLayout& layout);

/// Stores every number in its place, one target per column. @pre surveyTable() succeeded.
void storeTable(const ReadTask& task, std::string_view text, const TextLayout& layout,
  const std::vector<ColumnView>& targets);

/// Fills @p cloud with the points and arrays of a table: the columns are called as in @p layout, or as their
/// number and values suggest. Where ranks read it together: of this rank's lines, with names and types that
/// suit those of all. @throws FileProblem; StoppedOnRequest; OtherRankFailed.
void readTable(ReadTask& task, std::string_view text, TextLayout layout, vtkPolyData* cloud);

} // namespace pointhaptics::io
