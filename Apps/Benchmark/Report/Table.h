/// @file
/// A table of text: lined up for a terminal, or as Markdown.
#pragma once

#include "Benchmark/Harness/Statistics.h"

#include <string>
#include <vector>

namespace pointhaptics
{
namespace bench
{

struct Table
{
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows; ///< Short rows are filled up with empty cells.
};

/// Numbers to the right, words to the left, two blanks between.
std::string toText(const Table& table);
std::string toMarkdown(const Table& table);

/// 1234567 as 1,234,567.
std::string grouped(long long number);
/// Three significant digits without an exponent where that stays short: 0.0123, 1.23, 12.3, 123, 1235.
std::string brief(double number);
/// A time of @p seconds in milliseconds, without the unit.
std::string milliseconds(double seconds);
/// "lower - upper" in milliseconds.
std::string quartilesText(const Quartiles& seconds);

} // namespace bench
} // namespace pointhaptics
