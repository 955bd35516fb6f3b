#include "IO/Las/LasCoordinateSystem.h"

#include "IO/Las/LasHeader.h"

#include <cstdint>

namespace pointhaptics::io
{

namespace
{

constexpr int kWellKnownText = 2112;
constexpr int kGeoKeys = 34735;
// GeoTIFF keys and the codes of their values.
constexpr int kGeographicSystem = 2048;
constexpr int kProjectedSystem = 3072;
constexpr int kProjectedUnit = 3076;
constexpr int kUserDefined = 32767;

const char* nameOfUnit(int code)
{
  switch (code)
  {
    case 9001:
      return "metre";
    case 9002:
      return "foot";
    case 9003:
      return "US survey foot";
    default:
      return "";
  }
}

} // namespace

void LasCoordinateSystem::addRecord(int id, std::string_view content)
{
  if (id == kWellKnownText)
  {
    text_ = std::string(content.substr(0, content.find('\0')));
  }
  else if (id == kGeoKeys)
  {
    addKeys(content);
  }
}

/// Four 16-bit numbers each: key, where the value is (0: here), how many, value. The first four count the
/// rest.
void LasCoordinateSystem::addKeys(std::string_view content)
{
  constexpr std::size_t kEntry = 8;
  for (std::size_t at = kEntry; at + kEntry <= content.size(); at += kEntry)
  {
    const int key = loadLittle<std::uint16_t>(content.data() + at);
    const int place = loadLittle<std::uint16_t>(content.data() + at + 2);
    const int value = loadLittle<std::uint16_t>(content.data() + at + 6);
    if (place != 0 || value == 0 || value == kUserDefined)
    {
      continue;
    }
    if (key == kProjectedSystem || (key == kGeographicSystem && code_.empty()))
    {
      code_ = "EPSG:" + std::to_string(value);
    }
    else if (key == kProjectedUnit)
    {
      unit_ = nameOfUnit(value);
    }
  }
}

std::string LasCoordinateSystem::lengthUnit() const
{
  // PROJCS ends with its own unit, after that of the geographic system it stands on.
  const std::size_t projected = text_.find("PROJC");
  if (projected == std::string::npos)
  {
    return unit_;
  }
  const std::string part = text_.substr(projected, text_.find("VERT") - projected);
  const std::size_t unit = part.rfind("UNIT[\"");
  const std::size_t name = unit == std::string::npos ? unit : part.find('"', unit) + 1;
  return name == std::string::npos ? unit_ : part.substr(name, part.find('"', name) - name);
}

} // namespace pointhaptics::io
