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
  { "isColorInvalid", "ColorInvalid" }, { "isTimeStampInvalid", "TimeStampInvalid" } };

constexpr const char* kFlags[] = { "InvalidState", "SphericalInvalidState", "IntensityInvalid",
  "ColorInvalid", "TimeStampInvalid" };

/// Names that no field of an extension may take.
constexpr const char* kOtherColumns[] = { "red", "green", "blue", "Color16", "Color", "RGB", "ScanIndex",
  "nx", "ny", "nz" };
constexpr const char* kSecond = "_2";

const std::string kCartesian[] = { "cartesianX", "cartesianY", "cartesianZ" };
const std::string kSpherical[] = { "sphericalRange", "sphericalAzimuth", "sphericalElevation" };
const std::string kChannels[] = { "colorRed", "colorGreen", "colorBlue" };
constexpr const char* kByteColors[] = { "red", "green", "blue" };

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

bool isIntegerWithin(const E57Field& field, std::int64_t most)
{
  return field.kind == E57Field::Kind::Integer && field.minimum >= 0 && field.maximum <= most;
}

/// The normals of the extension "nor", whose prefix a file may choose.
const char* normalColumn(const std::string& field)
{
  constexpr Name kNormalNames[] = { { ":normalX", "nx" }, { ":normalY", "ny" }, { ":normalZ", "nz" } };
  for (const Name& name : kNormalNames)
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

/// The smallest one that holds both.
int integerType(std::int64_t minimum, std::int64_t maximum)
{
  for (int bits = 8; bits < 64; bits *= 2)
  {
    const auto size = static_cast<unsigned>(bits / 8);
    if (minimum >= 0 && maximum >> bits == 0)
    {
      return typeOfKind('u', size);
    }
    if (minimum >= -(std::int64_t{ 1 } << (bits - 1)) && maximum < std::int64_t{ 1 } << (bits - 1))
    {
      return typeOfKind('i', size);
    }
  }
  return VTK_TYPE_INT64;
}

} // namespace

bool isE57Flag(const std::string& column)
{
  return std::find(std::begin(kFlags), std::end(kFlags), column) != std::end(kFlags);
}

bool hasE57Colors(const E57Scan& scan)
{
  return hasAll(scan, kChannels);
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
  chooseColors(scans);
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
  if (storedColor_ != npos)
  {
    madeColor_ = columnNamed("RGB", 3);
    columns_[madeColor_].type = VTK_TYPE_UINT8;
  }
  if (scans.size() > 1)
  {
    scanIndex_ = columnNamed("ScanIndex");
    columns_[scanIndex_].type = VTK_TYPE_INT32;
  }
}

/// All scans must agree on how colours are kept: as bytes, as words, or as what they are.
void E57Columns::chooseColors(const std::vector<E57Scan>& scans)
{
  for (const E57Scan& scan : scans)
  {
    for (std::size_t i = 0; i < 3 && hasE57Colors(scan); ++i)
    {
      const E57Field& field = scan.fields[scan.find(kChannels[i])];
      hasByteColors_ = hasByteColors_ && isIntegerWithin(field, 255);
      hasWordColors_ = hasWordColors_ && isIntegerWithin(field, 65535);
    }
  }
}

void E57Columns::addScan(const E57Scan& scan)
{
  const bool isCartesian = hasAll(scan, kCartesian);
  failFormatIf(!isCartesian && !hasAll(scan, kSpherical), "export it with coordinates",
    "scan {} has neither cartesianX, cartesianY, cartesianZ nor sphericalRange, sphericalAzimuth, "
    "sphericalElevation",
    inQuotes(scan.name));
  isSpherical_.push_back(!isCartesian);
  const bool hasColors = hasE57Colors(scan);
  std::vector<Place>& places = places_.emplace_back();
  std::set<std::size_t> taken;
  for (const E57Field& field : scan.fields)
  {
    places.push_back(field.kind == E57Field::Kind::Text ? Place{} : placeOf(field, hasColors, taken));
  }
}

E57Columns::Place E57Columns::placeOf(const E57Field& field, bool hasColors, std::set<std::size_t>& taken)
{
  Place place;
  const auto color = std::find(std::begin(kChannels), std::end(kChannels), field.name);
  if (hasColors && color != std::end(kChannels))
  {
    const int channel = static_cast<int>(color - std::begin(kChannels));
    if (hasByteColors_)
    {
      place.column = columnNamed(kByteColors[channel]);
    }
    else
    {
      storedColor_ = columnNamed(hasWordColors_ ? "Color16" : "Color", 3);
      place = { storedColor_, channel, 0 };
    }
  }
  else
  {
    std::string name = columnOf(field.name);
    place.column = columnNamed(name);
    while (!taken.insert(place.column).second)
    {
      name += kSecond;
      place.column = columnNamed(name);
    }
    place.added =
      field.name == "returnIndex" && field.maximum < std::numeric_limits<std::int64_t>::max() ? 1 : 0;
  }
  hold(place.column, field, place.added);
  return place;
}

std::size_t E57Columns::columnNamed(const std::string& name, int components)
{
  const auto found = indices_.find(name);
  if (found != indices_.end())
  {
    return found->second;
  }
  failFormatIf(columns_.size() >= kMostColumns, "export fewer fields",
    "the scans have more than {} different fields", kMostColumns);
  columns_.push_back({ name, VTK_DOUBLE, components });
  values_.emplace_back();
  indices_[name] = columns_.size() - 1;
  return columns_.size() - 1;
}

void E57Columns::hold(std::size_t column, const E57Field& field, std::int64_t added)
{
  Values& values = values_[column];
  values.hasFloat = values.hasFloat || field.kind == E57Field::Kind::Float;
  values.hasDouble =
    values.hasDouble || field.kind == E57Field::Kind::Scaled || field.kind == E57Field::Kind::Double;
  if (field.kind == E57Field::Kind::Integer)
  {
    values.minimum = std::min(values.minimum, field.minimum + added);
    values.maximum = std::max(values.maximum, field.maximum + added);
    values.hasInteger = true;
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
    const bool isComputed = i == scanIndex_ || i == madeColor_ || (i < 3 && isSpherical_[scan]);
    if (!isThere[i] && !isComputed)
    {
      result.push_back(i);
    }
  }
  return result;
}

} // namespace pointhaptics::io
