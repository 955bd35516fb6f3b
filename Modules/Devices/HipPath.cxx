#include "Devices/HipPath.h"

#include "Core/Base/OutputFile.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <limits>
#include <system_error>

namespace pointhaptics
{
namespace
{
/// Numbers of a point: time and position.
constexpr std::size_t kNumbers = 4;
/// Names of the columns in a path, and in a table of felt forces.
constexpr const char* kColumnNames[][kNumbers] = { { "t", "x", "y", "z" },
  { "t", "hip_x", "hip_y", "hip_z" } };
/// No row of a path or of felt forces is longer than this; it keeps a binary file from being read as one
/// line.
constexpr std::size_t kLongestLine = 1000;
/// Longest part of a file's text repeated in a message.
constexpr std::size_t kLongestQuote = 40;

std::string quote(const std::string& text)
{
  std::string result = "'";
  for (char c : text.substr(0, kLongestQuote))
  {
    const unsigned char byte = static_cast<unsigned char>(c);
    result += byte < 0x20 || byte == 0x7f ? '?' : c;
  }
  return result + (text.size() > kLongestQuote ? "...'" : "'");
}

std::string shortestDigits(double value)
{
  char digits[32];
  const std::to_chars_result end = std::to_chars(digits, digits + sizeof(digits), value);
  return std::string(digits, end.ptr);
}

constexpr const char* kSortRows = "sort the rows by time and remove duplicates";

std::string notAfter(double time, double before)
{
  return "time " + shortestDigits(time) + " is not after the time before it, " + shortestDigits(before);
}

std::string trimmed(const std::string& text)
{
  const std::size_t first = text.find_first_not_of(" \t");
  return first == std::string::npos ? std::string()
                                    : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// Reads one line without its LF or CRLF, at most kLongestLine + 1 bytes; the rest of a longer remark is
/// skipped. False at the end of the file.
bool readLine(std::istream& stream, std::string& line)
{
  constexpr int kEnd = std::char_traits<char>::eof();
  line.clear();
  if (stream.peek() == kEnd)
  {
    return false;
  }
  while (line.size() <= kLongestLine && stream.peek() != kEnd && stream.peek() != '\n')
  {
    line += char(stream.get());
  }
  const bool isRemark = !line.empty() && line.front() == '#';
  stream.ignore(isRemark ? std::numeric_limits<std::streamsize>::max() : stream.peek() == '\n' ? 1 : 0, '\n');
  if (!line.empty() && line.back() == '\r')
  {
    line.pop_back();
  }
  return true;
}

/// Parses a number. False: @p problem says why it is none.
bool parseNumber(const std::string& text, double& value, std::string& problem)
{
  const std::from_chars_result parsed = std::from_chars(text.data(), text.data() + text.size(), value);
  if (parsed.ec == std::errc::result_out_of_range)
  {
    problem = quote(text) + " is too large or too small for a double";
  }
  else if (parsed.ec != std::errc() || parsed.ptr != text.data() + text.size())
  {
    problem = quote(text) + " is not a number: write it like 0.0125 or 1.25e-2";
  }
  else if (!std::isfinite(value))
  {
    problem = quote(text) + " is not finite: leave rows without a position out";
  }
  return problem.empty();
}

std::vector<std::string> cellsOf(const std::string& line)
{
  std::vector<std::string> cells;
  for (std::size_t begin = 0; begin <= line.size();)
  {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    cells.push_back(trimmed(line.substr(begin, end - begin)));
    begin = end + 1;
  }
  return cells;
}

/// Columns of time and position in each row.
struct Columns
{
  std::size_t count = 0; ///< Number of columns in a row.
  std::size_t positions[kNumbers] = {};
};

/// Finds the columns in the first line, without the byte order mark that spreadsheets write. False: it names
/// no path.
bool findColumns(std::string header, Columns& columns)
{
  if (header.rfind("\xef\xbb\xbf", 0) == 0)
  {
    header.erase(0, 3);
  }
  const std::vector<std::string> cells = cellsOf(header);
  columns.count = cells.size();
  for (const auto& names : kColumnNames)
  {
    std::size_t found = 0;
    for (; found < kNumbers; ++found)
    {
      const auto cell = std::find(cells.begin(), cells.end(), names[found]);
      if (cell == cells.end())
      {
        break;
      }
      columns.positions[found] = std::size_t(cell - cells.begin());
    }
    if (found == kNumbers)
    {
      return true;
    }
  }
  return false;
}

/// Parses a row. False: @p problem names the fault and the cure. Other columns may hold anything.
bool parseRow(const std::string& line, const Columns& columns, HipPathPoint& point, std::string& problem)
{
  if (line.size() > kLongestLine)
  {
    problem = "the line has more than " + std::to_string(kLongestLine) + " characters: is this a text file?";
    return false;
  }
  const std::vector<std::string> cells = cellsOf(line);
  if (cells.size() != columns.count)
  {
    problem = std::to_string(cells.size()) + " columns instead of " + std::to_string(columns.count) +
      ": write in each row what the header names";
    return false;
  }
  double numbers[kNumbers];
  for (std::size_t i = 0; i < kNumbers; ++i)
  {
    const std::size_t position = columns.positions[i];
    if (!parseNumber(cells[position], numbers[i], problem))
    {
      problem.insert(0, "column " + std::to_string(position + 1) + ": ");
      return false;
    }
  }
  point = { numbers[0], { numbers[1], numbers[2], numbers[3] } };
  return true;
}

/// True if a recording says by @p remark that the hand did not come to the next row by moving.
bool saysNewHand(const std::string& remark)
{
  const std::string event = remark.substr(std::min(remark.rfind(' '), remark.size() - 1) + 1);
  return remark.rfind("# tick ", 0) == 0 && (event == "new-hand" || event == "begins");
}

/// Reads the next line that is no remark. @p isNew: a remark before it says so. False: there is none.
bool readTableLine(std::istream& stream, std::string& line, std::size_t& lineNumber, bool& isNew)
{
  isNew = false;
  for (++lineNumber; stream.peek() == '#'; ++lineNumber)
  {
    readLine(stream, line);
    isNew |= saysNewHand(line);
  }
  const bool isRead = readLine(stream, line);
  lineNumber -= isRead || lineNumber == 1 ? 0 : 1;
  return isRead;
}

/// Reads the rows below the header. False: @p problem and the number of its line are set.
bool readRows(
  std::istream& stream, const Columns& columns, HipPath& path, std::size_t& lineNumber, std::string& problem)
{
  std::string line;
  std::size_t blankLine = 0;
  bool isNew = false;
  while (readTableLine(stream, line, lineNumber, isNew))
  {
    if (trimmed(line).empty())
    {
      blankLine = blankLine ? blankLine : lineNumber;
      continue;
    }
    if (blankLine)
    {
      lineNumber = blankLine;
      problem = "a blank line between rows: remove it";
      return false;
    }
    HipPathPoint point;
    if (!parseRow(line, columns, point, problem))
    {
      return false;
    }
    if (!path.points.empty() && !(point.timeSeconds > path.points.back().timeSeconds))
    {
      problem = notAfter(point.timeSeconds, path.points.back().timeSeconds) + ": " + kSortRows;
      return false;
    }
    point.isNew = isNew;
    path.points.push_back(point);
  }
  if (path.points.empty())
  {
    problem = "no row below the header: add at least one";
    return false;
  }
  return true;
}
}

std::string HipPath::problem() const
{
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const double time = points[i].timeSeconds;
    const Vec3& p = points[i].position;
    if (!std::isfinite(time) || !isFinite(p))
    {
      return "path: row " + std::to_string(i) + " is " + shortestDigits(time) + ", " + shortestDigits(p.x) +
        ", " + shortestDigits(p.y) + ", " + shortestDigits(p.z) + "; leave rows out that are not finite";
    }
    if (i > 0 && !(time > points[i - 1].timeSeconds))
    {
      return "path: row " + std::to_string(i) + ": " + notAfter(time, points[i - 1].timeSeconds) + "; " +
        kSortRows;
    }
  }
  return points.empty() ? "path: it has no rows; give at least one" : "";
}

Vec3 HipPath::position(double timeSeconds, std::size_t& row) const noexcept
{
  if (!(timeSeconds > points.front().timeSeconds))
  {
    row = 0;
    return points.front().position;
  }
  if (timeSeconds >= points.back().timeSeconds)
  {
    row = points.size() - 1;
    return points.back().position;
  }
  const auto after = std::upper_bound(points.begin(), points.end(), timeSeconds,
    [](double time, const HipPathPoint& point) { return time < point.timeSeconds; });
  row = std::size_t(after - points.begin()) - 1;
  const HipPathPoint& from = points[row];
  const HipPathPoint& to = points[row + 1];
  if (to.isNew)
  {
    return from.position;
  }
  const double part = (timeSeconds - from.timeSeconds) / (to.timeSeconds - from.timeSeconds);
  return from.position + part * (to.position - from.position);
}

HandState HipPath::hand(double timeSeconds, std::size_t& row) const noexcept
{
  HandState state;
  const std::size_t before = row;
  state.position = this->position(timeSeconds, row);
  for (std::size_t i = before + 1; i <= row && !state.isNew; ++i)
  {
    state.isNew = points[i].isNew;
  }
  return state;
}

Status readHipPath(const std::string& fileName, HipPath& path, std::string& message)
{
  path.points.clear();
  message.clear();
  std::error_code ignored;
  errno = 0;
  std::ifstream stream(fileName, std::ios::binary);
  if (!stream || std::filesystem::is_directory(fileName, ignored))
  {
    const std::string reason = errno ? std::generic_category().message(errno) : "it is a folder";
    const std::string missed = OutputFile::missedPart(fileName);
    message = fileName + ": " +
      (missed.empty() ? "cannot be opened (" + reason + "): check the name and its permissions" : missed);
    return Status::FileNotReadable;
  }
  std::string line;
  std::size_t lineNumber = 0;
  std::string problem;
  Columns columns;
  bool isNew = false;
  if (!readTableLine(stream, line, lineNumber, isNew) || !findColumns(line, columns))
  {
    problem = "the header is " + quote(line) +
      ": make the first line t,x,y,z (seconds and metres), or give a table of felt forces, which has t,hip_x,"
      "hip_y,hip_z";
  }
  else if (readRows(stream, columns, path, lineNumber, problem) && !stream.bad())
  {
    return Status::Ok;
  }
  path.points.clear();
  if (stream.bad())
  {
    message = fileName + ":" + std::to_string(lineNumber) + ": cannot be read further: check the disk";
    return Status::FileNotReadable;
  }
  message = fileName + ":" + std::to_string(lineNumber) + ": " + problem;
  return Status::FileMalformed;
}

} // namespace pointhaptics
