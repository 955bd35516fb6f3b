#include "Benchmark/Report/Summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>

namespace pointhaptics
{
namespace bench
{
namespace
{

constexpr const char* kBegin = "<!-- bench summary: begin -->";
constexpr const char* kEnd = "<!-- bench summary: end -->";
constexpr const char* kHeader = "| question | answer | section |\n|---|---|---|\n";
constexpr const char* kSection = "<!-- bench ";

/// The number that a cell begins with; grouped digits are joined.
double numberOf(const std::string& cell)
{
  std::string digits = cell;
  digits.erase(std::remove(digits.begin(), digits.end(), ','), digits.end());
  return std::strtod(digits.c_str(), nullptr);
}

/// A link to a heading, by the rule of GitHub and GitLab.
std::string linkTo(const std::string& title)
{
  std::string anchor;
  for (const char c : title)
  {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-')
    {
      anchor += char(std::tolower(static_cast<unsigned char>(c)));
    }
    else if (c == ' ')
    {
      anchor += '-';
    }
  }
  return fmt::format("[{}](#{})", title, anchor);
}

/// The rows of the summary in @p page, each with its line break.
std::vector<std::string> rowsOf(const std::string& page, std::size_t begin, std::size_t end)
{
  std::vector<std::string> rows;
  std::size_t line = page.find(kHeader, begin);
  line = line < end ? line + std::string(kHeader).size() : end;
  while (line < end && page[line] == '|')
  {
    const std::size_t next = page.find('\n', line) + 1;
    rows.push_back(page.substr(line, next - line));
    line = next;
  }
  return rows;
}

} // namespace

TableRows::TableRows(const Table& table)
  : table_(&table)
{
  for (const std::vector<std::string>& row : table.rows)
  {
    rows_.push_back(&row);
  }
}

std::size_t TableRows::indexOf(const std::string& column) const
{
  return std::size_t(
    std::find(table_->header.begin(), table_->header.end(), column) - table_->header.begin());
}

TableRows TableRows::with(const std::string& column, const std::string& text, bool equal) const
{
  const std::size_t index = indexOf(column);
  TableRows result(*this);
  result.rows_.erase(std::remove_if(result.rows_.begin(), result.rows_.end(),
                       [&](const std::vector<std::string>* row)
                       { return index >= row->size() || ((*row)[index] == text) != equal; }),
    result.rows_.end());
  return result;
}

TableRows TableRows::where(const std::string& column, const std::string& text) const
{
  return with(column, text, true);
}

TableRows TableRows::whereNot(const std::string& column, const std::string& text) const
{
  return with(column, text, false);
}

std::string TableRows::last(const std::string& column) const
{
  const std::size_t index = indexOf(column);
  return rows_.empty() || index >= rows_.back()->size() ? std::string() : (*rows_.back())[index];
}

std::pair<std::string, std::string> TableRows::range(const std::string& column) const
{
  const std::size_t index = indexOf(column);
  std::vector<std::string> cells;
  for (const std::vector<std::string>* row : rows_)
  {
    if (index < row->size() && !(*row)[index].empty())
    {
      cells.push_back((*row)[index]);
    }
  }
  if (cells.empty())
  {
    return {};
  }
  const auto ends = std::minmax_element(cells.begin(), cells.end(),
    [](const std::string& a, const std::string& b) { return numberOf(a) < numberOf(b); });
  return { *ends.first, *ends.second };
}

std::string TableRows::sum(const std::string& column) const
{
  const std::size_t index = indexOf(column);
  long long total = 0;
  for (const std::vector<std::string>* row : rows_)
  {
    total += index < row->size() ? (long long)(numberOf((*row)[index])) : 0;
  }
  return rows_.empty() ? std::string() : grouped(total);
}

std::string rangeText(const std::pair<std::string, std::string>& range)
{
  return range.first == range.second ? range.first : range.first + " to " + range.second;
}

std::string withSummary(
  const std::string& page, const std::string& title, const std::vector<SummaryRow>& rows)
{
  std::size_t begin = page.find(kBegin);
  std::size_t end = begin == std::string::npos ? begin : page.find(kEnd, begin);
  const bool has = end != std::string::npos;
  std::vector<std::string> lines = has ? rowsOf(page, begin, end) : std::vector<std::string>();
  const std::string tail = fmt::format(" | {} |\n", linkTo(title));
  const auto isOurs = [&tail](const std::string& line)
  { return line.size() >= tail.size() && line.compare(line.size() - tail.size(), tail.size(), tail) == 0; };
  const std::size_t at = std::size_t(std::find_if(lines.begin(), lines.end(), isOurs) - lines.begin());
  lines.erase(std::remove_if(lines.begin(), lines.end(), isOurs), lines.end());
  std::vector<std::string> ours;
  for (const SummaryRow& row : rows)
  {
    ours.push_back(fmt::format("| {} | {}{}", row.question, row.answer, tail));
  }
  lines.insert(lines.begin() + std::ptrdiff_t(std::min(at, lines.size())), ours.begin(), ours.end());
  if (lines.empty() && !has)
  {
    return page;
  }
  std::string block = fmt::format("{}\n\n{}", kBegin, kHeader);
  for (const std::string& line : lines)
  {
    block += line;
  }
  block += fmt::format("\n{}", kEnd);
  if (has)
  {
    return page.substr(0, begin) + block + page.substr(end + std::string(kEnd).size());
  }
  begin = std::min(page.find(kSection), page.size());
  return page.substr(0, begin) + block + "\n\n" + page.substr(begin);
}

} // namespace bench
} // namespace pointhaptics
