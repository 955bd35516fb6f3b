#include "IO/Las/LasDescription.h"

#include "Bytes/NumericType.h"
#include "FileProblem.h"
#include "IO/Info/FieldText.h"
#include "IO/Las/LasCoordinateSystem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace pointhaptics::io
{

namespace
{

constexpr std::size_t kMostContent = 65535; ///< 16 bits hold the size of a record
constexpr std::size_t kDescription = 22;    ///< where the text begins in the header of a record
constexpr std::size_t kFarDescription = 28;
constexpr std::size_t kLongestText = 32;

/// True if the records of the file that the cloud came from say what its field data say now.
bool keepsCoordinateSystem(const LasOrigin& origin, vtkFieldData* fieldData)
{
  LasCoordinateSystem system;
  for (const LasRecord& record : lasRecords(origin))
  {
    record.user == kLasProjectionUser ? system.addRecord(record.id, record.content) : void();
  }
  return origin.isHere() && system.name() == fieldText(fieldData, "CoordinateSystem") &&
    system.lengthUnit() == fieldText(fieldData, "LengthUnit");
}

std::string_view descriptionOf(const LasRecord& record)
{
  return record.whole.substr(record.isFar ? kFarDescription : kDescription, kLongestText);
}

/// How gps time counts, and the like.
std::uint16_t keptEncoding(const LasOrigin& origin, vtkFieldData* fieldData)
{
  constexpr int kKept = 15;
  constexpr int kWaves = 6;
  vtkDataArray* array = fieldData->GetArray("LasGlobalEncoding");
  const double given = array && array->GetNumberOfValues() == 1 ? array->GetComponent(0, 0) : 0.0;
  const int format = origin.pointFormat();
  const bool hadWaves = format == 4 || format == 5 || format > 8; // which are not read
  return static_cast<std::uint16_t>(
    static_cast<int>(std::clamp(given, 0.0, 65535.0)) & (hadWaves ? kKept & ~kWaves : kKept));
}

} // namespace

LasDescription::LasDescription(const LasOrigin& origin, vtkFieldData* fieldData,
  const std::string& descriptors, const std::string& packing, bool isExtended,
  std::vector<std::string>& notes)
  : encoding(keptEncoding(origin, fieldData))
{
  const bool keepsSystem = keepsCoordinateSystem(origin, fieldData);
  if (keepsSystem)
  {
    encoding = static_cast<std::uint16_t>(
      encoding | (static_cast<unsigned char>(origin.header[6]) & kLasWellKnownTextBit));
  }
  else
  {
    add(lasCoordinateSystemRecord(fieldData, encoding));
  }
  bool describes = !descriptors.empty();
  const auto describe = [&](std::string_view text)
  {
    add(describes
        ? lasRecordHeader(kLasSpecUser, kLasExtraBytesRecord, descriptors.size(), text) + descriptors
        : std::string());
    describes = false;
  };
  for (const LasRecord& record : lasRecords(origin))
  {
    if (record.is(kLasSpecUser, kLasExtraBytesRecord))
    {
      describe(descriptionOf(record));
    }
    else if (record.user != kLasProjectionUser || keepsSystem)
    {
      keep(record, !packing.empty(), notes);
    }
  }
  describe({});
  add(packing);
  isOf14 = isExtended || origin.minorVersion() == 4 || farCount > 0 || (encoding & kLasWellKnownTextBit) != 0;
}

void LasDescription::keep(const LasRecord& record, bool isPacked, std::vector<std::string>& notes)
{
  if (!record.isFar)
  {
    add(std::string(record.whole));
  }
  else if (!isPacked)
  {
    far += record.whole;
    ++farCount;
  }
  else if (record.content.size() <= kMostContent)
  {
    add(lasRecordHeader(record.whole.substr(2, 16), record.id, record.content.size(), descriptionOf(record)) +
      std::string(record.content));
  }
  else
  {
    notes.push_back(fmt::format("the record {} of {}, of {} bytes, is left out; .las keeps it", record.id,
      inQuotes(record.user), record.content.size()));
  }
}

bool storeAsBefore(const OutputArray& array, const LasExtraField& field, OutputArray& stored)
{
  if (field.arrayType() != fixedSizeType(array.type()) || field.components != array.components() ||
    field.descriptor.empty())
  {
    return false;
  }
  const vtkIdType rows = array.array->GetNumberOfTuples();
  if (!field.isScaled && !field.hasNoData && array.array->GetDataType() == field.type)
  {
    stored.array = array.array; // whole numbers of 64 bits are more than a double holds
    return true;
  }
  stored.array = makeArray(field.type, field.components, rows);
  bool isSame = true;
  withType(field.type,
    [&](auto zero)
    {
      using T = decltype(zero);
      T* to = static_cast<T*>(stored.array->GetVoidPointer(0));
      for (vtkIdType i = 0; i < rows * field.components && isSame; ++i)
      {
        const auto third = static_cast<std::size_t>(i % field.components);
        const double value = array.array->GetComponent(i / field.components, static_cast<int>(third));
        const double raw = std::isnan(value) ? static_cast<double>(field.noDataOf<T>(third))
          : field.isScaled                   ? (value - field.shift[third]) / field.scale[third]
                                             : value;
        const double whole = std::is_integral_v<T> ? std::nearbyint(raw) : raw;
        isSame = std::isfinite(whole) && whole >= static_cast<double>(std::numeric_limits<T>::lowest()) &&
          whole < static_cast<double>(std::numeric_limits<T>::max()) + (std::is_integral_v<T> ? 1.0 : 0.0);
        to[i] = isSame ? static_cast<T>(whole) : T{};
        const double back = field.scale[third] * static_cast<double>(to[i]) + field.shift[third];
        isSame = isSame &&
          (std::isnan(value) ? field.hasNoData && field.isNoData(to[i], third)
                             : !field.isNoData(to[i], third) &&
                (array.type() == VTK_FLOAT ? static_cast<double>(static_cast<float>(back)) : back) == value);
      }
    });
  return isSame;
}

} // namespace pointhaptics::io
