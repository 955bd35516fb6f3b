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

  /// Evidence of @p sample alone.
  static ColumnEvidence of(std::vector<double> sample, bool isWhole);
};

/// Names for columns that have none:
/// - whole numbers that count the rows, before three coordinates: id;
/// - x, y, z; behind an id y, x, z where these can only be a northing and an easting;
/// - three of unit length together: nx ny nz; three within 0..1 or 0..255 together, or of 16 bits: red green
///   blue;
/// - whole numbers of few values: label; one other number: intensity; more: column_4 and so on.
/// Four whole numbers of which all may be colours are intensity and colours, unless the last is a label.
/// @param prefersColors whether vectors that may be both are colours.
std::vector<std::string> guessColumnNames(const std::vector<ColumnEvidence>& columns, bool prefersColors);

/// True if the columns from @p at on may be northing and easting of UTM, whose eastings have a digit less.
/// Feet of a state plane look so, too, the other way round; those of numbered points hardly come in this
/// order.
bool mayBeNorthingFirst(const std::vector<ColumnEvidence>& columns, std::size_t at = 0);

/// "columns are taken as x,y,z,intensity, which no header says; --columns NAMES names them otherwise".
std::string guessNote(const std::vector<std::string>& names);

} // namespace pointhaptics::io
