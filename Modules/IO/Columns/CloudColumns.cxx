#include "CloudColumns.h"

#include "Bytes/NumericType.h"
#include "Bytes/ShownColors.h"
#include "FileProblem.h"
#include "IO/Text/TextScan.h"

#include "vtkCellArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <limits>
#include <numeric>

namespace pointhaptics::io
{

namespace
{

using Names = std::vector<std::vector<std::string>>;

const std::vector<std::string> kXyz = { "x", "y", "z" };
/// What else the three are called.
const Names kCoordinateWords = { { "x", "easting", "east", "e" }, { "y", "northing", "north", "n" },
  { "z", "elevation", "elev", "height", "h", "altitude", "alt", "up" } };
/// Words beside the name of a coordinate: "POINT_X", "x coordinate".
const char* const kFillers[] = { "coord", "coords", "coordinate", "point", "points", "pos", "position" };
const char* const kDegrees[] = { "lat", "lon", "latitude", "longitude", "long", "lng" };
const Names kColorsWithAlpha = { { "red", "green", "blue", "alpha" }, { "r", "g", "b", "a" },
  { "diffuse_red", "diffuse_green", "diffuse_blue", "diffuse_alpha" } };
const Names kColors = { { "red", "green", "blue" }, { "r", "g", "b" },
  { "diffuse_red", "diffuse_green", "diffuse_blue" } };
const Names kNormals = { { "nx", "ny", "nz" }, { "normal_x", "normal_y", "normal_z" } };

bool isByte(int type)
{
  return type == VTK_UNSIGNED_CHAR;
}

bool isWord(int type)
{
  return type == VTK_UNSIGNED_SHORT || isByte(type);
}

bool isAny(int)
{
  return true;
}

/// The type that holds the values of both.
int commonType(int a, int b)
{
  if (a == b)
  {
    return a;
  }
  if ((isByte(a) || isWord(a)) && (isByte(b) || isWord(b)))
  {
    return VTK_UNSIGNED_SHORT;
  }
  return needsDouble(a) || needsDouble(b) ? VTK_DOUBLE : VTK_FLOAT;
}

/// Splits "name_12" (or "name:12") at its number. @return false when there is none.
bool splitNumbered(const std::string& name, std::string& base, unsigned long long& number)
{
  const std::size_t separator = name.find_last_of("_:");
  if (separator == std::string::npos || separator == 0)
  {
    return false;
  }
  base = name.substr(0, separator);
  return parseCount(std::string_view(name).substr(separator + 1), number);
}

/// Which columns have @p names, of those that are not @p placed. @return whether all were found.
bool findNames(const std::vector<Column>& columns, const std::vector<bool>& placed,
  const std::vector<std::string>& names, std::vector<std::size_t>& found)
{
  found.clear();
  for (const std::string& name : names)
  {
    for (std::size_t i = 0; i < columns.size(); ++i)
    {
      if (!placed[i] && columns[i].components == 1 && equalNoCase(columns[i].name, name))
      {
        found.push_back(i);
        break;
      }
    }
  }
  return found.size() == names.size();
}

/// "x" for "POINT_X", "X [m]" and "x-coordinate"; empty for names with other words.
std::string coordinateWord(const std::string& name)
{
  std::string result;
  std::string word;
  const auto endWord = [&]
  {
    if (std::find(std::begin(kFillers), std::end(kFillers), word) == std::end(kFillers))
    {
      result += (result.empty() || word.empty() ? "" : " ") + word;
    }
    word.clear();
  };
  for (const char c : name.substr(0, name.find_first_of("[(")))
  {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80 && !std::isalnum(byte))
    {
      endWord();
      continue;
    }
    word += static_cast<char>(std::tolower(byte));
  }
  endWord();
  return result;
}

[[noreturn]] void failCoordinates(const std::vector<Column>& columns)
{
  constexpr std::size_t kListed = 6;
  std::string names;
  bool hasDegrees = false;
  for (std::size_t i = 0; i < columns.size(); ++i)
  {
    const std::string& name = columns[i].name;
    names += i < kListed ? (i == 0 ? " " : ", ") + inQuotes(name) : std::string(i == kListed ? " ..." : "");
    hasDegrees = hasDegrees ||
      std::any_of(
        std::begin(kDegrees), std::end(kDegrees), [&](const char* each) { return equalNoCase(name, each); });
  }
  failFormat("no columns named x, y and z, but" + names,
    hasDegrees
      ? "degrees are no lengths: project the cloud to metres, such as UTM, and name the columns x, y, z"
      : "name the three coordinates x, y and z in the header");
}

} // namespace

