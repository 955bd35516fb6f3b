#include "IO/Columns/TextRecords.h"

#include "ReadTask.h"

#include <algorithm>

namespace pointhaptics::io
{

std::string spaced(std::string_view word)
{
  std::string text(word);
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

bool TextRecords::next()
{
  goesOn_ = false;
  const bool isThere = !rest_.empty() || lines_.nextFilled(rest_);
  line_ = filledLine_ = lines_.lineNumber();
  return isThere;
}

double TextRecords::takeNumber(const TextField& field)
{
  double value = 0.0;
  for (number_ = rest_; !io::takeNumber(rest_, value); number_ = rest_)
  {
    if (rest_.empty() && lines_.nextFilled(rest_))
    {
      missing_ = goesOn_ ? missing_ : field.name;
      goesOn_ = true;
      filledLine_ = lines_.lineNumber();
      continue;
    }
    const std::string_view word = takeWord(rest_);
    throwDoubt();
    failFormat(atLine(filledLine_) + words_.field + " " + inQuotes(field.name) + " is " +
        (word.empty() ? std::string("missing") : inQuotes(word) + ", not a number"),
      std::string("write one number per ") + words_.field + " and one " + words_.record + " per line");
  }
  return value;
}

void TextRecords::takeList(const TextField& list, std::vector<vtkIdType>* items)
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

void TextRecords::store(vtkIdType row)
{
  for (const TextField& field : fields_)
  {
    if (field.isList)
    {
      takeList(field);
      continue;
    }
    const double value = takeNumber(field);
    if (field.target.first && !storeNumber(field.target, row, value, trimmed(number_)))
    {
      failFormat(atLine(lines_.lineNumber()) + words_.field + " " + inQuotes(field.name) + " is " +
          std::to_string(value) + ", which its integer type cannot hold",
        words_.cureOfType);
    }
  }
  expectEnd();
}

/// The rest of a line is counted behind its first record: the records behind it have as many numbers.
void TextRecords::expectEnd()
{
  rest_ = trimmed(rest_);
  if (rest_.empty() || countedLine_ == lines_.lineNumber())
  {
    return;
  }
  countedLine_ = lines_.lineNumber();
  std::size_t extra = 0;
  for (std::string_view copy = rest_; !takeWord(copy).empty();)
  {
    ++extra;
  }
  const bool hasList =
    std::any_of(fields_.begin(), fields_.end(), [](const TextField& field) { return field.isList; });
  if (doubt_.empty() && goesOn_)
  {
    doubt_ = atLine(line_) + words_.field + " " + inQuotes(missing_) + " is missing; write one number per " +
      words_.field + " and one " + words_.record + " per line";
  }
  else if (doubt_.empty())
  {
    std::string_view copy = rest_;
    doubt_ = atLine(lines_.lineNumber()) + inQuotes(takeWord(copy)) + " follows the last " + words_.field +
      "; write as many numbers per line as the header names";
  }
  const bool isOdd = goesOn_ || hasList || extra % fields_.size() != 0;
  isLast_ || !isOdd ? void() : throwDoubt();
}

/// Where lines end in odd places, and the numbers turn out not to be those of the records.
void TextRecords::throwDoubt() const
{
  if (!doubt_.empty())
  {
    throw FileProblem(vtkErrorCode::FileFormatError, doubt_);
  }
}

void TextRecords::storeAll(ReadTask& task, std::uint64_t rows, std::uint64_t all)
{
  for (std::uint64_t row = 0; row < rows; ++row)
  {
    if (!next())
    {
      task.salvage ? void() : throwDoubt();
      const bool isCut = task.salvage && row > 1 && task.bytes.back() != '\n'; // perhaps within a number
      task.endAt(row - (isCut ? 1 : 0), all,
        "the file ends at line " + std::to_string(lines_.lineNumber()) + " after " + std::to_string(row) +
          " of " + std::to_string(all) + " " + words_.records);
      return;
    }
    try
    {
      store(static_cast<vtkIdType>(row));
    }
    catch (const FileProblem& problem)
    {
      lines_.isAtEnd() ? task.endBehind(row, all, problem) : throw;
      return;
    }
    task.step(row, row, rows);
  }
  const bool isMore = !trimmed(rest_).empty() || (isLast_ && !doubt_.empty() && lines_.nextFilled(rest_));
  isMore ? throwDoubt() : void();
}

} // namespace pointhaptics::io
