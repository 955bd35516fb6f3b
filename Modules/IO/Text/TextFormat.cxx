#include "IO/Text/TextTable.h"

#include "FileProblem.h"
#include "IO/Columns/CloudColumns.h"
#include "IO/Formats/FormatLooks.h"
#include "IO/Info/LengthUnit.h"
#include "IO/Text/TextCells.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

namespace pointhaptics::io
{

namespace
{

struct TextColumn
{
  NumberColumn numbers;   ///< Texts are empty cells here.
  std::int64_t texts = 0; ///< Cells that hold something else than a number,
  std::size_t line = 0;   ///< the line of the first one,
  std::string firstText;  ///< and its content.

  std::string where() const { return "line " + std::to_string(line); }
};

/// The results of a first pass over the text.
struct TextTable
{
  std::vector<TextColumn> columns;
  vtkIdType rows = 0;
  std::uint64_t missing = 0; ///< Rows that a count promises and the text does not have.
  bool hasMore = false;      ///< Lines have more columns than are read.

  /// True if texts outnumber the numbers of column @p i: it holds names, and nothing to compute with.
  bool isOfTexts(std::size_t i) const { return columns[i].texts > rows - columns[i].numbers.empty; }
};

/// A line that has more or fewer columns than the first.
class ColumnsDiffer : public FileProblem
{
public:
  using FileProblem::FileProblem;
  std::size_t torn = std::string_view::npos; ///< Where it begins, if it is the last one and has fewer.
};

/// Walks over the lines of data and shows each cell to a Sink: number(column, value, shape), empty(column),
/// text(column, cell, lineNumber), more() for columns that are left out, endRow().
template <typename Sink>
struct TableWalk
{
  const ReadTask& task;
  std::string_view text;
  const TextLayout& layout;
  Sink& sink;
  unsigned long long remainingLines =
    layout.hasPointCount ? 0 : std::numeric_limits<unsigned long long>::max();
  std::size_t lineNumber = 0;

  void run(double from, double to)
  {
    LineReader lines(text.substr(layout.bodyOffset), layout.bodyLine);
    std::string_view line;
    while (lines.next(line))
    {
      line = trimmed(line, layout.separator);
      lineNumber = lines.lineNumber();
      const bool isFilled = !line.empty() && !isComment(line);
      if (isFilled && remainingLines == 0)
      {
        startBlock(line);
      }
      else if (isFilled)
      {
        addCells(line);
        sink.endRow();
        --remainingLines;
      }
      if (lineNumber % static_cast<std::size_t>(kProgressRows) == 0)
      {
        const double part =
          static_cast<double>(layout.bodyOffset + lines.position()) / static_cast<double>(text.size());
        task.progress(from + (to - from) * part);
      }
    }
    layout.hasPointCount ? sink.missing(remainingLines) : void();
  }
  void addCells(std::string_view line)
  {
    const bool areWords = layout.separator == ' ';
    std::string_view rest = line;
    std::string_view cell;
    for (std::size_t column = 0; column < layout.columns; ++column)
    {
      double value = 0.0;
      NumberShape shape;
      if (areWords && takeNumber(rest, value, &shape)) // as nearly all are
      {
        sink.number(column, value, shape);
        continue;
      }
      if (!takeCell(rest, layout.separator, cell))
      {
        failColumns(line);
      }
      bool isNumber = parseCell(cell, value, &shape);
      const std::string_view plain = isNumber ? cell : withoutComment(cell);
      if (plain.size() < cell.size() && parseCell(plain, value, &shape))
      {
        isNumber = true;
        rest = {};
      }
      isNumber ? sink.number(column, value, shape) : addText(column, cell);
    }
    while (!rest.empty() && takeCell(rest, layout.separator, cell) && !(areWords && isComment(cell)))
    {
      if (!cell.empty()) // a separator at the end of a line is common
      {
        layout.hasMore ? sink.more() : failColumns(line);
        break;
      }
    }
  }
  /// Programs write a word where they have no value, or nothing.
  void addText(std::size_t column, std::string_view cell)
  {
    constexpr std::string_view kNoValue[] = { "NULL", "NA", "N/A", "#N/A", "none", "nil" };
    const std::string_view word = withoutQuotes(cell);
    const bool isValue = std::none_of(std::begin(kNoValue), std::end(kNoValue),
      [word](std::string_view none) { return word.empty() || equalNoCase(word, none); });
    isValue ? sink.text(column, cell, lineNumber) : sink.empty(column);
  }
  void startBlock(std::string_view line)
  {
    failFormatIf(!parseCount(trimmed(line), remainingLines),
      "write the right number of points in the first line",
      "{}{} stands where a count of points was expected", atLine(lineNumber), inQuotes(line));
    failTruncatedIf(remainingLines > text.size() && !task.salvage,
      "{}the count of points is {} in a file of {} bytes", atLine(lineNumber), remainingLines, text.size());
  }
  [[noreturn]] void failColumns(std::string_view line) const
  {
    const std::size_t count = cellsOf(line, layout.separator, lineNumber).size();
    const auto begin = static_cast<std::size_t>(line.data() - text.data());
    const bool isTorn = count < layout.columns &&
      text.find_first_not_of(" \t\r\n", begin + line.size()) == std::string_view::npos;
    ColumnsDiffer problem(vtkErrorCode::FileFormatError,
      fmt::format("{}{} columns where {} were expected", atLine(lineNumber), count, layout.columns),
      std::string("write the same number of columns on every line") + (isTorn ? kSalvageCure : ""));
    problem.torn = isTorn ? begin : problem.torn;
    throw problem;
  }
};

struct SurveySink
{
  TextTable table;