std::vector<std::size_t> coordinatesOf(const std::vector<Column>& columns)
{
  const std::vector<bool> placed(columns.size(), false);
  std::vector<std::size_t> found;
  if (findNames(columns, placed, kXyz, found))
  {
    return found;
  }
  found.clear();
  for (const std::vector<std::string>& words : kCoordinateWords)
  {
    const auto at = std::find_if(columns.begin(), columns.end(),
      [&](const Column& column)
      {
        const bool isOne = column.components == 1;
        return isOne && std::find(words.begin(), words.end(), coordinateWord(column.name)) != words.end();
      });
    if (at == columns.end())
    {
      failCoordinates(columns);
    }
    found.push_back(static_cast<std::size_t>(at - columns.begin()));
  }
  return found;
}

CloudColumns::CloudColumns(const std::vector<Column>& columns, vtkIdType rows)
  : columns_(columns)
  , rows_(rows)
  , placed_(columns.size(), false)
  , places_(columns.size())
{
  planPoints();
  if (!planNamed(kColorsWithAlpha, "RGBA", &isByte) && !planNamed(kColors, "RGB", &isByte) &&
    (planNamed(kColors, "Color16", &isWord) || planNamed(kColors, "Color", &isAny)))
  {
    colors_ = arrays_.back();
  }
  planNamed(kNormals, "Normals", &isFloatingType);
  planNumbered();
}

void CloudColumns::planPoints()
{
  const std::vector<std::size_t> found = coordinatesOf(columns_);
  const bool wide =
    std::any_of(found.begin(), found.end(), [&](std::size_t i) { return needsDouble(columns_[i].type); });
  add("Points", found, wide ? VTK_DOUBLE : VTK_FLOAT);
}

bool CloudColumns::planNamed(const Names& names, const char* arrayName, bool (*accepts)(int))
{
  std::vector<std::size_t> found;
  for (const std::vector<std::string>& candidate : names)
  {
    if (findNames(columns_, placed_, candidate, found) &&
      std::all_of(found.begin(), found.end(), [&](std::size_t i) { return accepts(columns_[i].type); }))
    {
      int type = columns_[found[0]].type;
      for (const std::size_t i : found)
      {
        type = commonType(type, columns_[i].type);
      }
      add(arrayName, found, type);
      return true;
    }
  }
  return false;
}

void CloudColumns::planNumbered()
{
  for (std::size_t first = 0; first < columns_.size(); ++first)
  {
    if (placed_[first])
    {
      continue;
    }
    std::vector<std::size_t> members{ first };
    int type = columns_[first].type;
    std::string name = columns_[first].name;
    std::string base;
    unsigned long long number = 1;
    if (columns_[first].components == 1 && splitNumbered(name, base, number) && number == 0)
    {
      std::string nextBase;
      for (std::size_t i = first + 1; i < columns_.size() && !placed_[i] && columns_[i].components == 1 &&
           splitNumbered(columns_[i].name, nextBase, number) && nextBase == base && number == members.size();
           ++i)
      {
        members.push_back(i);
        type = commonType(type, columns_[i].type);
      }
      name = members.size() > 1 ? base : name;
    }
    add(name, members, type);
  }
}

