/// @file
/// Numbers in columns of text: how they are separated, what a header calls them, and their values.
#pragma once

#include "Bytes/StridedCopy.h"
#include "IO/Bytes/TextScan.h"
#include "IO/Columns/ColumnGuess.h"
#include "IO/Info/FileComments.h"
#include "ReadTask.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
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
  std::vector<std::string> names; ///< of header, comment or user; empty when there are none
  std::string note;               ///< on names that a word of order gives
  bool isNumbered = false;        ///< the header says Var1, Var2 and so on
  FileComments comments;
  bool hasPointCount = false; ///< PTS: lines that hold only a count stand before blocks of points
  std::size_t bodyOffset = 0; ///< first byte after the header, or the first byte of the data
  std::size_t bodyLine = 1;   ///< its line number
  std::size_t columns = 0;    ///< that are read of each line; 0 when there is no line of data
  bool hasMore = false;       ///< lines may have more columns, which are left out

  void beginAt(std::size_t offset, std::size_t line)
  {
    bodyOffset = offset;
    bodyLine = line;
  }
};

/// Reads the lines up to the first one that holds numbers. Columns are called as the last line of names or
/// comment before it says that has x, y and z and a name for each column, or else an order such as PNEZD; or
/// as @p names, which the user gave. @throws FileProblem when a line has more than kMostColumns columns.
TextLayout inspectText(std::string_view text, const std::vector<std::string>& names = {});

/// Summarises the numbers that were added, and stores those of the first kGuessedRows rows. Integers beyond
/// 2^53 lose their last digits.
struct NumberColumn : ColumnEvidence
{
  bool fitsFloat = true;
  std::int64_t empty = 0; ///< How often addEmpty() was called.

  NumberColumn()
    : ColumnEvidence{ {}, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
      true }
  {
  }
  void add(double value, NumberShape shape)
  {
    fitsFloat = fitsFloat && shape.fitsFloat;
    isWhole = isWhole && shape.isInteger;
    least = std::min(least, value);
    most = std::max(most, value);
    sample.size() < kGuessedRows ? sample.push_back(value) : void();
  }
  /// A cell without a number reads as NaN.
  void addEmpty()
  {
    isWhole = false;
    ++empty;
    sample.size() < kGuessedRows ? sample.push_back(std::numeric_limits<double>::quiet_NaN()) : void();
  }
  /// True if all are integers in 0..@p largest.
  bool isInteger(double largest) const { return isWhole && least >= 0.0 && most <= largest; }
  /// True if whole numbers are so large that doubles cannot hold each of them.
  bool losesDigits() const { return isWhole && std::max(most, -least) >= 0x1p53; }
  /// VTK_FLOAT when a float keeps every digit, else VTK_DOUBLE.
  int floatingType() const { return fitsFloat ? VTK_FLOAT : VTK_DOUBLE; }
  /// VTK_INT for integers that fit it, else floatingType().
  int type() const
  {
    const bool fitsInt = least >= std::numeric_limits<int>::min() && most <= std::numeric_limits<int>::max();
    return isWhole && fitsInt ? VTK_INT : floatingType();
  }
};

/// Takes off @p text zero bytes and what follows them, as a power cut leaves them, and of salvaged files the
/// last line, which may be cut within a number. @return what was the matter; empty: nothing.
std::string takeOffTorn(const ReadTask& task, std::string_view& text);

/// Fills @p cloud with the points and arrays of a table: the columns are called as in @p layout ("-" skips
/// one), or as their values suggest (ColumnGuess.h), which task.notes then tells. Columns of texts are left
/// out, and a few texts among numbers are NaN: task.notes says so; coordinates must be numbers. @throws
/// FileProblem; StoppedOnRequest. @param cut: why text is missing behind it; empty: none is.
void readTable(
  ReadTask& task, std::string_view text, TextLayout layout, vtkPolyData* cloud, std::string cut = {});

} // namespace pointhaptics::io
