/// @file
/// The summary at the top of a page: at most ten rows, whose figures are quoted from the tables below.
#pragma once

#include "Benchmark/Report/Table.h"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace pointhaptics
{
namespace bench
{

/// What a reader asks first, and the answer with figures as the tables have them.
struct SummaryRow
{
  std::string question;
  std::string answer;
};

/// A page's summary has no more rows than this: a person reads ten.
constexpr std::size_t kMostSummaryRows = 10;

/// The rows of a table whose cells in the named columns have the named texts.
class TableRows
{
public:
  explicit TableRows(const Table& table);

  /// Those among them with @p text in @p column; none where there is no such column.
  TableRows where(const std::string& column, const std::string& text) const;
  /// Those among them with another text there.
  TableRows whereNot(const std::string& column, const std::string& text) const;

  /// The cell of the last of them, empty where there is none. Tables grow downwards: the last is the largest.
  std::string last(const std::string& column) const;
  /// The cells with the smallest and the largest number of the column, as they are written.
  std::pair<std::string, std::string> range(const std::string& column) const;
  /// The sum of the column's whole numbers, empty where there is no row.
  std::string sum(const std::string& column) const;

private:
  TableRows with(const std::string& column, const std::string& text, bool equal) const;
  std::size_t indexOf(const std::string& column) const;

  const Table* table_;
  std::vector<const std::vector<std::string>*> rows_;
};

/// "0.01" of twice the same, else "0.01 to 5".
std::string rangeText(const std::pair<std::string, std::string>& range);

/// The summary's table on @p page text with the rows that name the section @p title replaced by @p rows; new
/// ones go to the end. A page without a summary gets one before its first section.
std::string withSummary(
  const std::string& page, const std::string& title, const std::vector<SummaryRow>& rows);

} // namespace bench
} // namespace pointhaptics