  void number(std::size_t column, double value, NumberShape shape)
  {
    table.columns[column].numbers.add(value, shape);
  }
  void empty(std::size_t column) { table.columns[column].numbers.addEmpty(); }
  void text(std::size_t column, std::string_view cell, std::size_t line)
  {
    TextColumn& texts = table.columns[column];
    if (texts.texts++ == 0)
    {
      texts.line = line;
      texts.firstText = withoutQuotes(cell);
    }
    this->empty(column);
  }
  void more() { table.hasMore = true; }
  void missing(std::uint64_t rows) { table.missing = rows; }
  void endRow() { ++table.rows; }
};

/// Stores every number in its place; a target without a place leaves its column out, and a word is NaN.
struct StoreSink
{
  const std::vector<ColumnView>& targets;
  vtkIdType row = 0;

  void number(std::size_t column, double value, NumberShape)
  {
    const ColumnView& target = targets[column];
    if (!target.first)
    {
      return; // left out
    }
    char* to = target.first + row * target.stride;
    switch (target.type)
    {
      case VTK_FLOAT:
        return put(to, static_cast<float>(value));
      case VTK_DOUBLE:
        return put(to, value);
      case VTK_TYPE_UINT8:
        return put(to, static_cast<unsigned char>(value));
      case VTK_TYPE_UINT16:
        return put(to, static_cast<std::uint16_t>(value));
      default:
        return put(to, static_cast<int>(value));
    }
  }
  void empty(std::size_t column) { number(column, std::numeric_limits<double>::quiet_NaN(), {}); }
  void text(std::size_t column, std::string_view, std::size_t) { this->empty(column); }
  void more() {}
  void missing(std::uint64_t) {}
  void endRow() { ++row; }

