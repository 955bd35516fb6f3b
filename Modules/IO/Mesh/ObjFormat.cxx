#include "ReadTask.h"

#include "IO/Columns/CloudColumns.h"
#include "IO/Formats/FormatLooks.h"
#include "IO/Text/NumberColumn.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace pointhaptics::io
{

namespace
{

constexpr std::size_t kMostNumbers = 7;

/// The numbers of one line, at most kMostNumbers of them.
struct Numbers
{
  std::array<NumberShape, kMostNumbers> shapes;
  std::array<double, kMostNumbers> values{};
  std::size_t count = 0;
};

Numbers parseNumbers(std::string_view line, std::size_t lineNumber)
{
  Numbers numbers;
  double value = 0.0;
  NumberShape shape;
  while (takeNumber(line, value, &shape))
  {
    if (numbers.count == kMostNumbers)
    {
      failFormat(
        "line " + std::to_string(lineNumber) + ": more than " + std::to_string(kMostNumbers) + " numbers",
        "a vertex is: v x y z, with r g b after it if it is coloured");
    }
    numbers.values[numbers.count] = value;
    numbers.shapes[numbers.count++] = shape;
  }
  const std::string_view word = takeWord(line);
  if (!word.empty() && word.front() != '#')
  {
    failFormat("line " + std::to_string(lineNumber) + ": " + inQuotes(word) + " is not a number",
      "a vertex is: v x y z, with r g b after it if it is coloured");
  }
  return numbers;
}

/// Shows each vertex, normal and face to a sink: vertex(numbers), normal(numbers), face(rest of its line).
template <typename Sink>
void walkObj(const ReadTask& task, std::string_view text, Sink& sink, double from, double to)
{
  LineReader lines(text);
  std::string_view line;
  std::string joined;
  while (lines.next(line))
  {
    const std::size_t number = lines.lineNumber();
    // Names and comments may end with a backslash, as folders do; numbers go on behind it.
    const bool hasNumbers = !line.empty() && std::string_view("vflp").find(line.front()) < 4;
    for (joined.clear(); hasNumbers && !line.empty() && line.back() == '\\'; line = joined)
    {
      joined.assign(line).back() = ' ';
      std::string_view next;
      lines.next(next);
      joined += next;
    }
    const std::string_view keyword = takeWord(line);
    if (keyword == "v")
    {
      const Numbers numbers = parseNumbers(line, number);
      // x y z, x y z w, x y z r g b, x y z w r g b
      if (numbers.count < 3 || numbers.count == 5)
      {
        failFormat(
          "line " + std::to_string(number) + ": a vertex of " + std::to_string(numbers.count) + " numbers",
          "a vertex is: v x y z, with r g b after it if it is coloured");
      }
      sink.vertex(numbers);
    }
    else if (keyword == "vn")
    {
      const Numbers numbers = parseNumbers(line, number);
      if (numbers.count != 3)
      {
        failFormat(
          "line " + std::to_string(number) + ": a normal of " + std::to_string(numbers.count) + " numbers",
          "a normal is: vn x y z");
      }
      sink.normal(numbers);
    }
    else if (keyword == "f")
    {
      sink.face(line);
    }
    if (number % static_cast<std::size_t>(kProgressRows) == 0)
    {
      task.progress(
        from + (to - from) * static_cast<double>(lines.position()) / static_cast<double>(text.size()));
    }
  }
}

/// Findings of a first pass.
struct ObjSurvey
{
  std::array<NumberColumn, 3> position;
  vtkIdType vertices = 0;
  vtkIdType colored = 0;
  vtkIdType normals = 0;
  std::uint64_t faces = 0;
  double brightest = 0.0;

  bool isColored() const { return colored == vertices; }
  bool hasNormalPerVertex() const { return normals == vertices; }
  void vertex(const Numbers& numbers)
  {
    ++vertices;
    colored += numbers.count >= 6 ? 1 : 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      position[axis].add(numbers.values[axis], numbers.shapes[axis]);
      brightest =
        numbers.count >= 6 ? std::max(brightest, numbers.values[numbers.count - 3 + axis]) : brightest;
    }
  }
  void normal(const Numbers& numbers)
  {
    ++normals;
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      direction[axis].add(numbers.values[axis], numbers.shapes[axis]);
    }
  }
  void face(std::string_view) { ++faces; }
  std::array<NumberColumn, 3> direction;
};

/// The second pass: what the survey did not find has no target.
struct ObjStore
{
  std::array<ColumnView, 3> position;
  std::array<ColumnView, 3> color;
  std::array<ColumnView, 3> direction;
  double colorScale = 255.0; ///< Files hold 0..1; some programs write 0..255.
  vtkIdType vertices = 0;
  vtkIdType normals = 0;

  void vertex(const Numbers& numbers)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      storeNumber(position[axis], vertices, numbers.values[axis]);
      if (color[axis].first)
      {
        const double value = colorScale * numbers.values[numbers.count - 3 + axis];
        storeNumber(
          color[axis], vertices, std::isfinite(value) ? std::clamp(std::round(value), 0.0, 255.0) : 0.0);
      }
    }
    ++vertices;
  }
  void normal(const Numbers& numbers)
  {
    for (std::size_t axis = 0; axis < 3 && direction[axis].first; ++axis)
    {
      storeNumber(direction[axis], normals, numbers.values[axis]);
    }
    ++normals;
  }
  /// Corners are v, v/vt, v//vn or v/vt/vn, from 1, or below 0 from the last vertex so far.
  void face(std::string_view line)
  {
    corners.clear();
    for (std::string_view word = takeWord(line); faces->isWanted() && !word.empty() && word.front() != '#';
         word = takeWord(line))
    {
      long long vertex = 0;
      std::from_chars(word.data(), word.data() + word.size(), vertex);
      corners.push_back(static_cast<vtkIdType>(vertex < 0 ? vertices + vertex : vertex - 1));
    }
    faces->keep(corners);
  }

  MeshFaces* faces = nullptr;
  std::vector<vtkIdType> corners;
};

} // namespace

void readObj(ReadTask& task, vtkPolyData* cloud)
{
  task.format = "OBJ";
  const std::string_view text = withoutByteOrderMark(task.bytes);
  ObjSurvey survey;
  walkObj(task, text, survey, 0.0, 0.5);
  if (survey.vertices == 0)
  {
    failNoPoints();
  }
  std::vector<Column> names;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    names.push_back({ std::string(1, "xyz"[axis]), survey.position[axis].floatingType() });
  }
  for (std::size_t axis = 0; axis < 3 && survey.hasNormalPerVertex(); ++axis)
  {
    names.push_back({ std::string("n") + "xyz"[axis], survey.direction[axis].floatingType() });
  }
  const std::size_t colors = names.size();
  if (survey.isColored())
  {
    names.push_back({ "RGB", VTK_TYPE_UINT8, 3 });
  }
  CloudColumns columns(names, survey.vertices);
  ObjStore store;
  store.faces = &task.faces;
  task.faces.count = survey.faces;
  store.colorScale = survey.brightest > 1.0 ? 1.0 : 255.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    store.position[axis] = columns.target(axis);
    store.direction[axis] = survey.hasNormalPerVertex() ? columns.target(3 + axis) : ColumnView{};
    store.color[axis] = survey.isColored() ? columns.target(colors, static_cast<int>(axis)) : ColumnView{};
  }
  walkObj(task, text, store, 0.5, 1.0);
  columns.moveTo(cloud);
}

} // namespace pointhaptics::io
