#include "Benchmark/Report/Table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace bench
{
namespace
{

std::string cell(const std::vector<std::string>& row, std::size_t column)
{
  return column < row.size() ? row[column] : std::string();
}

bool looksLikeANumber(const std::string& text)
{
  return !text.empty() && text.find_first_not_of("0123456789.,+-e x%") == std::string::npos;
}

/// True where most cells are numbers.
bool isNumeric(const Table& table, std::size_t column)
{
  std::size_t numbers = 0, words = 0;
  for (const auto& row : table.rows)
  {
    const std::string text = cell(row, column);
    numbers += looksLikeANumber(text);
    words += !text.empty() && !looksLikeANumber(text);
  }
  return numbers > words;
}

std::string line(
  const Table& table, const std::vector<std::string>& row, const std::vector<std::size_t>& widths)
{
  std::string text;
  for (std::size_t column = 0; column < table.header.size(); ++column)
  {
    text += column == 0 ? "" : "  ";
    text += isNumeric(table, column) ? fmt::format("{:>{}}", cell(row, column), widths[column])
                                     : fmt::format("{:<{}}", cell(row, column), widths[column]);
  }
  return text.substr(0, text.find_last_not_of(' ') + 1) + "\n";
}

std::string markdownLine(const std::vector<std::string>& cells, std::size_t columns)
{
  std::string text = "|";
  for (std::size_t column = 0; column < columns; ++column)
  {
    text += " " + cell(cells, column) + " |";
  }
  return text + "\n";
}

} // namespace

std::string toText(const Table& table)
{
  std::vector<std::size_t> widths;
  for (std::size_t column = 0; column < table.header.size(); ++column)
  {
    std::size_t width = table.header[column].size();
    for (const auto& row : table.rows)
    {
      width = std::max(width, cell(row, column).size());
    }
    widths.push_back(width);
  }
  std::string text = line(table, table.header, widths);
  for (const auto& row : table.rows)
  {
    text += line(table, row, widths);
  }
  return text;
}

std::string toMarkdown(const Table& table)
{
  const std::size_t columns = table.header.size();
  std::string text = markdownLine(table.header, columns) + "|";
  for (std::size_t column = 0; column < columns; ++column)
  {
    text += isNumeric(table, column) ? "---:|" : "---|";
  }
  text += "\n";
  for (const auto& row : table.rows)
  {
    text += markdownLine(row, columns);
  }
  return text;
}

std::string grouped(long long number)
{
  std::string text = fmt::format("{}", number);
  const std::size_t first = number < 0 ? 1 : 0;
  for (std::size_t at = text.size(); at > first + 3;)
  {
    at -= 3;
    text.insert(at, ",");
  }
  return text;
}

std::string brief(double number)
{
  const double size = std::abs(number);
  if (number == 0.0)
  {
    return "0";
  }
  if (size < 1e-3 || size >= 1e6)
  {
    return fmt::format("{:.2e}", number);
  }
  const int digits = std::clamp(2 - int(std::floor(std::log10(size))), 0, 5);
  return fmt::format("{:.{}f}", number, digits);
}

std::string milliseconds(double seconds)
{
  return brief(1e3 * seconds);
}

std::string quartilesText(const Quartiles& seconds)
{
  return milliseconds(seconds.lower) + " - " + milliseconds(seconds.upper);
}

} // namespace bench
} // namespace pointhaptics
