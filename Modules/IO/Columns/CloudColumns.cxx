#include "CloudColumns.h"

#include "Bytes/NumericType.h"
#include "Core/Base/FieldNames.h"
#include "FileProblem.h"
#include "IO/Bytes/TextScan.h"
#include "IO/Formats/FormatLooks.h"
#include "IO/Info/LengthUnit.h"
#include "ReadTask.h"

#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTypeInt32Array.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>
#include <numeric>
#include <type_traits>

namespace pointhaptics::io
{

namespace
{

template <typename T>
void fillBytes(const T* values, vtkIdType count, double most, unsigned char* bytes)
{
  if constexpr (std::is_integral_v<T>)
  {
    // 65535 is 255: the byte is the value's first.
    const int shift = most > 255.0 ? 8 : 0;
    std::transform(
      values, values + count, bytes, [=](T v) { return static_cast<unsigned char>(v >> shift); });
  }
  else
  {
    std::transform(values, values + count, bytes,
      [=](T v)
      {
        const double value = 255.0 / most * static_cast<double>(v) + 0.5;
        return static_cast<unsigned char>(value >= 0.0 ? std::min(value, 255.0) : 0.0);
      });
  }
}

/// bytesOfColors() of @p colors: integers up to 255 are bytes, of those up to 65535 the high
/// byte is taken; other numbers are 0..1, or 0..255 or 0..65535 where one is larger. The largest value is
/// that of all ranks that read the file of @p task (collective). Null where a value is below 0 or larger:
/// these are no colours.
vtkSmartPointer<vtkDataArray> shownColors(vtkDataArray* colors, const ReadTask& task)
{
  double least = 0.0;
  double most = 0.0;
  for (int channel = 0; channel < colors->GetNumberOfComponents(); ++channel)
  {
    std::array<double, 2> own{};
    colors->GetRange(own.data(), channel);
    for (const auto& range : task.ofRanks(own))
    {
      least = range[0] <= range[1] ? std::min(least, range[0]) : least;
      most = std::max(most, range[1]);
    }
  }
  if (least < 0.0 || most > 65535.0)
  {
    return nullptr;
  }
  const bool areBytes = most > 1.0 || !isFloatingType(colors->GetDataType());
  return bytesOfColors(colors, most > 255.0 ? 65535.0 : areBytes ? 255.0 : 1.0);
}

using Names = std::vector<std::vector<std::string>>;

const std::vector<std::string> kXyz = { "x", "y", "z" };
/// Other names of the three coordinates.
const Names kCoordinateWords = { { "x", "easting", "eastings", "east", "e", "rechtswert", "rechts", "rw",
                                   "ost", "ostwert", "est", "este", "longitude", "lon", "long", "lng" },
  { "y", "northing", "northings", "north", "n", "hochwert", "hoch", "hw", "nord", "nordwert", "norte",
    "latitude", "lat" },
  { "z", "elevation", "elev", "height", "h", "altitude", "alt", "up", "hoehe", "h\xc3\xb6he", "cota", "quota",
    "level", "rl", "nhn" },
  // Heights that stand behind others.
  { "h ell", "alt msl", "h msl", "ellipsoidal height", "ellipsoidalheight", "ellipsoid height", "height msl",
    "orthometric height", "orthometricheight", "hae", "msl", "amsl" } };
/// Words beside the name of a coordinate: "POINT_X", "x coordinate".
const std::vector<std::string> kFillers = { "coord", "coords", "coordinate", "coordinates", "point", "points",
  "pos", "position", "positions", "xyz", "field", "world", "global", "local", "utm", "map", "grid", "mga",
  "ahd", "vertex", "cartesian", "value" };
/// Coordinates that count down.
const std::vector<std::string> kDepths = { "depth", "depths", "tiefe" };
const std::vector<std::string> kDegrees = { "longitude", "lon", "long", "lng", "latitude", "lat" };
const Names kColorsWithAlpha = { { "red", "green", "blue", "alpha" }, { "r", "g", "b", "a" },
  { "diffuse_red", "diffuse_green", "diffuse_blue", "diffuse_alpha" } };
const Names kColors = { { "red", "green", "blue" }, { "r", "g", "b" }, { "rf", "gf", "bf" },
  { "diffuse_red", "diffuse_green", "diffuse_blue" }, { "color_r", "color_g", "color_b" },
  { "colour_r", "colour_g", "colour_b" }, { "rgb_r", "rgb_g", "rgb_b" } };
const Names kNormals = { { "nx", "ny", "nz" }, { "normal_x", "normal_y", "normal_z" } };

bool isByte(int type)
{
  return type == VTK_UNSIGNED_CHAR;
}

bool isWord(int type)
{
  return type == VTK_UNSIGNED_SHORT || isByte(type);
}

/// The type that holds the values of both.
int commonType(int a, int b)
{
  return a == b                        ? a
    : isWord(a) && isWord(b)           ? VTK_UNSIGNED_SHORT
    : needsDouble(a) || needsDouble(b) ? VTK_DOUBLE
                                       : VTK_FLOAT;
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
    std::size_t i = 0;
    while (
      i < columns.size() && (placed[i] || columns[i].components != 1 || !isSameField(columns[i].name, name)))
    {
      ++i;
    }
    i < columns.size() ? found.push_back(i) : void();
  }
  return found.size() == names.size();
}

bool has(const std::vector<std::string>& words, const std::string& word)
{
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// Lower case, also of the letters of Latin-1; what is neither letter nor digit ends a word.
std::vector<std::string> wordsOf(const std::string& name)
{
  std::vector<std::string> words(1);
  for (const char c : utf8Name(name))
  {
    const auto byte = static_cast<unsigned char>(c);
    const bool isLatin =
      byte >= 0x80 && byte < 0x9f && !words.back().empty() && words.back().back() == '\xc3';
    if (byte >= 0x80 || std::isalnum(byte))
    {
      words.back() += static_cast<char>(isLatin ? byte | 0x20 : std::tolower(byte));
    }
    else if (!words.back().empty())
    {
      words.emplace_back();
    }
  }
  return words;
}

/// True if @p word, of more than a letter, names a coordinate.
bool isCoordinateWord(const std::string& word)
{
  return word.size() > 1 &&
    std::any_of(kCoordinateWords.begin(), kCoordinateWords.end(),
      [&](const std::vector<std::string>& words) { return has(words, word); });
}

/// Axis and unit that a column's name gives: 0 and "mm" for "X1 (mm)"; axis -1 where it names none. The word
/// in "Y (Rechtswert)" and "Y/Rechts" says more than its letter.
struct CoordinateName
{
  int axis = -1;
  std::string unit;
  std::string rest; ///< Rest of the name without fillers and unit.
  bool isPosition = false;

  bool isDepth() const { return has(kDepths, rest); }
  bool isLast() const { return isDepth() || has(kCoordinateWords[3], rest); }
  explicit CoordinateName(const std::string& name)
  {
    const std::size_t bracket = std::min(name.find_first_of("[("), name.size());
    const std::size_t end = name.find_first_of("])", bracket);
    std::string called = name.substr(0, bracket);
    if (end != std::string::npos)
    {
      const std::string inside = utf8Name(std::string(trimmed(name.substr(bracket + 1, end - bracket - 1))));
      const bool isWord = inside.size() > 2 && isCoordinateWord(wordsOf(inside)[0]);
      const bool mayBeUnit = name[bracket] == '[' && inside.size() > 1 && !isWord &&
        wordsOf(inside).size() == 1 && inside.find_first_of("0123456789") == std::string::npos;
      unit = mayBeUnit || !lengthUnitCalled(inside).empty() ? inside : "";
      called = isWord ? inside : called;
    }
    for (const std::string& word : wordsOf(called))
    {
      const bool isUnit = (!rest.empty() || isPosition) && findLengthUnit(word);
      isPosition = isPosition || has(kFillers, word);
      unit = isUnit ? word : unit;
      const auto isUp = [](const std::string& one) { return one == "z" || has(kCoordinateWords[2], one); };
      const bool isOne = isUp(word) == isUp(rest); // "X level" is no coordinate
      const bool isMore = isCoordinateWord(word) && has(kXyz, rest) && isOne;
      const bool isLess = isCoordinateWord(rest) && has(kXyz, word) && isOne;
      rest = isMore                               ? word
        : isUnit || isLess || has(kFillers, word) ? rest
                                                  : rest + (rest.empty() || word.empty() ? "" : " ") + word;
    }
    if (!rest.empty() && has(kXyz, rest.substr(0, 1)) && findLengthUnit(rest.substr(1))) // "Xmm"
    {
      unit = rest.substr(1);
      rest.resize(1);
    }
    for (int i = 0; i < 3 && axis < 0; ++i)
    {
      axis = names(i) ? i : -1;
    }
    unit = has(kDegrees, rest) ? "degree" : unit;
  }
  bool names(int i) const
  {
    const std::string letter(1, "xyz"[i]);
    const bool isNumbered = rest.size() > 1 && rest.size() < 4 && rest.substr(0, 1) == letter &&
      rest.find_first_not_of("0123456789", 1) == std::string::npos;
    return has(kCoordinateWords[static_cast<std::size_t>(i)], rest) || isNumbered || (i == 2 && isLast()) ||
      (isPosition && rest == std::to_string(i)) ||
      (rest.substr(0, 1) == letter && has(kFillers, rest.substr(1))) ||
      (rest.size() > 1 && rest.substr(rest.size() - 1) == letter &&
        has(kFillers, rest.substr(0, rest.size() - 1)));
  }
};

bool isOneOf(const Names& lists, const std::string& name)
{
  return std::any_of(lists.begin(), lists.end(),
    [&](const std::vector<std::string>& list)
    {
      return std::any_of(
        list.begin(), list.end(), [&](const std::string& each) { return isSameField(each, name); });
    });
}

[[noreturn]] void failCoordinates(const std::vector<Column>& columns)
{
  constexpr std::size_t kListed = 6;
  std::string names;
  for (std::size_t i = 0; i < std::min(columns.size(), kListed + 1); ++i)
  {
    names += i < kListed ? (i == 0 ? ", but " : ", ") + inQuotes(columns[i].name) : std::string(" ...");
  }
  failFormat("no columns named x, y and z" + names,
    names.find("'packed_position'") != std::string::npos
      ? "this is SuperSplat's compressed PLY: save it uncompressed there, or splat-transform IN.ply OUT.ply"
      : "name the three coordinates x, y and z (or longitude, latitude and height) in the header, or for "
        "columns of text by --columns");
}

/// 0, 1, 2 and so on.
template <typename Array>
vtkSmartPointer<Array> counted(vtkIdType count)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetNumberOfValues(count);
  std::iota(array->GetPointer(0), array->GetPointer(0) + count, typename Array::ValueType{ 0 });
  return array;
}

} // namespace

