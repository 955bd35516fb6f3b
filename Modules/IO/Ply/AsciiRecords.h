/// @file
/// The records of an ASCII PLY file as numbers.
#pragma once

#include "Bytes/NumericType.h"
#include "IO/FileProblem.h"
#include "IO/Ply/PlyHeader.h"
#include "IO/Text/TextScan.h"

#include <cmath>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace pointhaptics::io
{

inline bool nextFilledLine(LineReader& lines, std::string_view& line)
{
  while (lines.next(line))
  {
    if (!trimmed(line).empty())
    {
      return true;
    }
  }
  return false;
}

/// The numbers of ASCII records. A record is a line as a rule; one may go on in the lines behind, where it
/// ends with a line, and several may stand in a line, where all of it belongs to them. Lines may end anywhere
/// where nothing follows the element (@p isLast) and the numbers are as many as its records need.
class AsciiRecords
{
public:
  AsciiRecords(LineReader& lines, const PlyElement& element, bool isLast)
    : lines_(lines)
    , element_(element)
    , isLast_(isLast)
  {
  }
  /// @return false at the end of the file.
  bool next()
  {
    goesOn_ = false;
    const bool isThere = !rest_.empty() || nextFilledLine(lines_, rest_);
    line_ = lines_.lineNumber();
    return isThere;
  }
  double takeNumber(const PlyProperty& property)
  {
    double value = 0.0;
    for (number_ = rest_; !io::takeNumber(rest_, value); number_ = rest_)
    {
      if (rest_.empty() && nextFilledLine(lines_, rest_))
      {
        missing_ = goesOn_ ? missing_ : property.name;
        goesOn_ = true;
        continue;
      }
      const std::string_view word = takeWord(rest_);
      throwDoubt();
      failFormat(where() + "property " + inQuotes(property.name) + " is " +
          (word.empty() ? std::string("missing") : inQuotes(word) + ", not a number"),
        "write one number per property and one vertex per line");
    }
    return value;
  }
  /// Stores the next number. @return false where the type of the property cannot hold it.
  bool store(const PlyProperty& property, ColumnView target, vtkIdType row, double& value)
  {
    value = takeNumber(property);
    return storeNumber(target, row, value, trimmed(number_));
  }
  void skipList(const PlyProperty& list, std::vector<vtkIdType>* items = nullptr)
  {
    const double count = takeNumber(list);
    for (double i = 0.0; i < count; i += 1.0)
    {
      const double item = takeNumber(list);
      if (items)
      {
        items->push_back(item >= 0.0 && item < 0x1p53 ? static_cast<vtkIdType>(item) : -1);
      }
    }
  }
  void expectEnd()
  {
    rest_ = trimmed(rest_);
    if (rest_.empty())
    {
      return;
    }
    std::size_t extra = 0;
    for (std::string_view copy = rest_; !takeWord(copy).empty();)
    {
      ++extra;
    }
    if (doubt_.empty() && goesOn_)
    {
      doubt_ = "line " + std::to_string(line_) + ": property " + inQuotes(missing_) +
        " is missing; write one number per property and one vertex per line";
    }
    else if (doubt_.empty() && (element_.hasList() || extra % element_.properties.size() != 0))
    {
      std::string_view copy = rest_;
      doubt_ = where() + inQuotes(takeWord(copy)) +
        " follows the last property; write as many numbers per line as the header has properties";
    }
    isLast_ ? void() : throwDoubt();
  }
  /// Where lines end in odd places, and the numbers turn out not to be those of the records.
  void throwDoubt() const
  {
    if (!doubt_.empty())
    {
      throw FileProblem(vtkErrorCode::FileFormatError, doubt_);
    }
  }
  bool isAtEndOfLine() const { return trimmed(rest_).empty(); }
  std::string where() const { return "line " + std::to_string(lines_.lineNumber()) + ": "; }

private:
  LineReader& lines_;
  const PlyElement& element_;
  const bool isLast_;
  std::string doubt_; ///< About the first line that ends in an odd place.
  std::string_view rest_;
  std::string_view number_; ///< Begins with the number that was taken last.
  std::string missing_;     ///< First property that did not stand in the line of the others.
  std::size_t line_ = 0;    ///< In which the record begins.
  bool goesOn_ = false;     ///< Behind the line in which it begins.
};

} // namespace pointhaptics::io