  template <typename T>
  static void put(char* to, T value)
  {
    std::memcpy(to, &value, sizeof(T));
  }
};

/// How many columns the shortest line of data has; 0 where no more than one line in a hundred differs from
/// the first, or the last line is cut.
std::size_t columnsOfAll(std::string_view text, const TextLayout& layout)
{
  LineReader lines(text.substr(layout.bodyOffset), layout.bodyLine);
  std::string_view line;
  std::size_t rows = 0;
  std::size_t different = 0;
  std::size_t fewest = layout.columns;
  std::size_t last = layout.columns;
  while (lines.next(line))
  {
    line = trimmed(line, layout.separator);
    if (!line.empty() && !isComment(line))
    {
      last = cellsOf(line, layout.separator, lines.lineNumber()).size();
      fewest = std::min(fewest, last);
      different += last != layout.columns ? 1 : 0;
      ++rows;
    }
  }
  const bool isCut = !text.empty() && text.back() != '\n' && last == fewest;
  return 100 * different > rows && !isCut ? fewest : 0;
}

/// Parses every number of @p text and stores none: it finds the size and type of each array.
/// @throws ColumnsDiffer; FileProblem; StoppedOnRequest.
TextTable surveyTable(const ReadTask& task, std::string_view text, const TextLayout& layout)
{
  SurveySink sink;
  sink.table.columns.resize(layout.columns);
  TableWalk<SurveySink>{ task, text, layout, sink }.run(0.0, 0.5);
  return std::move(sink.table);
}

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
  std::vector<ColumnEvidence> evidence;
  if (!layout.names.empty())
  {
    std::vector<std::string> names = layout.names;
    for (std::size_t i = 0; i < table.columns.size() && task.columns.empty(); ++i)
    {
      evidence.push_back(table.columns[i].numbers);
    }
    const std::string note = task.columns.empty() ? takeSurveyAxes(evidence, names) : "";
    note.empty() ? void() : task.notes.push_back(note);
    return names;
  }
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
void takeUnits(const std::vector<std::string>& names, FileComments& comments, std::vector<std::string>& notes)
{
  std::string unit;
  const auto coordinates = names.empty() ? std::vector<std::size_t>() : coordinatesOf(columnsCalled(names));
  for (const std::size_t i : coordinates)
  {
    const std::string own = coordinateUnit(names[i]);
    const std::string known = lengthUnitCalled(own);
    if (!own.empty() && known.empty())
    {
      notes.push_back("unit " + inQuotes(own) + " is not known; --unit says which one it is");
      return;
    }
    if (unit == "degree" && i == coordinates[2])
    {
      comments.heightUnit = known.empty() || known == "deg" || known == "m" ? "" : own;
      continue;
    }
    if (own.empty())
    {
      return;
    }
    failFormatIf(!unit.empty() && own != unit && known != lengthUnitCalled(unit),
      "convert the columns to one unit, or name them by --columns where they are in one",
      "{} is in {}, other coordinates are in {}", inQuotes(names[i]), own, unit);
    unit = own;
  }
  comments.unit = unit.empty() ? comments.unit : unit;
}

/// The first pass. Lines of many lengths, such as those that end with a list, are read as far as all go. Of
/// salvaged files a last line that is shorter is taken off.
TextTable surveyLines(const ReadTask& task, std::string_view& text, TextLayout& layout, std::string& cut)
{
  try
  {
    return surveyTable(task, text, layout);
  }
  catch (const ColumnsDiffer& problem)
  {
    constexpr std::size_t kFewest = 4;
    const std::size_t columns = layout.names.empty() ? columnsOfAll(text, layout) : 0;
    if (columns >= kFewest)
    {
      layout.columns = columns;
      layout.hasMore = true;
    }
    else if (task.salvage && problem.torn != std::string_view::npos)
    {
      text = text.substr(0, problem.torn);
      cut = "the file ends within a line";
    }
    else
    {
      throw;
    }
    return surveyTable(task, text, layout);
  }
}

void noteColumns(std::string_view text, const TextTable& table, const TextLayout& layout,
  const std::vector<std::string>& names, std::vector<std::string>& notes)
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
  text = text.substr(layout.bodyOffset, text.substr(layout.bodyOffset).find('\n'));
  const std::string_view word = trimmed(text.substr(std::min(text.find(" #"), text.size())));
  if (layout.separator == ' ' && word.size() == 7 && word.find_first_not_of("#0123456789abcdefABCDEF") > 7)
  {
    notes.push_back("colours such as " + inQuotes(word) + " are comments here and left out; write numbers");
  }
}

/// Refuses texts of something else, and those without a line of data.
void failOtherText(std::string_view text, const TextLayout& layout)
{
  constexpr std::size_t kStart = 1000;
  for (const char* columns : { "CAMERA_ID, MODEL, ", "IMAGE_ID, QW, " })
  {
    failFormatIf(text.substr(0, kStart).find(columns) != std::string_view::npos,
      "open points3D.txt, which COLMAP writes beside it", "it lists cameras or images, not points");
  }
  std::vector<std::size_t> found;
  const bool hasOtherLines = layout.bodyOffset > 0 && !findCoordinates(columnsCalled(layout.names), found);
  failFormatIf(layout.columns == 0 && hasOtherLines,
    "write one point per line: x y z, separated by blanks, tabs, commas, semicolons or |",
    "no line holds the numbers of a point");
  layout.columns == 0 ? failNoPoints() : void();
}

} // namespace