vtkSmartPointer<vtkDataArray> makeArray(int type, int components, vtkIdType tuples, const std::string& name)
{
  auto array = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
  name.empty() ? void() : array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  return array;
}

std::vector<Column> columnsCalled(const std::vector<std::string>& names)
{
  std::vector<Column> columns;
  for (const std::string& name : names)
  {
    columns.push_back({ name });
  }
  return columns;
}

bool findCoordinates(const std::vector<Column>& columns, std::vector<std::size_t>& found)
{
  if (findNames(columns, std::vector<bool>(columns.size(), false), kXyz, found))
  {
    return true;
  }
  // Degrees stand beside projected coordinates; x of one and y of the other are no place.
  for (const bool inDegrees : { false, true })
  {
    found.assign(3, columns.size());
    for (std::size_t i = columns.size(); i-- > 0;)
    {
      const CoordinateName name(columns[i].name);
      if (columns[i].components == 1 && name.axis >= 0 &&
        (name.axis == 2 || (name.unit == "degree") == inDegrees) &&
        (!name.isLast() || found[2] == columns.size() || CoordinateName(columns[found[2]].name).isLast()))
      {
        found[static_cast<std::size_t>(name.axis)] = i;
      }
    }
    if (std::find(found.begin(), found.end(), columns.size()) == found.end())
    {
      return true;
    }
  }
  return false;
}

