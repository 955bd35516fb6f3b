#include "IO/Text/TextTable.h"

#include "Bytes/Checks.h"
#include "IO/Columns/CloudColumns.h"
#include "IO/Formats/FormatLooks.h"
#include "IO/Info/LengthUnit.h"
#include "IO/Text/TextCells.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace pointhaptics::io
{

namespace
{

int typeOf(const std::string& name, const NumberColumn& column, bool isCoordinate)
{
  if (isCoordinate || isNormalName(name))
  {
    return column.floatingType();
  }
  if (isColorName(name) && column.isInteger(65535.0))
  {
    return column.isInteger(255.0) ? VTK_TYPE_UINT8 : VTK_TYPE_UINT16;
  }
  return column.type();
}

const char* separatorName(char separator)
{
  return separator == ',' ? "comma separated"
    : separator == ';'    ? "semicolon separated"
    : separator == '|'    ? "separated by |"
    : separator == '\t'   ? "tab separated"
                          : "space separated";
}

constexpr const char* kLeftOut = "-";

/// The columns that are read.
std::vector<std::size_t> columnsOfNumbers(const TextTable& table, const TextLayout& layout)
{
  std::vector<std::size_t> columns;
  for (std::size_t i = 0; i < table.columns.size(); ++i)
  {
    if (!table.isOfTexts(i) && (layout.names.empty() || layout.names[i] != kLeftOut))
    {
      columns.push_back(i);
    }
  }
  return columns;
}

/// The names of all columns, of which @p read are read.
std::vector<std::string> namesOf(
  const TextTable& table, const TextLayout& layout, const std::vector<std::size_t>& read, ReadTask& task)
{
  if (!layout.names.empty())
  {
    return layout.names;
  }
  std::vector<ColumnEvidence> evidence;
  for (const std::size_t i : read)
  {
    evidence.push_back(table.columns[i].numbers);
  }
  const bool hasName = !read.empty() && read[0] > 0;
  const bool hasDescription =
    table.hasMore || (!read.empty() && table.columns.size() - read[0] > read.size());
  const GuessedColumns guessed =
    guessColumnNames(evidence, task.extension == "xyzrgb", hasName, hasDescription);
  std::vector<std::string> names(table.columns.size());
  for (std::size_t i = 0; i < read.size(); ++i)
  {
    names[read[i]] = guessed.names[i];
  }
  if ((read.size() > 3 && !layout.hasPointCount) || layout.isNumbered || guessed.mayBeSwapped) // PTS is known
  {
    task.notes.push_back(guessNote(names, guessed.mayBeSwapped));
  }
  return names;
}

/// @throws FileProblem where x, y or z holds a text.
void checkCoordinates(const TextTable& table, const TextLayout& layout, const std::vector<std::size_t>& read)
{
  const std::vector<std::size_t> places =
    layout.names.empty() ? read : coordinatesOf(columnsCalled(layout.names));
  const bool areTooFew = places.size() < 3; // as the others hold texts
  for (std::size_t i = 0; i < (areTooFew ? table.columns.size() : 3); ++i)
  {
    const std::size_t column = areTooFew ? i : places[i];
    const TextColumn& texts = table.columns[column];
    failFormatIf(texts.texts > 0,
      "write x, y and z as numbers with the same separator on every line, without marks between thousands, "
      "and "
      "comments after #",
      "{}, column {}: {} is not a number", texts.where(), column + 1, inQuotes(texts.firstText));
  }
}

/// Note on the texts in column @p i; empty where it has none.
std::string noteOf(const TextTable& table, std::size_t i, const std::string& name)
{
  const TextColumn& texts = table.columns[i];
  if (texts.texts == 0)
  {
    return {};
  }
  const std::string column = name.empty() ? std::to_string(i + 1) : inQuotes(name);
  const std::string first = inQuotes(texts.firstText) + " in " + texts.where();
  return table.isOfTexts(i)
    ? fmt::format(
        "column {} holds texts, such as {}, and is left out; write numbers in their place to keep it", column,
        first)
    : fmt::format("{} of {} cells of column {} hold no number, such as {}, and become NaN; write numbers in "
                  "their place to keep them",
        texts.texts, table.rows, column, first);
}

constexpr const char* kCureOfCommas =
  "commas seem to separate columns and to mark decimals, too: write decimal points, put numbers in quotation "
  "marks, or separate the columns by semicolons";

/// Refuses "1,05,2,50,3,00", where nobody can tell where a column ends: numbers without a point, of which
/// every second one has no sign and may start with a 0 that only decimals have.
void failTornDecimals(std::string_view text, const TextLayout& layout)
{
  constexpr std::size_t kLookedAt = 1000;
  if (layout.separator != ',' || !layout.names.empty() || layout.columns < 6 || layout.columns % 2 != 0)
  {
    return;
  }
  LineReader lines(text.substr(layout.bodyOffset), layout.bodyLine);
  std::string torn;
  std::string_view line;
  while (lines.next(line) && lines.lineNumber() < layout.bodyLine + kLookedAt)
  {
    const std::vector<std::string_view> cells = cellsOf(line, ',', lines.lineNumber());
    for (std::size_t i = 0; i < cells.size() && !isComment(trimmed(line)); ++i)
    {
      const std::size_t sign = i % 2 == 0 && cells[i].substr(0, 1) == "-" ? 1 : 0;
      if (cells[i].size() == sign || cells[i].find_first_not_of("0123456789", sign) != std::string_view::npos)
      {
        return;
      }
      if (torn.empty() && i % 2 == 1 && cells[i].size() > 1 && cells[i].front() == '0')
      {
        torn = "line " + std::to_string(lines.lineNumber()) + ", column " + std::to_string(i + 1) + ": " +
          inQuotes(cells[i]) + " starts with a 0";
      }
    }
  }
  failFormatIf(!torn.empty(), kCureOfCommas, "{}", torn);
}

/// Takes the unit that the header says: "mm" of "x [mm]", "y [mm]", "z [mm]", "degree" of longitude and
/// latitude, whose heights are lengths. @throws FileProblem where it says unlike ones.
void takeUnits(const std::vector<std::string>& names, FileComments& comments)
{
  std::string unit;
  const auto coordinates = names.empty() ? std::vector<std::size_t>() : coordinatesOf(columnsCalled(names));
  for (const std::size_t i : coordinates)
  {
    const std::string own = coordinateUnit(names[i]);
    const std::string known = lengthUnitCalled(own);
    if (unit == "degree" && i == coordinates[2])
    {
      comments.heightUnit = known.empty() || known == "deg" || known == "m" ? "" : own;
      continue;
    }
    if (own.empty())
    {
      return;
    }
    failFormatIf(!unit.empty() && own != unit && (known.empty() || known != lengthUnitCalled(unit)),
      "convert the columns to one unit, or name them by --columns where they are in one",
      "{} is in {}, other coordinates are in {}", inQuotes(names[i]), own, unit);
    unit = own;
  }
  comments.unit = unit.empty() ? comments.unit : unit;
}

/// The first pass. Lines of many lengths, such as those that end with a list, are read as far as all go.
TextTable surveyLines(const ReadTask& task, std::string_view text, TextLayout& layout)
{
  try
  {
    return surveyTable(task, text, layout);
  }
  catch (const ColumnsDiffer&)
  {
    constexpr std::size_t kFewest = 4;
    const std::size_t columns = layout.names.empty() ? columnsOfAll(text, layout) : 0;
    if (columns < kFewest)
    {
      throw;
    }
    layout.columns = columns;
    layout.hasMore = true;
    return surveyTable(task, text, layout);
  }
}

void noteColumns(const TextTable& table, const TextLayout& layout, const std::vector<std::string>& names,
  std::vector<std::string>& notes)
{
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    if (std::string note = noteOf(table, i, names[i]); !note.empty() && names[i] != kLeftOut)
    {
      notes.push_back(std::move(note));
    }
    if (table.columns[i].numbers.losesDigits())
    {
      notes.push_back("column " + inQuotes(names[i]) +
        " has whole numbers of 2^53 and more, which are rounded: the last digits are lost");
    }
  }
  if (table.hasMore && layout.note.empty()) // which says it
  {
    notes.push_back("what stands behind column " + std::to_string(names.size()) + ", " +
      inQuotes(names.back()) + ", is left out; --columns with more names reads more of each line");
  }
}

} // namespace

