#include "IO/E57/E57Columns.h"

#include "Bytes/NumericType.h"
#include "FileProblem.h"

#include <algorithm>
#include <limits>

namespace pointhaptics::io
{

namespace
{

struct Name
{
  const char* field;
  const char* column;
};

constexpr Name kNames[] = { { "cartesianX", "x" }, { "cartesianY", "y" }, { "cartesianZ", "z" },
  { "sphericalRange", "SphericalRange" }, { "sphericalAzimuth", "SphericalAzimuth" },
  { "sphericalElevation", "SphericalElevation" }, { "intensity", "Intensity" }, { "rowIndex", "RowIndex" },
  { "columnIndex", "ColumnIndex" }, { "returnIndex", "ReturnNumber" }, { "returnCount", "NumberOfReturns" },
  { "timeStamp", "TimeStamp" }, { "cartesianInvalidState", "InvalidState" },
  { "sphericalInvalidState", "SphericalInvalidState" }, { "isIntensityInvalid", "IntensityInvalid" },
  { "isColorInvalid", "ColorInvalid" }, { "isTimeStampInvalid", "TimeStampInvalid" }, { "colorRed", "red" },
  { "colorGreen", "green" }, { "colorBlue", "blue" } };

constexpr const char* kFlags[] = { "InvalidState", "SphericalInvalidState", "IntensityInvalid",
  "ColorInvalid", "TimeStampInvalid" };

/// Names that no field of an extension may take.
constexpr const char* kOtherColumns[] = { "Color16", "Color", "RGB", "ScanIndex", "nx", "ny", "nz" };
constexpr const char* kSecond = "_2";

const std::string kCartesian[] = { "cartesianX", "cartesianY", "cartesianZ" };
const std::string kSpherical[] = { "sphericalRange", "sphericalAzimuth", "sphericalElevation" };

template <std::size_t N>
bool hasAll(const E57Scan& scan, const std::string (&names)[N])
{
  return std::all_of(std::begin(names), std::end(names),
    [&](const std::string& name)
    {
      const std::size_t field = scan.find(name);
      return field != E57Scan::npos && scan.fields[field].kind != E57Field::Kind::Text;
    });
}

/// The normals of the extension "nor", whose prefix a file may choose.
const char* normalColumn(const std::string& field)
{
  constexpr Name kNormals[] = { { ":normalX", "nx" }, { ":normalY", "ny" }, { ":normalZ", "nz" } };
  for (const Name& name : kNormals)
  {
    const std::string end = name.field;
    if (field.size() > end.size() && field.compare(field.size() - end.size(), end.size(), end) == 0)
    {
      return name.column;
    }
  }
  return nullptr;
}

bool isOurs(const std::string& column)
{
  return std::any_of(
           std::begin(kNames), std::end(kNames), [&](const Name& name) { return column == name.column; }) ||
    std::find(std::begin(kOtherColumns), std::end(kOtherColumns), column) != std::end(kOtherColumns);
}

std::string columnOf(const std::string& field)
{
  for (const Name& name : kNames)
  {
    if (field == name.field)
    {
      return name.column;
    }
  }
  const char* normal = normalColumn(field);
  return normal ? normal : field + (isOurs(field) ? kSecond : "");
}

template <typename T>
bool holds(std::int64_t minimum, std::int64_t maximum)
{
  return minimum >= std::int64_t{ std::numeric_limits<T>::min() } &&
    maximum <= std::int64_t{ std::numeric_limits<T>::max() };
}

/// The smallest one that holds both.
int integerType(std::int64_t minimum, std::int64_t maximum)
{
  return holds<std::uint8_t>(minimum, maximum) ? VTK_TYPE_UINT8
    : holds<std::int8_t>(minimum, maximum)     ? VTK_TYPE_INT8
    : holds<std::uint16_t>(minimum, maximum)   ? VTK_TYPE_UINT16
    : holds<std::int16_t>(minimum, maximum)    ? VTK_TYPE_INT16
    : holds<std::uint32_t>(minimum, maximum)   ? VTK_TYPE_UINT32
    : holds<std::int32_t>(minimum, maximum)    ? VTK_TYPE_INT32
                                               : VTK_TYPE_INT64;
}

} // namespace

bool isE57Flag(const std::string& column)
{
  return std::find(std::begin(kFlags), std::end(kFlags), column) != std::end(kFlags);
}

int E57Columns::Values::type() const
{
  if (!hasInteger)
  {
    return hasFloat && !hasDouble ? VTK_FLOAT : VTK_DOUBLE;
  }
  const int integer = integerType(minimum, maximum);
  return hasDouble || (hasFloat && needsDouble(integer)) ? VTK_DOUBLE : hasFloat ? VTK_FLOAT : integer;
}

E57Columns::E57Columns(const std::vector<E57Scan>& scans, bool movesPoints)
{
  for (const char* axis : { "x", "y", "z" })
  {
    columnNamed(axis);
  }
  for (const E57Scan& scan : scans)
  {
    addScan(scan);
  }
  const bool computes =
    movesPoints || std::any_of(isSpherical_.begin(), isSpherical_.end(), [](bool is) { return is; });
  for (std::size_t i = 0; i < columns_.size(); ++i)
  {
    columns_[i].type = i < 3 && computes ? VTK_DOUBLE : values_[i].type();
  }
  if (scans.size() > 1)
  {
    scanIndex_ = columnNamed("ScanIndex");
    columns_[scanIndex_].type = VTK_TYPE_INT32;
  }
}

void E57Columns::addScan(const E57Scan& scan)
{
  const bool isCartesian = hasAll(scan, kCartesian);
  if (!isCartesian && !hasAll(scan, kSpherical))
  {
    failFormat("scan " + inQuotes(scan.name) +
        " has neither cartesianX, cartesianY, cartesianZ nor sphericalRange, "
        "sphericalAzimuth, sphericalElevation",
      "export it with coordinates");
  }
  isSpherical_.push_back(!isCartesian);
  std::vector<Place>& places = places_.emplace_back();
  std::set<std::size_t> taken;
  for (const E57Field& field : scan.fields)
  {
    places.push_back(field.kind == E57Field::Kind::Text ? Place{} : placeOf(field, taken));
  }
}

E57Columns::Place E57Columns::placeOf(const E57Field& field, std::set<std::size_t>& taken)
{
  Place place;
  std::string name = columnOf(field.name);
  place.column = columnNamed(name);
  while (!taken.insert(place.column).second)
  {
    name += kSecond;
    place.column = columnNamed(name);
  }
  place.added =
    field.name == "returnIndex" && field.maximum < std::numeric_limits<std::int64_t>::max() ? 1 : 0;
  hold(place.column, field, place.added);
  return place;
}

std::size_t E57Columns::columnNamed(const std::string& name)
{
  const auto found = indices_.find(name);
  if (found != indices_.end())
  {
    return found->second;
  }
  if (columns_.size() >= kMostColumns)
  {
    failFormat("the scans have more than " + std::to_string(kMostColumns) + " different fields",
      "export fewer fields");
  }
  columns_.push_back({ name, VTK_DOUBLE });
  values_.emplace_back();
  indices_[name] = columns_.size() - 1;
  return columns_.size() - 1;
}

void E57Columns::hold(std::size_t column, const E57Field& field, std::int64_t added)
{
  Values& values = values_[column];
  switch (field.kind)
  {
    case E57Field::Kind::Integer:
      values.minimum =
        values.hasInteger ? std::min(values.minimum, field.minimum + added) : field.minimum + added;
      values.maximum =
        values.hasInteger ? std::max(values.maximum, field.maximum + added) : field.maximum + added;
      values.hasInteger = true;
      break;
    case E57Field::Kind::Float:
      values.hasFloat = true;
      break;
    case E57Field::Kind::Scaled:
    case E57Field::Kind::Double:
      values.hasDouble = true;
      break;
    case E57Field::Kind::Text:
      break;
  }
}

std::vector<std::size_t> E57Columns::missing(std::size_t scan) const
{
  std::vector<bool> isThere(columns_.size(), false);
  for (const Place& place : places_[scan])
  {
    if (place.column != npos)
    {
      isThere[place.column] = true;
    }
  }
  std::vector<std::size_t> result;
  for (std::size_t i = 0; i < columns_.size(); ++i)
  {
    const bool isComputed = i == scanIndex_ || (i < 3 && isSpherical_[scan]);
    if (!isThere[i] && !isComputed)
    {
      result.push_back(i);
    }
  }
  return result;
}

} // namespace pointhaptics::io