std::vector<std::size_t> coordinatesOf(const std::vector<Column>& columns)
{
  std::vector<std::size_t> found;
  if (!findCoordinates(columns, found))
  {
    failCoordinates(columns);
  }
  return found;
}

std::string coordinateUnit(const std::string& name)
{
  return CoordinateName(name).unit;
}

std::string coordinateWord(const std::string& name)
{
  return CoordinateName(name).rest;
}

bool isColorName(const std::string& name)
{
  std::string base;
  unsigned long long number = 0;
  const bool isNumbered = splitNumbered(name, base, number) && number < 4;
  return isOneOf(kColorsWithAlpha, name) || isOneOf(kColors, name) ||
    (isNumbered && (equalNoCase(base, "RGB") || equalNoCase(base, "RGBA")));
}

bool isNormalName(const std::string& name)
{
  return isOneOf(kNormals, name);
}

CloudColumns::CloudColumns(const std::vector<Column>& columns, vtkIdType rows)
  : columns_(columns)
  , rows_(rows)
  , placed_(columns.size(), false)
  , places_(columns.size())
{
  planPoints();
  if (!planNamed(kColorsWithAlpha, "RGBA", &isByte) && !planNamed(kColors, "RGB", &isByte) &&
    (planNamed(kColors, "Color16", &isWord) || planNamed(kColors, "Color", [](int) { return true; })))
  {
    colors_ = arrays_.size() - 1;
  }
  planNamed(kNormals, "Normals", &isFloatingType);
  planNumbered();
  shownBehind_ = arrays_.size() - 1;
}

