#include "ReadTask.h"

#include "FileProblem.h"
#include "IO/Bytes/TextScan.h"
#include "IO/Columns/CloudColumns.h"
#include "IO/Formats/FormatLooks.h"
#include "IO/Text/TextTable.h"

namespace pointhaptics::io
{

namespace
{

bool nextSignificant(LineReader& lines, std::string_view& line)
{
  while (lines.next(line))
  {
    line = trimmed(line.substr(0, line.find('#')));
    if (!line.empty() && line.substr(0, 2) != "//")
    {
      return true;
    }
  }
  return false;
}

/// The letters before OFF say what follows x y z.
std::vector<std::string> namesOf(std::string_view prefix, std::size_t columns)
{
  const std::pair<const char*, std::vector<std::string>> kinds[] = { { "N", { "nx", "ny", "nz" } },
    { "C", { "red", "green", "blue" } }, { "ST", { "s", "t" } } };
  std::vector<std::string> names = { "x", "y", "z" };
  for (const auto& [letters, more] : kinds)
  {
    const bool isThere = prefix.find(letters) != std::string_view::npos;
    names.insert(names.end(), more.begin(), isThere ? more.end() : more.begin());
    if (isThere && *letters == 'C' && columns != names.size())
    {
      names.emplace_back("alpha");
    }
  }
  return names;
}

/// OFF with its letters. The first count may stick to it: "OFF8 12 0".
std::string_view takeKeyword(std::string_view& line)
{
  const std::string_view whole = line = trimmed(line);
  const std::string_view word = takeWord(line);
  const std::size_t off = word.find("OFF");
  const std::size_t glued = off < word.size() ? word.find_first_of("0123456789", off) : off;
  line = glued < word.size() ? whole.substr(glued) : line;
  return word.substr(0, glued);
}

/// Lines of a number of corners and the corners, after the vertices.
void readFaces(MeshFaces& faces, LineReader& lines)
{
  std::string_view line;
  std::vector<vtkIdType> corners;
  for (std::uint64_t i = 0; i < faces.count && faces.isWanted() && nextSignificant(lines, line); ++i)
  {
    unsigned long long count = 0;
    unsigned long long corner = 0;
    parseCount(takeWord(line), count);
    for (corners.clear(); corners.size() < count && parseCount(takeWord(line), corner);)
    {
      corners.push_back(static_cast<vtkIdType>(corner));
    }
    corners.size() < count ? corners.push_back(-1) : void(); // such a face is wrong
    faces.keep(corners);
  }
}

} // namespace

void readOff(ReadTask& task, vtkPolyData* cloud)
{
  const std::string_view text = withoutByteOrderMark(task.bytes);
  LineReader lines(text);
  std::string_view line;
  nextSignificant(lines, line);
  const std::string_view keyword = takeKeyword(line);
  failFormatIf(keyword.size() < 3 || keyword.substr(keyword.size() - 3) != "OFF",
    "make the first line OFF, NOFF, COFF or CNOFF", "line {}: {} where OFF was expected", lines.lineNumber(),
    inQuotes(keyword));
  const std::string_view prefix = keyword.substr(0, keyword.size() - 3);
  task.format = inQuotes(keyword).substr(1, keyword.size());
  if (prefix.find_first_of("4n") != std::string_view::npos || equalNoCase(trimmed(line), "BINARY"))
  {
    throw FileProblem(vtkErrorCode::UnrecognizedFileTypeError,
      "binary and four-dimensional OFF is not read here", "convert it to PLY, for example with MeshLab");
  }
  failTruncatedIf(trimmed(line).empty() && !nextSignificant(lines, line), "the file ends before its counts");
  const std::string_view word = takeWord(line);
  unsigned long long count = 0;
  failFormatIf(!parseCount(word, count), "write three counts after OFF: vertices, faces, edges",
    "line {}: {} stands where the number of vertices was expected", lines.lineNumber(), inQuotes(word));
  count == 0 ? failNoPoints() : void();
  unsigned long long faces = 0;
  task.faces.count = parseCount(takeWord(line), faces) ? faces : 0;
  TextLayout layout;
  layout.bodyOffset = lines.position();
  layout.bodyLine = lines.lineNumber() + 1;
  for (unsigned long long i = 0; i < count; ++i)
  {
    const bool isThere = nextSignificant(lines, line);
    failTruncatedIf(
      !isThere, "the file ends at line {} after {} of {} vertices", lines.lineNumber(), i, count);
    while (i == 0 && !takeWord(line).empty() && layout.columns <= kMostColumns)
    {
      ++layout.columns;
    }
  }
  layout.names = namesOf(prefix, layout.columns);
  failFormatIf(layout.names.size() != layout.columns,
    "write x y z, then normals (N) and colours (C) as the letters before OFF say",
    "the first vertex has {} numbers where {} has {}", layout.columns, std::string(keyword),
    layout.names.size());
  readTable(task, text.substr(0, lines.position()), layout, cloud);
  readFaces(task.faces, lines);
}

} // namespace pointhaptics::io