std::string CloudColumns::unusedName(const std::string& name) const
{
  const std::string wanted = name.empty() ? "unnamed" : name;
  std::string candidate = wanted;
  const auto isUsed = [&](const vtkSmartPointer<vtkDataArray>& array)
  { return candidate == array->GetName(); };
  for (int number = 2; std::any_of(arrays_.begin(), arrays_.end(), isUsed); ++number)
  {
    candidate = wanted + "_" + std::to_string(number);
  }
  return candidate;
}

void CloudColumns::add(const std::string& name, const std::vector<std::size_t>& columns, int type)
{
  const int components =
    columns.size() == 1 ? columns_[columns[0]].components : static_cast<int>(columns.size());
  vtkSmartPointer<vtkDataArray> array;
  array.TakeReference(vtkDataArray::CreateDataArray(type));
  array->SetName(unusedName(name).c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(rows_);
  for (std::size_t i = 0; i < columns.size(); ++i)
  {
    placed_[columns[i]] = true;
    places_[columns[i]] = { arrays_.size(), static_cast<int>(i) };
  }
  arrays_.push_back(array);
}

ColumnView CloudColumns::target(std::size_t column, int component) const
{
  const Place& place = places_[column];
  vtkDataArray* array = arrays_[place.array];
  const int size = array->GetDataTypeSize();
  char* first = static_cast<char*>(array->GetVoidPointer(0));
  return { first + (place.component + component) * size,
    std::ptrdiff_t{ size } * array->GetNumberOfComponents(), array->GetDataType() };
}

void CloudColumns::moveTo(vtkPolyData* cloud, SharedReading* shared)
{
  vtkNew<vtkPoints> points;
  points->SetData(arrays_[0]);
  cloud->SetPoints(points);
  for (std::size_t i = 1; i < arrays_.size(); ++i)
  {
    cloud->GetPointData()->AddArray(arrays_[i]);
  }
  if (const auto shown = colors_ ? shownColors(colors_, shared) : nullptr)
  {
    shown->SetName(unusedName(shown->GetName()).c_str());
    cloud->GetPointData()->AddArray(shown);
  }
  setActiveAttributes(cloud);
}

namespace
{

/// Cells of one point each, in the smallest integers that number them.
template <typename Array>
void fillVertices(vtkCellArray* vertices, vtkIdType count)
{
  vtkNew<Array> offsets;
  vtkNew<Array> connectivity;
  offsets->SetNumberOfValues(count + 1);
  connectivity->SetNumberOfValues(count);
  std::iota(offsets->GetPointer(0), offsets->GetPointer(0) + count + 1, 0);
  std::iota(connectivity->GetPointer(0), connectivity->GetPointer(0) + count, 0);
  vertices->SetData(offsets, connectivity);
}

} // namespace

void setOneVertexPerPoint(vtkPolyData* cloud)
{
  const vtkIdType count = cloud->GetNumberOfPoints();
  vtkNew<vtkCellArray> vertices;
  count < std::numeric_limits<std::int32_t>::max() ? fillVertices<vtkTypeInt32Array>(vertices, count)
                                                   : fillVertices<vtkTypeInt64Array>(vertices, count);
  cloud->SetVerts(vertices);
}

void setActiveAttributes(vtkPolyData* cloud)
{
  vtkPointData* data = cloud->GetPointData();
  for (const char* name : { "RGB", "RGBA" })
  {
    vtkDataArray* colors = data->GetArray(name);
    if (colors && isByte(colors->GetDataType()))
    {
      data->SetActiveScalars(name);
    }
  }
  vtkDataArray* normals = data->GetArray("Normals");
  if (normals && normals->GetNumberOfComponents() == 3 && isFloatingType(normals->GetDataType()))
  {
    data->SetActiveNormals("Normals");
  }
}

} // namespace pointhaptics::io