void CloudColumns::planPoints()
{
  coordinates_ = coordinatesOf(columns_);
  const bool wide = std::any_of(
    coordinates_.begin(), coordinates_.end(), [&](std::size_t i) { return needsDouble(columns_[i].type); });
  add("Points", coordinates_, wide ? VTK_DOUBLE : VTK_FLOAT);
}

bool CloudColumns::planNamed(const Names& names, const char* arrayName, bool (*accepts)(int))
{
  std::vector<std::size_t> found;
  for (const std::vector<std::string>& candidate : names)
  {
    if (findNames(columns_, placed_, candidate, found) &&
      std::all_of(found.begin(), found.end(), [&](std::size_t i) { return accepts(columns_[i].type); }))
    {
      add(arrayName, found);
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
      }
      name = members.size() > 1 ? base : name;
    }
    add(name, members);
  }
}

void CloudColumns::add(const std::string& name, const std::vector<std::size_t>& columns, int type)
{
  const int components =
    columns.size() == 1 ? columns_[columns[0]].components : static_cast<int>(columns.size());
  for (std::size_t i = 0; i < columns.size(); ++i)
  {
    placed_[columns[i]] = true;
    places_[columns[i]] = { arrays_.size(), static_cast<int>(i) };
  }
  const int common = std::accumulate(columns.begin(), columns.end(), columns_[columns[0]].type,
    [&](int known, std::size_t i) { return commonType(known, columns_[i].type); });
  arrays_.push_back(makeArray(type == VTK_VOID ? common : type, components, rows_,
    unusedName(names_, name.empty() ? "unnamed" : name)));
}

