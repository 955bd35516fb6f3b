/// @file
/// Numbers in columns of text: how they are separated, what a header calls them, and their values.
#pragma once

#include "Bytes/StridedCopy.h"
#include "IO/Text/NumberColumn.h"
#include "ReadTask.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

class vtkPolyData;

namespace pointhaptics::io
{

/// The layout found in the first lines.
struct TextLayout
{
  char separator = ' ';           ///< see separatorOf()
  std::vector<std::string> names; ///< of the header; empty when there is none
  std::string unit;               ///< that a comment says; empty: none does
  bool hasPointCount = false;     ///< PTS: lines that hold only a count stand before blocks of points
  std::size_t bodyOffset = 0;     ///< first byte after the header, or the first byte of the data
  std::size_t bodyLine = 1;       ///< its line number
  std::size_t columns = 0;        ///< in the first line of data; 0 when there is none
};

/// Reads the lines up to the first one that holds numbers. @throws FileProblem when one of them has more
/// than kMostColumns columns.
TextLayout inspectText(std::string_view text);

/// The cells of a column that hold something else than a number.
class CellTexts
{
public:
  void add(std::string_view cell, std::size_t line);
  /// Adds those of later lines.
  void add(const CellTexts& later);
  std::int64_t count() const { return count_; }
  /// "line 2"; of the first one.
  std::string where() const { return "line " + std::to_string(line_); }
  std::uint64_t line() const { return line_; }
  /// The first one, or its start.
  std::string first() const;

private:
  std::int64_t count_ = 0;
  std::uint64_t line_ = 0;
  std::array<char, 64> first_{};
};

struct TextColumn
{
  NumberColumn numbers; ///< Texts are empty cells here.
  CellTexts texts;

  void add(const TextColumn& later);
};

/// The results of a first pass over the text.
struct TextTable
{
  std::vector<TextColumn> columns;
  vtkIdType rows = 0;

  /// Whether texts outnumber the numbers of column @p i: it holds names, and nothing to compute with.
  bool isOfTexts(std::size_t i) const;
};

/// Parses every number of @p text and stores none: it finds the size and type of each array.
/// @throws FileProblem with the number of a line with more or fewer columns than the first; StoppedOnRequest.
TextTable surveyTable(const ReadTask& task, std::string_view text, const TextLayout& layout);

/// Stores every number in its place, one target per column; a target without a place leaves its column out.
/// Of texts NaN is stored. @pre surveyTable() succeeded.
void storeTable(const ReadTask& task, std::string_view text, const TextLayout& layout,
  const std::vector<ColumnView>& targets);

/// Fills @p cloud with the points and arrays of a table: the columns are called as in @p layout, or as their
/// number and values suggest. Where ranks read it together: of this rank's lines, with names and types that
/// suit those of all. Columns of texts are left out, and a few texts among numbers are NaN: task.notes says
/// so; coordinates must be numbers. @throws FileProblem; StoppedOnRequest; OtherRankFailed.
void readTable(ReadTask& task, std::string_view text, TextLayout layout, vtkPolyData* cloud);

} // namespace pointhaptics::io
