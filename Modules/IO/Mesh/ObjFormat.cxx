#include "ReadTask.h"

#include "IO/Columns/CloudColumns.h"
#include "IO/Formats/FormatLooks.h"
#include "IO/Text/TextTable.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace pointhaptics::io
{

namespace
{

/// Three columns of numbers, row by row.
struct Triples
{
  std::array<NumberColumn, 3> columns;
  std::vector<double> numbers;

  vtkIdType rows() const { return static_cast<vtkIdType>(numbers.size() / 3); }
};

/// Reads the lines of one file.
class ObjReader
{
public:
  explicit ObjReader(ReadTask& task)
    : task_(task)
    , lines_(withoutByteOrderMark(task.bytes))
  {
    places_.numbers.reserve(task.bytes.size() / 10); // a number has as many; unused memory costs nothing
  }
  void read();
  void moveTo(vtkPolyData* cloud);

private:
  void addLine(std::string_view line);
  void addNumbers(std::string_view line, Triples& triples, std::size_t most);
  void addFace(std::string_view line);

  ReadTask& task_;
  LineReader lines_;
  Triples places_;
  Triples colors_;
  Triples normals_;
  std::vector<vtkIdType> corners_;
};

/// Adds up to @p most numbers: x y z, x y z w, x y z r g b, x y z w r g b.
void ObjReader::addNumbers(std::string_view line, Triples& triples, std::size_t most)
{
  const bool isNormal = most == 3;
  std::array<double, 8> values{};
  std::array<NumberShape, 8> shapes;
  std::size_t count = 0;
  while (count <= most && takeNumber(line, values[count], &shapes[count]))
  {
    ++count;
  }
  const std::string_view word = takeWord(line);
  const bool isNumber = count > most || word.empty() || word.front() == '#';
  if (!isNumber || count < 3 || count == 5 || count > most)
  {
    const char* kind = isNormal ? "normal" : "vertex";
    failFormat(atLine(lines_.lineNumber()) +
        (isNumber ? fmt::format("a {} of {} numbers", kind, count) : inQuotes(word) + " is not a number"),
      isNormal ? "a normal is: vn x y z" : "a vertex is: v x y z, with r g b after it if it is coloured");
  }
  for (std::size_t i = 0; i < 3; ++i)
  {
    triples.columns[i].add(values[i], shapes[i]);
    triples.numbers.push_back(values[i]);
  }
  for (std::size_t i = count - 3; count >= 6 && i < count; ++i)
  {
    colors_.columns[0].add(values[i], shapes[i]);
    colors_.numbers.push_back(values[i]);
  }
}

/// Corners are v, v/vt, v//vn or v/vt/vn, from 1, or below 0 from the last vertex so far.
void ObjReader::addFace(std::string_view line)
{
  ++task_.faces.count;
  corners_.clear();
  for (std::string_view word = takeWord(line); task_.faces.isWanted() && !word.empty() && word.front() != '#';
       word = takeWord(line))
  {
    long long vertex = 0;
    std::from_chars(word.data(), word.data() + word.size(), vertex);
    corners_.push_back(static_cast<vtkIdType>(vertex < 0 ? places_.rows() + vertex : vertex - 1));
  }
  task_.faces.keep(corners_);
}

void ObjReader::addLine(std::string_view line)
{
  const std::string_view keyword = takeWord(line);
  if (keyword == "f")
  {
    addFace(line);
  }
  else if (keyword == "v" || keyword == "vn")
  {
    addNumbers(line, keyword == "v" ? places_ : normals_, keyword == "v" ? 7 : 3);
  }
}

void ObjReader::read()
{
  std::string_view line;
  std::string joined;
  while (lines_.next(line))
  {
    // Names and comments may end with a backslash, as folders do; numbers go on behind it.
    const bool hasNumbers = !line.empty() && std::string_view("vflp").find(line.front()) < 4;
    for (joined.clear(); hasNumbers && !line.empty() && line.back() == '\\'; line = joined)
    {
      joined.assign(line).back() = ' ';
      std::string_view next;
      lines_.next(next);
      joined += next;
    }
    addLine(line);
    task_.step(lines_.lineNumber(), lines_.position(), task_.bytes.size());
  }
}

/// Colours and normals count where each vertex has one.
void ObjReader::moveTo(vtkPolyData* cloud)
{
  const vtkIdType rows = places_.rows();
  rows == 0 ? failNoPoints() : void();
  const bool hasNormals = normals_.rows() == rows;
  std::vector<Column> names;
  for (const Triples* each : { &places_, hasNormals ? &normals_ : nullptr })
  {
    for (std::size_t axis = 0; each && axis < 3; ++axis)
    {
      names.push_back(
        { (each == &normals_ ? "n" : "") + std::string(1, "xyz"[axis]), each->columns[axis].floatingType() });
    }
  }
  const std::size_t colors = names.size();
  if (colors_.rows() == rows)
  {
    names.push_back({ "RGB", VTK_TYPE_UINT8, 3 });
    const double scale = colors_.columns[0].most > 1.0 ? 1.0 : 255.0;
    std::transform(colors_.numbers.begin(), colors_.numbers.end(), colors_.numbers.begin(),
      [scale](double value)
      { return std::isfinite(value) ? std::clamp(std::round(scale * value), 0.0, 255.0) : 0.0; });
  }
  CloudColumns columns(names, rows);
  for (std::size_t first = 0; first < names.size(); first += 3)
  {
    const Triples& from = first == 0 ? places_ : first < colors ? normals_ : colors_;
    for (std::size_t i = 0; i < 3; ++i)
    {
      const ColumnView to = first == colors ? columns.target(first, int(i)) : columns.target(first + i);
      copyStrided({ reinterpret_cast<const char*>(from.numbers.data() + i), 24, VTK_DOUBLE }, to, rows);
    }
  }
  columns.moveTo(cloud, task_);
}

} // namespace

void readObj(ReadTask& task, vtkPolyData* cloud)
{
  task.format = "OBJ";
  ObjReader reader(task);
  reader.read();
  reader.moveTo(cloud);
}

} // namespace pointhaptics::io