void CloudColumns::showColors(std::size_t column)
{
  colors_ = shownBehind_ = places_[column].array;
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

void CloudColumns::fill(const std::vector<StoredColumn>& stored, const ReadTask& task) const
{
  task.fillRows(rows_,
    [&](vtkIdType row, vtkIdType end)
    {
      for (const StoredColumn& each : stored)
      {
        const ConstColumnView& source = each.source;
        copyStrided({ source.first + row * source.stride, source.stride, source.type },
          target(each.column, each.component).fromRow(row), end - row, each.isSwapped);
      }
    });
}

void CloudColumns::cut(std::uint64_t rows)
{
  if (rows < static_cast<std::uint64_t>(rows_))
  {
    rows_ = static_cast<vtkIdType>(rows);
    for (const vtkSmartPointer<vtkDataArray>& array : arrays_)
    {
      array->Resize(rows_);
    }
  }
}

void CloudColumns::turnAxes(ReadTask& task)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::string& name = columns_[coordinates_[static_cast<std::size_t>(axis)]].name;
    const bool isDepth = CoordinateName(name).isDepth();
    std::int64_t below = 0; // more than above
    for (vtkIdType i = 0; i < rows_ && isDepth; ++i)
    {
      const double depth = arrays_[0]->GetComponent(i, axis);
      below += depth > 0.0 ? 1 : depth < 0.0 ? -1 : 0;
    }
    const bool isDown = isDepth && task.sumOfRanks(below) > 0;
    const bool isTurned = (!task.columns.empty() && name.front() == '-') != isDown;
    isDepth
      ? task.notes.push_back("z is column " + inQuotes(name) + (isTurned ? " with the other sign" : "") +
          (isDown ? ", which counts down" : "") + "; called z it keeps its sign, called -z it changes it")
      : void();
    for (vtkIdType i = 0; i < rows_ && isTurned; ++i)
    {
      arrays_[0]->SetComponent(i, axis, 0.0 - arrays_[0]->GetComponent(i, axis));
    }
  }
}

void CloudColumns::moveTo(vtkPolyData* cloud, ReadTask& task)
{
  cut(task.pointsThere);
  turnAxes(task);
  vtkNew<vtkPoints> points;
  points->SetData(arrays_[0]);
  cloud->SetPoints(points);
  const auto shown = colors_ > 0 ? shownColors(arrays_[colors_], task) : nullptr;
  for (std::size_t i = 1; i < arrays_.size(); ++i)
  {
    cloud->GetPointData()->AddArray(arrays_[i]);
    if (shown && i == shownBehind_)
    {
      shown->SetName(unusedName(names_, "RGB").c_str());
      cloud->GetPointData()->AddArray(shown);
    }
  }
  setActiveAttributes(cloud);
}

vtkSmartPointer<vtkDataArray> bytesOfColors(vtkDataArray* colors, double most)
{
  auto bytes = vtkSmartPointer<vtkUnsignedCharArray>::New();
  bytes->SetName("RGB");
  bytes->SetNumberOfComponents(colors->GetNumberOfComponents());
  bytes->SetNumberOfTuples(colors->GetNumberOfTuples());
  withType(colors->GetDataType(),
    [&](auto zero)
    {
      fillBytes(static_cast<const decltype(zero)*>(colors->GetVoidPointer(0)), colors->GetNumberOfValues(),
        most, bytes->GetPointer(0));
    });
  return bytes;
}

void setOneVertexPerPoint(vtkPolyData* cloud)
{
  using Short = vtkTypeInt32Array;
  using Long = vtkTypeInt64Array;
  const vtkIdType count = cloud->GetNumberOfPoints();
  vtkNew<vtkCellArray> vertices;
  count >= std::numeric_limits<std::int32_t>::max()
    ? vertices->SetData(counted<Long>(count + 1), counted<Long>(count))
    : vertices->SetData(counted<Short>(count + 1), counted<Short>(count));
  cloud->SetVerts(vertices);
}

void keepPoints(vtkPolyData* cloud, vtkIdList* kept)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(cloud->GetPoints()->GetDataType());
  cloud->GetPoints()->GetPoints(kept, points);
  vtkNew<vtkPointData> values;
  values->CopyAllOn();
  values->CopyAllocate(cloud->GetPointData(), kept->GetNumberOfIds());
  for (vtkIdType i = 0; i < kept->GetNumberOfIds(); ++i)
  {
    values->CopyData(cloud->GetPointData(), kept->GetId(i), i);
  }
  cloud->SetPoints(points);
  cloud->GetPointData()->ShallowCopy(values);
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
