/// @file
/// Recognises columns without names by their values.
#pragma once

#include <string>
#include <vector>

namespace pointhaptics::io
{

/// Rows that are enough to tell.
constexpr std::size_t kGuessedRows = 1000;

/// One column of numbers.
struct ColumnEvidence
{
  std::vector<double> sample; ///< Values of the first rows.
  double least = 0.0;         ///< Least value of all rows.
  double most = 0.0;
  bool isWhole = false; ///< All numbers are written without a point.
};

struct GuessedColumns
{
  std::vector<std::string> names;
  bool mayBeSwapped = false; ///< Northing and easting: nothing makes their order certain.
};

/// Names for columns that have none:
/// - whole numbers that count the rows, before three coordinates: id;
/// - x, y, z; of a survey y, x, z where these look like northing and easting of UTM, whose eastings have a
///   digit less. Feet of a state plane look so, too, the other way round;
/// - three of unit length together: nx ny nz; three within 0..1 or 0..255 together, or of 16 bits: red green
///   blue;
/// - whole numbers of few values: label; one other number: intensity; more: column_4 and so on.
/// Four whole numbers of which all may be colours are intensity and colours, unless the last is a label.
/// @param prefersColors whether vectors that may be both are colours.
/// @param hasName whether texts stand before the columns.
/// @param hasDescription whether texts stand behind coordinates, which a survey is then, as it is with a code
/// in the place of these: it has names or numbers before them, too.
GuessedColumns guessColumnNames(const std::vector<ColumnEvidence>& columns, bool prefersColors,
  bool hasName = false, bool hasDescription = false);

/// Surveys call the easting Y and the northing X, in this order before the height. Swaps the two among
/// @p names, those of a header, where the height is called H or the values are like UTM's.
/// @return the note on it; empty where the header has another order.
std::string takeSurveyAxes(const std::vector<ColumnEvidence>& columns, std::vector<std::string>& names);

/// "a,b", with - for empty names.
std::string listOf(const std::vector<std::string>& names);

/// Says that columns are taken as @p names, of which @p mayBeSwapped is that of GuessedColumns.
std::string guessNote(const std::vector<std::string>& names, bool mayBeSwapped);

} // namespace pointhaptics::io
