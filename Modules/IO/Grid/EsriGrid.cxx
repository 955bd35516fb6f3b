#include "FileProblem.h"
#include "IO/Formats/FormatLooks.h"
#include "IO/Text/TextCells.h"
#include "ReadTask.h"

#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtksys/SystemTools.hxx"

#include <cmath>
#include <map>

namespace pointhaptics::io
{

namespace
{

/// The lines "name value" before the heights.
struct EsriHeader
{
  std::map<std::string, double> values;
  std::size_t columns = 0;
  std::size_t rows = 0;

  double value(const char* name, double otherwise) const
  {
    const auto found = values.find(name);
    return found == values.end() ? otherwise : found->second;
  }
  /// Where the first cell's middle lies on an axis.
  double middle(const char* corner, const char* center, double cell) const
  {
    return value(center, value(corner, 0.0) + 0.5 * cell);
  }
};

constexpr const char* kCure =
  "write ncols, nrows, xllcorner, yllcorner, cellsize and NODATA_value, then a height for each cell";

/// Leaves @p line at the first heights.
EsriHeader parseHeader(LineReader& lines, std::string_view& line)
{
  EsriHeader header;
  double value = 0.0;
  while (lines.next(line))
  {
    std::string_view rest = line;
    const std::string_view word = takeWord(rest);
    if (word.empty())
    {
      continue;
    }
    if (parseCell(word, value))
    {
      break;
    }
    failFormatIf(!parseCell(takeWord(rest), value) || header.values.size() > 16, kCure,
      "line {}: {} has no number", lines.lineNumber(), inQuotes(word));
    header.values[vtksys::SystemTools::LowerCase(std::string(word))] = value;
  }
  const auto count = [&](const char* name)
  {
    const double given = header.value(name, 0.0);
    failFormatIf(!(given >= 1.0 && given <= 1e9 && given == std::floor(given)), kCure,
      "line {}: {} is no count", lines.lineNumber(), name);
    return static_cast<std::size_t>(given);
  };
  header.columns = count("ncols");
  header.rows = count("nrows");
  return header;
}

} // namespace

bool looksLikeEsriGrid(const FormatStart& start)
{
  std::string_view line = start.line;
  double value = 0.0;
  return start.isText && equalNoCase(takeWord(line), "ncols") && parseNumber(takeWord(line), value);
}

/// A point in the middle of each cell that has a height, row by row from the north.
void readEsriGrid(ReadTask& task, vtkPolyData* cloud)
{
  task.format = "Esri grid";
  const std::string_view text = withoutByteOrderMark(task.bytes);
  LineReader lines(text);
  std::string_view line;
  const EsriHeader header = parseHeader(lines, line);
  failTruncatedIf(header.rows > text.size() / header.columns, "line {}: {} x {} cells in a file of {} bytes",
    lines.lineNumber(), header.columns, header.rows, text.size());
  const double cell = header.value("cellsize", 0.0);
  const double width = header.value("dx", cell);
  const double height = header.value("dy", cell);
  const double none = header.value("nodata_value", -9999.0);
  failFormatIf(
    !(width > 0.0) || !(height > 0.0), kCure, "line {}: there is no cellsize above 0", lines.lineNumber());
  const double west = header.middle("xllcorner", "xllcenter", width);
  const double south = header.middle("yllcorner", "yllcenter", height);
  const std::size_t cells = header.columns * header.rows;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (std::size_t i = 0; i < cells; ++i)
  {
    double z = 0.0;
    while (!takeNumber(line, z))
    {
      if (!line.empty())
      {
        const std::string_view word = takeWord(line);
        if (!parseCell(word, z))
        {
          failFormat(fmt::format("line {}: {} is no height", lines.lineNumber(), inQuotes(word)), kCure);
        }
        break;
      }
      if (!lines.next(line))
      {
        task.endAt(static_cast<std::uint64_t>(points->GetNumberOfPoints()), cells,
          "the file ends after " + std::to_string(i) + " of " + std::to_string(cells) + " heights");
        i = cells;
        break;
      }
    }
    if (i < cells && z != none && !std::isnan(z))
    {
      const double column = static_cast<double>(i % header.columns);
      const double row = static_cast<double>(header.rows - 1 - i / header.columns);
      points->InsertNextPoint(west + width * column, south + height * row, z);
    }
    task.step(i, i, cells);
  }
  points->GetNumberOfPoints() == 0 ? failNoPoints() : void();
  cloud->SetPoints(points);
}

} // namespace pointhaptics::io