void readTable(ReadTask& task, std::string_view text, TextLayout layout, vtkPolyData* cloud)
{
  if (task.salvage && layout.hasPointCount)
  {
    text = text.substr(0, text.rfind('\n') + 1); // behind it the file may be cut within a number
  }
  const TextTable table = surveyLines(task, text, layout);
  table.rows == 0 ? failNoPoints() : void();
  if (table.missing > 0)
  {
    task.endAt(static_cast<std::uint64_t>(table.rows), static_cast<std::uint64_t>(table.rows) + table.missing,
      "the file ends " + std::to_string(table.missing) +
        " points before the count in its first line is reached");
  }
  const std::vector<std::size_t> read = columnsOfNumbers(table, layout);
  checkCoordinates(table, layout, read);
  const std::vector<std::string> names = namesOf(table, layout, read, task);
  noteColumns(table, layout, names, task.notes);
  std::vector<Column> planned;
  for (const std::size_t i : read)
  {
    planned.push_back({ names[i] });
  }
  const std::vector<std::size_t> coordinates = coordinatesOf(planned);
  for (std::size_t i = 0; i < read.size(); ++i)
  {
    const bool isCoordinate = std::find(coordinates.begin(), coordinates.end(), i) != coordinates.end();
    planned[i].type = typeOf(names[read[i]], table.columns[read[i]].numbers, isCoordinate);
  }
  CloudColumns columns(planned, table.rows);
  std::vector<ColumnView> targets(names.size(), ColumnView{ nullptr, 0, VTK_DOUBLE });
  for (std::size_t i = 0; i < read.size(); ++i)
  {
    targets[read[i]] = columns.target(i);
  }
  storeTable(task, text, layout, targets);
  columns.moveTo(cloud, task);
}

