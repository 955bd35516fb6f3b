#include "IO/Columns/ColumnGuess.h"

#include "FileProblem.h"
#include "IO/Columns/CloudColumns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace pointhaptics::io
{

namespace
{

constexpr std::size_t kMostLabels = 64;
constexpr std::size_t kFewestIds = 3;

using Columns = std::vector<ColumnEvidence>;

std::size_t numberOfValues(const ColumnEvidence& column)
{
  return std::set<double>(column.sample.begin(), column.sample.end()).size();
}

/// Programs write labels with decimals, too: "2.000000".
bool isLabel(const ColumnEvidence& column)
{
  const std::size_t values = numberOfValues(column);
  return column.least >= -1.0 && values < column.sample.size() && values <= kMostLabels &&
    std::all_of(column.sample.begin(), column.sample.end(), [](double v) { return v == std::floor(v); });
}

bool areColors(const Columns& columns, std::size_t first);

/// Seconds or parts of them since an epoch, which no coordinates beside them reach.
bool isEpoch(const Columns& columns)
{
  constexpr double kEpoch = 1e8;
  return columns[0].least >= kEpoch && std::is_sorted(columns[0].sample.begin(), columns[0].sample.end()) &&
    std::none_of(columns.begin() + 1, columns.begin() + 4,
      [](const ColumnEvidence& c) { return c.most >= kEpoch || c.least <= -kEpoch; });
}

/// Whole numbers that count the rows, and coordinates that are not all whole; or any but epochs before three
/// coordinates with decimals which are those of a map; or any that differ before such ones with whole colours
/// or with a description and no more.
bool isId(const Columns& columns, bool hasDescription)
{
  if (columns.size() < 4 || !columns[0].isWhole ||
    std::all_of(columns.begin() + 1, columns.begin() + 4, [](const ColumnEvidence& c) { return c.isWhole; }))
  {
    return false;
  }
  const std::vector<double>& ids = columns[0].sample;
  constexpr double kMapCoordinate = 1e5;
  const bool hasDecimals =
    std::none_of(columns.begin() + 1, columns.begin() + 4, [](const ColumnEvidence& c) { return c.isWhole; });
  const bool hasColors = columns.size() >= 7 && columns[4].isWhole && areColors(columns, 4);
  const bool isMap =
    columns[1].least >= kMapCoordinate && columns[2].least >= kMapCoordinate && !isEpoch(columns);
  const bool isNumbered = numberOfValues(columns[0]) == ids.size() && !isEpoch(columns) &&
    (hasColors || (hasDescription && columns.size() == 4));
  const bool isLikely = hasDecimals && (isMap || isNumbered);
  const bool isCounted =
    std::adjacent_find(ids.begin(), ids.end(), [](double a, double b) { return b != a + 1.0; }) == ids.end();
  return ids.size() < kFewestIds ? isLikely && isCounted : isLikely || isCounted;
}

/// True if the values go on from row to row, as the coordinates of a path do.
bool isSmooth(const ColumnEvidence& column)
{
  constexpr double kStep = 0.2; // of the range of the sample
  const std::vector<double>& v = column.sample;
  const auto [least, most] = std::minmax_element(v.begin(), v.end());
  const double longest = kStep * (*most - *least);
  return std::adjacent_find(
           v.begin(), v.end(), [&](double a, double b) { return !(std::abs(b - a) <= longest); }) == v.end();
}

/// Times before the coordinates: those of an epoch, or numbers that grow by the same step beside the three
/// coordinates of a path. A profile of a scanner also has coordinates of one step, but nothing that goes on
/// smoothly in all three columns after them.
bool isClock(const Columns& columns)
{
  constexpr double kRounded = 1e-3; // of a step
  constexpr std::size_t kFewestWhole = 8;
  if (columns.size() < 4 || columns[0].sample.size() < kFewestIds)
  {
    return false;
  }
  const auto isSteady = [](const ColumnEvidence& column)
  {
    const std::vector<double>& v = column.sample;
    const double step = v[1] - v[0];
    return std::adjacent_find(v.begin() + 1, v.end(),
             [&](double a, double b)
             { return !(std::abs(b - a - step) <= kRounded * std::abs(step)); }) == v.end();
  };
  return isEpoch(columns) ||
    ((!columns[0].isWhole || columns[0].sample.size() >= kFewestWhole) && isSteady(columns[0]) &&
      columns[0].sample.back() > columns[0].sample.front() &&
      std::none_of(columns.begin() + 1, columns.begin() + 4, isSteady) &&
      std::all_of(columns.begin() + 1, columns.begin() + 4, isSmooth));
}

bool areColors(const Columns& columns, std::size_t first)
{
  if (first + 3 > columns.size())
  {
    return false;
  }
  double most = 0.0;
  int whole = 0;
  bool isPositive = true;
  for (std::size_t i = first; i < first + 3; ++i)
  {
    most = std::max(most, columns[i].most);
    whole += columns[i].isWhole ? 1 : 0;
    isPositive = isPositive && columns[i].least >= 0.0;
  }
  return isPositive && (whole == 3 ? most <= 65535.0 : most <= 1.0 || (whole == 0 && most <= 255.0));
}

bool areNormals(const Columns& columns, std::size_t first)
{
  constexpr double kRounded = 0.02;
  bool hasUnit = false;
  for (std::size_t row = 0; first + 3 <= columns.size() && row < columns[first].sample.size(); ++row)
  {
    double squares = 0.0;
    for (std::size_t i = first; i < first + 3; ++i)
    {
      squares += columns[i].sample[row] * columns[i].sample[row];
    }
    const bool isUnit = std::abs(squares - 1.0) <= kRounded;
    if (!isUnit && !(squares == 0.0) && !std::isnan(squares))
    {
      return false;
    }
    hasUnit = hasUnit || isUnit;
  }
  return hasUnit;
}

/// True if of four columns the last is less like the one beside it than a color is like another.
bool isLastOdd(const ColumnEvidence* four)
{
  const std::size_t last = numberOfValues(four[3]);
  const std::size_t beside = numberOfValues(four[2]);
  const bool isBesideConstant =
    beside == 1 && four[3].sample != four[2].sample && (last > 1 || four[0].sample == four[1].sample);
  return !isLabel(four[0]) || 2 * last < beside || isBesideConstant;
}

/// True if a number stands at @p at before the colours or normals that end the row.
bool isScalarFirst(const Columns& columns, std::size_t at)
{
  const std::size_t left = columns.size() - at;
  const bool isLastLabel = left >= 4 && isLabel(columns[at + 3]) && isLastOdd(&columns[at]);
  const bool isWhole = columns[at].isWhole && areColors(columns, at + 1);
  return isWhole && !isLastLabel && (left == 4 || (left == 7 && areNormals(columns, at + 4)));
}

/// Names of the normals and colours from @p at on; empty for all others.
std::vector<std::string> vectorNames(const Columns& columns, std::size_t at, bool prefersColors)
{
  std::vector<std::string> names(columns.size());
  bool hasColors = false;
  bool hasNormals = false;
  while (at < columns.size())
  {
    const bool mayBeColors = !hasColors && areColors(columns, at);
    const bool isNormal = !hasNormals && areNormals(columns, at) && !(mayBeColors && prefersColors);
    const bool isColor = !isNormal && mayBeColors && !isScalarFirst(columns, at);
    hasNormals = hasNormals || isNormal;
    hasColors = hasColors || isColor;
    const std::vector<std::string> own = isNormal ? std::vector<std::string>{ "nx", "ny", "nz" }
      : isColor                                   ? std::vector<std::string>{ "red", "green", "blue" }
                                                  : std::vector<std::string>(1);
    std::copy(own.begin(), own.end(), names.begin() + static_cast<std::ptrdiff_t>(at));
    at += own.size();
  }
  return names;
}

/// True if the first two columns number the rays of a scanner, before coordinates with decimals and colours.
bool areRowAndColumn(const Columns& columns)
{
  const auto isWhole = [](const ColumnEvidence& c) { return c.isWhole && c.least >= 0.0; };
  return columns.size() >= 8 && isWhole(columns[0]) && isWhole(columns[1]) && isWhole(columns[5]) &&
    std::none_of(
      columns.begin() + 2, columns.begin() + 5, [](const ColumnEvidence& c) { return c.isWhole; }) &&
    areColors(columns, 5);
}

/// True if the columns @p north and @p east look like northing and easting of UTM.
bool areMapCoordinates(const Columns& columns, std::size_t north, std::size_t east)
{
  const auto isWithin = [&](std::size_t i, double least, double most)
  { return i < columns.size() && columns[i].least >= least && columns[i].most < most; };
  return isWithin(north, 1e6, 1e7) && isWithin(east, 1e5, 1e6);
}

} // namespace

GuessedColumns guessColumnNames(
  const std::vector<ColumnEvidence>& columns, bool prefersColors, bool hasName, bool hasDescription)
{
  constexpr std::size_t kMostGuessed = 64;
  failFormatIf(columns.size() > kMostGuessed,
    "save x, y and z of its pixels, or name the columns by --columns where they are none",
    "{} columns without names are an image, as of depths", columns.size());
  const bool hasId = isId(columns, hasDescription);
  const bool hasRays = !hasId && areRowAndColumn(columns);
  const std::size_t first = hasRays ? 2 : hasId || isClock(columns) ? 1 : 0;
  std::vector<std::string> names = vectorNames(columns, first + 3, prefersColors);
  if (first > 0)
  {
    names[0] = hasRays ? "row" : hasId ? "id" : "time";
    names[first - 1] = hasRays ? "column" : names[0];
  }
  const bool hasCode = columns.size() == first + 4 && columns.back().isWhole && isLabel(columns.back());
  const bool isSurvey = (hasId || hasName) && (hasDescription || hasCode);
  const bool isNorthingFirst = areMapCoordinates(columns, first, first + 1);
  const char* const order = isSurvey && isNorthingFirst ? "yxz" : "xyz";
  for (std::size_t i = 0; i < 3 && first + i < names.size(); ++i)
  {
    names[first + i] = std::string(1, order[i]);
  }
  std::size_t label = names.size(); // the one of fewest values
  for (std::size_t i = first + 3; i < names.size(); ++i)
  {
    const bool isFewer = label == names.size() || numberOfValues(columns[i]) < numberOfValues(columns[label]);
    label = names[i].empty() && isLabel(columns[i]) && isFewer ? i : label;
  }
  label < names.size() ? void(names[label] = "label") : void();
  const auto scalars = std::count(names.begin(), names.end(), "");
  for (std::size_t i = first + 3; i < names.size(); ++i)
  {
    const std::string scalar = scalars == 1 ? "intensity" : "column_" + std::to_string(i + 1);
    names[i] = names[i].empty() ? scalar : names[i];
  }
  return { names, isNorthingFirst || (isSurvey && !areMapCoordinates(columns, first + 1, first)) };
}

std::string takeSurveyAxes(const std::vector<ColumnEvidence>& columns, std::vector<std::string>& names)
{
  std::vector<std::size_t> at; // x, y and z
  if (!findCoordinates(columnsCalled(names), at) || coordinateWord(names[at[0]]) != "x" ||
    coordinateWord(names[at[1]]) != "y")
  {
    return {};
  }
  const bool isNorth = areMapCoordinates(columns, at[0], at[1]);
  const bool isYFirst = at[1] + 1 == at[0] && at[0] + 1 == at[2] && !areMapCoordinates(columns, at[1], at[0]);
  const std::string height = coordinateWord(names[at[2]]);
  const bool isOfSurvey = height[0] == 'h' && height != "height" && height != "hae";
  const bool isSurvey = isYFirst && (isOfSurvey || isNorth);
  std::vector<std::string> others = names;
  std::swap(others[at[0]], others[at[1]]);
  isSurvey ? others.swap(names) : void();
  const char* const why = isYFirst ? "Y stands before X in the header" : "X is like northings";
  const char* const taken = isSurvey ? "the easting, as surveys have it" : "it is called";
  return !isYFirst && !(isNorth && isOfSurvey)
    ? std::string()
    : fmt::format(
        "{}, and is taken as {}; where that is wrong, give --columns {}", why, taken, listOf(others));
}

std::string listOf(const std::vector<std::string>& names)
{
  std::vector<std::string> shown = names;
  std::replace(shown.begin(), shown.end(), std::string(), std::string("-"));
  return fmt::format("{}", fmt::join(shown, ","));
}

std::string guessNote(const std::vector<std::string>& names, bool mayBeSwapped)
{
  std::vector<std::string> swapped = names;
  const auto x = std::find(swapped.begin(), swapped.end(), "x");
  const auto y = std::find(swapped.begin(), swapped.end(), "y");
  x != swapped.end() && y != swapped.end() ? std::iter_swap(x, y) : void();
  return "no header names the columns, which are taken as " + listOf(names) +
    (mayBeSwapped
        ? "; where northing and easting stand the other way round, give --columns " + listOf(swapped)
        : "; --columns NAMES says otherwise");
}

} // namespace pointhaptics::io