void readTable(ReadTask& task, std::string_view text, TextLayout layout, vtkPolyData* cloud, std::string cut)
{
  const TextTable table = surveyLines(task, text, layout, cut);
  table.rows == 0 ? failNoPoints() : void();
  if (table.missing > 0)
  {
    task.endAt(static_cast<std::uint64_t>(table.rows), static_cast<std::uint64_t>(table.rows) + table.missing,
      "the file ends " + std::to_string(table.missing) +
        " points before the count in its first line is reached");
  }
  else if (!cut.empty())
  {
    task.endAt(static_cast<std::uint64_t>(table.rows), 0, cut);
  }
  const std::vector<std::size_t> read = columnsOfNumbers(table, layout);
  checkCoordinates(table, layout, read);
  const std::vector<std::string> names = namesOf(table, layout, read, task);
  noteColumns(text, table, layout, names, task.notes);
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
  StoreSink sink{ targets };
  TableWalk<StoreSink>{ task, text, layout, sink }.run(0.5, 1.0);
  columns.moveTo(cloud, task);
}

void readText(ReadTask& task, vtkPolyData* cloud)
{
  task.format = "text";
  std::string_view text = withoutByteOrderMark(task.bytes);
  text = text.substr(0, text.find_last_not_of('\x1a') + 1); // the mark by which DOS ends texts
  const std::string joined = withoutLineEndsInCells(text);
  text = joined.empty() ? text : joined;
  const std::string cut = takeOffTorn(task, text);
  const TextLayout layout = inspectText(text, task.columns);
  const bool isBlank = layout.columns == 0 && layout.names.empty();
  task.format = layout.hasPointCount ? "PTS"
    : isBlank                        ? "text"
                                     : std::string("text (") + separatorName(layout.separator) + ")";
  failOtherText(text, layout);
  failFormatIf(!task.columns.empty() && task.columns.size() < 3,
    "name x, y and z, and - for each column that is left out",
    "--columns has {} names, and a point needs three", task.columns.size());
  const bool isUnlike = !layout.names.empty() && layout.names.size() != layout.columns;
  failFormatIf(layout.columns < 3 || isUnlike,
    layout.separator == ',' && layout.columns > layout.names.size()
      ? kCureOfCommas
      : "write one point per line: x y z, then one column per name of the header; or name them by "
        "--columns",
    "the first line of data has {}{}{}", layout.columns, (layout.columns == 1 ? " column" : " columns"),
    isUnlike ? fmt::format(", but {} are named", layout.names.size()) : "");
  failTornDecimals(text, layout);
  FileComments comments = layout.comments;
  takeUnits(layout.names, comments, task.notes);
  layout.note.empty() ? void() : task.notes.push_back(layout.note);
  readTable(task, text, layout, cloud, cut);
  comments.moveTo(cloud, task.notes);
}

} // namespace pointhaptics::io
