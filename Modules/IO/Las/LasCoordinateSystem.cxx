#include "IO/Las/LasCoordinateSystem.h"

#include "IO/Bytes/TextScan.h"
#include "IO/Info/FieldText.h"
#include "IO/Info/LengthUnit.h"
#include "IO/Las/LasHeader.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

namespace pointhaptics::io
{

namespace
{

constexpr int kWellKnownText = 2112;
constexpr int kGeoKeys = 34735;
// GeoTIFF keys and the codes of their values.
constexpr int kModelType = 1024;
constexpr int kGeographicModel = 2;
constexpr int kGeographicSystem = 2048;
constexpr int kAngularUnit = 2054;
constexpr int kDegreeUnit = 9102;
constexpr int kProjectedSystem = 3072;
constexpr int kProjectedUnit = 3076;
constexpr int kVerticalUnit = 4099;
constexpr int kUserDefined = 32767;

constexpr const char* kDegree = "degree";
constexpr std::size_t kMostText = 65535; ///< 16 bits hold the length of a record

/// @return nothing for code 0, which some units have for none.
const char* nameOfUnit(int code)
{
  const auto* const unit = std::find_if(std::begin(kLengthUnits), std::end(kLengthUnits),
    [&](const NamedUnit& each) { return code != 0 && each.code == code; });
  return unit == std::end(kLengthUnits) ? "" : unit->word;
}

/// @return 0 for a unit without a code.
int codeOfUnit(const std::string& name)
{
  const NamedUnit* unit = findLengthUnit(name);
  return unit ? unit->code : 0;
}

/// The last unit that well-known @p text names; empty where it names none.
std::string lastUnit(const std::string& text)
{
  const std::size_t unit = text.rfind("UNIT[\"");
  const std::size_t name = unit == std::string::npos ? text.size() : text.find('"', unit) + 1;
  return text.substr(name, text.find('"', name) - name);
}

/// The record of GeoTIFF keys. @param code of the system, 0 where only the unit is known; @param unit 0 where
/// it is not; @param isGeographic whether coordinates are degrees, on an unknown datum where there is no
/// code.
std::string keysRecord(int code, int unit, bool isGeographic)
{
  std::vector<std::pair<int, int>> keys = { { kModelType, isGeographic ? 2 : 1 },
    { isGeographic ? kGeographicSystem : kProjectedSystem, code > 0 ? code : kUserDefined } };
  if (unit > 0 || isGeographic)
  {
    keys.emplace_back(isGeographic ? kAngularUnit : kProjectedUnit, isGeographic ? kDegreeUnit : unit);
  }
  std::vector<int> numbers = { 1, 1, 0, int(keys.size()) };
  for (const auto& [key, value] : keys)
  {
    numbers.insert(numbers.end(), { key, 0, 1, value });
  }
  std::string content(2 * numbers.size(), '\0');
  for (std::size_t i = 0; i < numbers.size(); ++i)
  {
    putLittle(content, 2 * i, static_cast<std::uint16_t>(numbers[i]));
  }
  return lasRecordHeader(kLasProjectionUser, kGeoKeys, content.size()) + content;
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
    if (place == 0 && value != 0 && value != kUserDefined)
    {
      int& known = keys_[key];
      known = key == kGeographicSystem && known != 0 ? known : value;
    }
  }
}

int LasCoordinateSystem::keyOf(int key) const
{
  const auto found = keys_.find(key);
  return found == keys_.end() ? 0 : found->second;
}

std::string LasCoordinateSystem::name() const
{
  const int code = keyOf(kProjectedSystem) != 0 ? keyOf(kProjectedSystem) : keyOf(kGeographicSystem);
  return !text_.empty() || code == 0 ? text_ : "EPSG:" + std::to_string(code);
}

std::string LasCoordinateSystem::lengthUnit() const
{
  const std::string unitOfKeys = nameOfUnit(keyOf(kProjectedUnit));
  // PROJCS ends with its own unit, after that of the geographic system it stands on.
  const std::size_t projected = text_.find("PROJC");
  if (projected == std::string::npos)
  {
    const bool isText = text_.rfind("GEOG", 0) == 0 || text_.rfind("GEODCRS", 0) == 0 ||
      text_.rfind("COMPD_CS", 0) == 0 || text_.rfind("COMPOUNDCRS", 0) == 0;
    const bool hasDegrees =
      text_.find("GEOG") != std::string::npos || text_.find("GEODCRS") != std::string::npos;
    const bool isGeographic = text_.empty() && keyOf(kModelType) == kGeographicModel;
    return unitOfKeys.empty() && (isGeographic || (isText && hasDegrees)) ? kDegree : unitOfKeys;
  }
  const std::string unit = lastUnit(text_.substr(projected, text_.find("VERT") - projected));
  return unit.empty() ? unitOfKeys : unit;
}

std::string LasCoordinateSystem::heightUnit() const
{
  const std::size_t vertical = text_.find("VERT");
  return text_.empty() ? nameOfUnit(keyOf(kVerticalUnit))
                       : lastUnit(text_.substr(std::min(vertical, text_.size())));
}

bool isMetre(const std::string& unit)
{
  return codeOfUnit(unit) == kLengthUnits[0].code;
}

bool isOtherUnit(const std::string& unit, const std::string& other)
{
  constexpr double kFeetDiffer = 1e-5; // the foot and the US survey foot do by 2e-6
  const NamedUnit* const known = findLengthUnit(unit);
  const NamedUnit* const beside = findLengthUnit(other == kDegree ? "m" : other);
  return known && beside && std::abs(known->metres / beside->metres - 1.0) > kFeetDiffer;
}

bool lasSaysUnit(vtkFieldData* fieldData)
{
  const std::string system = fieldText(fieldData, "CoordinateSystem");
  const bool isText = !system.empty() && system.rfind("EPSG:", 0) != 0; // which says its own
  const std::string unit = fieldText(fieldData, "LengthUnit");
  return isText || lengthUnitCalled(unit) == "deg" || codeOfUnit(unit) > 0;
}

std::string lasCoordinateSystemRecord(vtkFieldData* fieldData, std::uint16_t& encoding)
{
  const std::string system = fieldText(fieldData, "CoordinateSystem");
  const std::string unitName = fieldText(fieldData, "LengthUnit");
  const int unit = codeOfUnit(unitName);
  const bool areDegrees = lengthUnitCalled(unitName) == "deg";
  unsigned long long code = 0;
  if (system.rfind("EPSG:", 0) == 0 && parseCount(std::string_view(system).substr(5), code) &&
    code < kUserDefined)
  {
    return keysRecord(int(code), unit, code >= 4000 && code < 5000);
  }
  if (!system.empty() && system.size() < kMostText)
  {
    encoding = static_cast<std::uint16_t>(encoding | kLasWellKnownTextBit);
    return lasRecordHeader(kLasProjectionUser, kWellKnownText, system.size() + 1) + system + '\0';
  }
  return unit > 0 || areDegrees ? keysRecord(0, unit, areDegrees) : std::string();
}

} // namespace pointhaptics::io