void readText(ReadTask& task, vtkPolyData* cloud)
{
  task.format = "text";
  std::string_view text = withoutByteOrderMark(task.bytes);
  const std::string joined = withoutLineEndsInCells(text);
  text = joined.empty() ? text : joined;
  const TextLayout layout = inspectText(text, task.columns);
  const bool isBlank = layout.columns == 0 && layout.names.empty();
  task.format = layout.hasPointCount ? "PTS"
    : isBlank                        ? "text"
                                     : std::string("text (") + separatorName(layout.separator) + ")";
  layout.columns == 0 ? failNoPoints() : void();
  failFormatIf(!task.columns.empty() && task.columns.size() < 3,
    "name x, y and z, and - for each column that is left out",
    "--columns has {} names, and a point needs three", task.columns.size());
  failFormatIf(layout.columns < 3 || (!layout.names.empty() && layout.names.size() != layout.columns),
    layout.separator == ',' && layout.columns > layout.names.size()
      ? kCureOfCommas
      : "write one point per line: x y z, then one column per name of the header; or name them by "
        "--columns",
    "the first line of data has {}{}{}", layout.columns, (layout.columns == 1 ? " column" : " columns"),
    (layout.names.empty() ? "" : " and the header names " + std::to_string(layout.names.size())));
  failTornDecimals(text, layout);
  FileComments comments = layout.comments;
  takeUnits(layout.names, comments);
  layout.note.empty() ? void() : task.notes.push_back(layout.note);
  readTable(task, text, layout, cloud);
  comments.moveTo(cloud, task.notes);
}

} // namespace pointhaptics::io
