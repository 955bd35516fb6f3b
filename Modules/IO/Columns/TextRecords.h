/// @file
/// Records of numbers as text, whose fields a header names: the bodies of ASCII PLY and PCD.
#pragma once

#include "IO/Bytes/StridedCopy.h"
#include "IO/Bytes/TextScan.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace pointhaptics::io
{

struct ReadTask;

/// @p word with blanks for its '_': "binary compressed".
std::string spaced(std::string_view word);

/// One number of each record, or with a list a count and as many numbers behind it.
struct TextField
{
  std::string name;
  ColumnView target; ///< Without a place the number is left out, as lists are.
  bool isList = false;
};

/// Words of a format for messages.
struct TextRecordWords
{
  const char* field;  ///< "property"
  const char* record; ///< "vertex"
  const char* records;
  const char* cureOfType; ///< Where the type of a field cannot hold its number.
};

/// Reads the numbers of records. A record is a line as a rule; one may go on in the lines behind, where it
/// ends with a line, and several may stand in a line, where all of it belongs to them. Lines may end anywhere
/// where nothing follows the records (@p isLast) and the numbers are as many as they need.
class TextRecords
{
public:
  /// @p lines must outlive this object.
  TextRecords(
    LineReader& lines, const std::vector<TextField>& fields, const TextRecordWords& words, bool isLast)
    : lines_(lines)
    , fields_(fields)
    , words_(words)
    , isLast_(isLast)
  {
  }
  /// Goes to the next record. @return false at the end of the file.
  bool next();
  double takeNumber(const TextField& field);
  /// @p items gets the numbers of the list as indices, -1 for those that are none; null: nothing does.
  void takeList(const TextField& list, std::vector<vtkIdType>* items = nullptr);
  /// Stores the numbers of the record in row @p row of their targets. @throws FileProblem.
  void store(vtkIdType row);
  /// Stores @p rows records, of which the file promises @p all; where it ends before, task.endAt() decides.
  void storeAll(ReadTask& task, std::uint64_t rows, std::uint64_t all);

private:
  void expectEnd();
  void throwDoubt() const;

  LineReader& lines_;
  const std::vector<TextField> fields_;
  const TextRecordWords words_;
  const bool isLast_;
  std::string doubt_; ///< About the first line that ends in an odd place, or holds several records.
  std::string_view rest_;
  std::string_view number_;     ///< Begins with the number that was taken last.
  std::string missing_;         ///< First field that did not stand in the line of the others.
  std::size_t filledLine_ = 0;  ///< The last one that has numbers.
  std::size_t line_ = 0;        ///< In which the record begins.
  std::size_t countedLine_ = 0; ///< The last one whose rest is known to be whole records.
  bool goesOn_ = false;         ///< Behind the line in which it begins.
};

} // namespace pointhaptics::io
