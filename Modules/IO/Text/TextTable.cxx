#include "IO/Text/TextTable.h"

#include "FileProblem.h"
#include "IO/Columns/CloudColumns.h"
#include "IO/Info/LengthUnit.h"
#include "IO/Text/TextCells.h"

#include <algorithm>

namespace pointhaptics::io
{

namespace
{

/// Bytes of a comment that may be a header: enough for kMostColumns one-letter names, and never more.
constexpr std::size_t kLongestHeader = 2 * kMostColumns;
/// Lines before the data that may be one.
constexpr std::size_t kMostTitles = 64;

std::string_view withoutCommentMark(std::string_view line)
{
  while (!line.empty() && std::string_view("#/%!;>").find(line.front()) != std::string_view::npos)
  {
    line.remove_prefix(1);
  }
  return trimmed(line);
}

struct LineCells
{
  std::vector<std::string_view> cells;
  std::size_t numbers = 0;

  LineCells(std::string_view line, char separator, std::size_t number)
    : cells(cellsOf(line, separator, number))
  {
    double value = 0.0;
    numbers = static_cast<std::size_t>(std::count_if(
      cells.begin(), cells.end(), [&](std::string_view cell) { return parseCell(cell, value); }));
  }
  /// Names, not a line of data with a fault in it: columns may be called 1 and nan, too.
  bool areNames() const
  {
    return !cells.empty() &&
      (numbers == 0 || (numbers < cells.size() && namesCoordinates(columnNames(cells))));
  }
  bool isData() const { return numbers >= 3 || (numbers > 0 && numbers == cells.size()); }
  static bool namesCoordinates(const std::vector<std::string>& names)
  {
    std::vector<std::size_t> found;
    return findCoordinates(columnsCalled(names), found);
  }
};

/// A line that may name the columns.
struct Title
{
  std::string_view line;
  std::size_t number = 0;
  bool isComment = false;
};

/// The last ones before the data count.
void addTitle(const Title& title, std::vector<Title>& titles)
{
  if (titles.size() == kMostTitles)
  {
    titles.erase(titles.begin());
  }
  titles.push_back(title);
}

void addComment(std::string_view comment, std::size_t number, TextLayout& layout, std::vector<Title>& titles)
{
  if (!layout.comments.add(comment) && !comment.empty())
  {
    addTitle({ comment, number, true }, titles);
  }
}

/// Takes @p names, behind which each line @p hasMore, where these fit the lines of data.
bool takeNames(std::vector<std::string> names, bool hasMore, TextLayout& layout)
{
  const bool fits = (hasMore ? names.size() <= layout.columns : names.size() == layout.columns) &&
    LineCells::namesCoordinates(names);
  if (fits)
  {
    layout.columns = names.size();
    layout.hasMore = hasMore;
    layout.names = std::move(names);
  }
  return fits;
}

/// Takes names from a comment such as "POINT3D_ID, X, Y, Z, TRACK[] as ...", whose list may have any length.
/// Prose is no header, however long it is.
bool nameByComment(const Title& title, TextLayout& layout)
{
  std::string_view text = title.line.substr(0, title.isComment ? kLongestHeader : 0);
  const std::size_t list = std::min(text.find("[]"), text.find("..."));
  for (const std::size_t colon : { std::string_view::npos, text.substr(0, list).rfind(": ") })
  {
    text.remove_prefix(colon == std::string_view::npos ? 0 : colon + 2);
    std::vector<std::string> names = columnNames(cellsOf(text, separatorOf(text), title.number));
    const auto open = std::find_if(names.begin(), names.end(),
      [](const std::string& name)
      { return name.find("[]") != std::string::npos || name.find("...") != std::string::npos; });
    const bool hasList = open != names.end();
    names.erase(open, names.end());
    if (takeNames(names, hasList, layout))
    {
      return true;
    }
  }
  return false;
}

/// The columns that an order such as PNEZD names, as surveyors write it; empty where @p word is none. Small
/// letters count from four on: nez is a nose.
std::vector<std::string> namesOfOrder(std::string_view word)
{
  constexpr std::string_view kLetters = "PNEXYZHDC";
  constexpr const char* kNames[] = { "point", "northing", "easting", "x", "y", "z", "height", "description",
    "code" };
  std::string letters;
  bool isUpper = true;
  for (const char c : word)
  {
    isUpper = isUpper && !(c >= 'a' && c <= 'z');
    letters += c == '-' ? "" : std::string(1, c >= 'a' && c <= 'z' ? char(c - 'a' + 'A') : c);
  }
  const std::size_t first = letters.find_first_not_of("PC");
  const std::string pair = first <= 1 ? letters.substr(first, 2) : "";
  const bool isOrder = (pair == "NE" || pair == "EN" || pair == "XY" || pair == "YX") &&
    letters.find_first_of("ZH", first + 2) == first + 2 &&
    letters.find_first_not_of("PDC", first + 3) == std::string::npos && (isUpper || letters.size() > 3);
  std::vector<std::string> names(isOrder ? letters.size() : 0);
  std::transform(letters.begin(), letters.begin() + std::ptrdiff_t(names.size()), names.begin(),
    [&](char letter) { return kNames[kLetters.find(letter)]; });
  return names;
}

/// Names the columns by an order in the words of @p title. A description is the rest of its line, may have
/// any words or none, and is left out.
bool nameByOrder(const Title& title, TextLayout& layout)
{
  const auto isOfWord = [](char c)
  { return (c >= '0' && c <= '9') || ((c | 0x20) >= 'a' && (c | 0x20) <= 'z') || c == '-' || c == '_'; };
  for (auto at = title.line.begin(); at != title.line.end();)
  {
    at = std::find_if(at, title.line.end(), isOfWord);
    const auto end = std::find_if_not(at, title.line.end(), isOfWord);
    const std::string word(at, end);
    at = end;
    std::vector<std::string> names = namesOfOrder(word);
    const auto description = std::find(names.begin(), names.end(), "description");
    const bool hasMore = description != names.end();
    names.erase(description, names.end());
    if (takeNames(names, hasMore, layout))
    {
      const bool isUsual = coordinatesOf(columnsCalled(names)) == std::vector<std::size_t>{ 0, 1, 2 };
      layout.note = isUsual ? ""
                            : inQuotes(word) + " in line " + std::to_string(title.number) +
          " orders the columns as " + listOf(names) +
          (hasMore ? " and a description, which is left out" : "") + "; --columns NAMES says otherwise";
      return true;
    }
  }
  return false;
}

/// "x [mm]" for x with mm in the line of units.
std::vector<std::string> withUnits(std::vector<std::string> names, const std::vector<std::string>& units)
{
  std::vector<std::size_t> found;
  findCoordinates(columnsCalled(names), found);
  for (const std::size_t i : found)
  {
    const bool isUnit = units != names && i < units.size() && !lengthUnitCalled(units[i]).empty();
    names[i] += isUnit ? " [" + units[i] + "]" : "";
  }
  return names;
}

/// True of Var1, Var2, Var3, as MATLAB writes them, and the like: they name nothing.
bool areNumbered(const std::vector<std::string>& names)
{
  constexpr std::string_view kBases[] = { "var", "v", "column", "col", "field" };
  return std::all_of(names.begin(), names.end(),
    [&](const std::string& name)
    {
      const std::string_view base = std::string_view(name).substr(0, name.find_first_of("0123456789 _"));
      return base.size() < name.size() &&
        name.find_first_not_of("0123456789 _", base.size()) == std::string::npos &&
        std::any_of(std::begin(kBases), std::end(kBases),
          [&](std::string_view known) { return equalNoCase(known, base); });
    });
}

void nameColumns(const std::vector<Title>& titles, const std::vector<std::string>& given, TextLayout& layout)
{
  if (!given.empty())
  {
    layout.names = given;
    layout.hasMore = given.size() < layout.columns;
    layout.columns = layout.hasMore ? given.size() : layout.columns;
    return;
  }
  std::vector<std::string> lastNames;
  std::vector<std::string> lastFit; // may be a line of units under that of the names
  for (auto title = titles.rbegin(); title != titles.rend(); ++title)
  {
    if (title->isComment)
    {
      continue;
    }
    for (const char separator : { separatorOf(title->line), layout.separator })
    {
      const LineCells names(title->line, separator, title->number);
      const bool fits = names.cells.size() == layout.columns ||
        // A cell may be empty at the end of the first line: the header has the number of columns.
        (layout.separator != ' ' && separator == layout.separator && names.cells.size() > layout.columns);
      const std::vector<std::string> own = names.areNames() ? columnNames(names.cells) : lastFit;
      lastFit = fits && lastNames.empty() ? own : lastFit;
      lastNames = lastNames.empty() ? own : lastNames;
      if (fits && names.areNames() && LineCells::namesCoordinates(own))
      {
        layout.names = withUnits(own, lastFit);
        layout.columns = own.size();
        return;
      }
    }
  }
  for (const auto name : { nameByComment, nameByOrder })
  {
    if (std::any_of(titles.rbegin(), titles.rend(), [&](const Title& title) { return name(title, layout); }))
    {
      return;
    }
  }
  if (!lastFit.empty())
  {
    layout.isNumbered = areNumbered(lastFit);
    layout.columns = lastFit.size();
    layout.names = layout.isNumbered ? std::vector<std::string>() : std::move(lastFit);
    return;
  }
  layout.names = lastNames.size() >= 3 ? lastNames : layout.names; // which do not fit
}

} // namespace

TextLayout inspectText(std::string_view text, const std::vector<std::string>& names)
{
  TextLayout layout;
  TextLayout faulty; // as the first line makes it that may be data with a fault, or a title with a number
  std::vector<Title> titles;
  std::string_view line;
  std::string_view header;
  char told = '\0'; // the separator that a line "sep=;" says
  LineReader lines(text);
  std::size_t lineStart = 0;
  for (; lines.next(line); lineStart = lines.position())
  {
    line = trimmed(line);
    const std::string_view plain = withoutQuotes(line);
    if (plain.size() == 5 && equalNoCase(plain.substr(0, 4), "sep="))
    {
      told = plain.back();
      layout.beginAt(lines.position(), lines.lineNumber() + 1);
      continue;
    }
    if (line.empty() || isComment(line))
    {
      addComment(withoutCommentMark(line), lines.lineNumber(), layout, titles);
      continue;
    }
    const char separator = told != '\0' ? told : isByTabs(header, line) ? '\t' : separatorOf(line);
    const LineCells cells(line, separator, lines.lineNumber());
    unsigned long long count = 0;
    if (header.empty() && !layout.hasPointCount && cells.cells.size() == 1 &&
      parseCount(cells.cells[0], count))
    {
      layout.hasPointCount = true;
      layout.beginAt(lineStart, lines.lineNumber());
      continue;
    }
    if (!cells.areNames() && (cells.isData() || faulty.columns == 0))
    {
      if (cells.isData() && faulty.columns == cells.cells.size() && faulty.separator == separator)
      {
        break; // the fault is no title: it has as many columns
      }
      TextLayout& found = cells.isData() ? layout : faulty;
      found = layout;
      found.separator = separator;
      found.columns = cells.cells.size();
      nameColumns(titles, names, found);
      if (cells.isData())
      {
        return found;
      }
    }
    header = line;
    addTitle({ line, lines.lineNumber(), false }, titles);
    layout.beginAt(lines.position(), lines.lineNumber() + 1);
  }
  if (faulty.columns == 0)
  {
    nameColumns(titles, names, layout);
  }
  return faulty.columns > 0 ? faulty : layout;
}

std::string takeOffTorn(const ReadTask& task, std::string_view& text)
{
  std::string cut;
  if (const std::size_t zero = text.find('\0'); zero != std::string_view::npos)
  {
    cut = atByte(task.bytes.find('\0')) + "zero bytes, as a power cut leaves them";
    task.salvage ? void() : failTruncated(cut, kSalvageCure);
    text = text.substr(0, zero);
  }
  if (const std::size_t end = text.rfind('\n') + 1; task.salvage && end > 0 && end < text.size())
  {
    cut = cut.empty() ? "the file ends within a line" : cut;
    text = text.substr(0, end);
  }
  return cut;
}

} // namespace pointhaptics::io
