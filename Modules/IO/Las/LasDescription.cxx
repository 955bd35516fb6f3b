#include "IO/Las/LasDescription.h"

#include "Bytes/NumericType.h"
#include "FileProblem.h"
#include "IO/Info/FieldText.h"
#include "IO/Las/LasCoordinateSystem.h"
#include "IO/Las/LasRecordWriter.h"

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
  const auto add = [&](std::string_view, std::string_view user, int id, std::string_view content)
  {
    if (user == kLasProjectionUser)
    {
      system.addRecord(id, content);
    }
  };
  forEachLasRecord(origin.records, false, add);
  forEachLasRecord(origin.farRecords, true, add);
  return origin.isHere() && system.name() == fieldText(fieldData, "CoordinateSystem") &&
    system.lengthUnit() == fieldText(fieldData, "LengthUnit");
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

LasDescription::LasDescription(
  const LasOrigin& origin, vtkFieldData* fieldData, const LasPoints& points, WriterNotes& notes)
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
  bool describes = !points.descriptors.empty();
  const auto describe = [&](std::string_view text)
  {
    add(describes ? lasRecordHeader("LASF_Spec", kLasExtraBytesRecord, points.descriptors.size(), text) +
          points.descriptors
                  : std::string());
    describes = false;
  };
  for (const bool isFar : { false, true })
  {
    forEachLasRecord(isFar ? origin.farRecords : origin.records, isFar,
      [&](std::string_view record, std::string_view user, int id, std::string_view)
      {
        if (user == "LASF_Spec" && id == kLasExtraBytesRecord)
        {
          describe(record.substr(isFar ? kFarDescription : kDescription, kLongestText));
        }
        else if (user != kLasProjectionUser || keepsSystem)
        {
          keep(record, isFar, !points.packing.empty(), notes);
        }
      });
  }
  describe({});
  add(points.packing);
  isOf14 =
    points.isExtended || origin.minorVersion() == 4 || farCount > 0 || (encoding & kLasWellKnownTextBit) != 0;
}

void LasDescription::keep(std::string_view record, bool isFar, bool isPacked, WriterNotes& notes)
{
  constexpr std::size_t kFarHeader = 60;
  if (!isFar)
  {
    add(std::string(record));
    return;
  }
  if (!isPacked)
  {
    far += record;
    ++farCount;
    return;
  }
  const std::string_view user = record.substr(2, 16);
  const int id = loadLittle<std::uint16_t>(record.data() + 18);
  const std::string_view content = record.substr(kFarHeader);
  if (content.size() <= kMostContent)
  {
    add(lasRecordHeader(std::string(user), id, content.size(), record.substr(kFarDescription, kLongestText)) +
      std::string(content));
    return;
  }
  notes.add("the record " + std::to_string(id) + " of " + inQuotes(user.substr(0, user.find('\0'))) +
    ", of " + std::to_string(content.size()) + " bytes, is left out; .las keeps it");
}

/// The values of @p array as the file had them where each comes back so: of its type, with its scale, and
/// what it has for none.
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
  stored.array.TakeReference(vtkDataArray::CreateDataArray(field.type));
  stored.array->SetNumberOfComponents(field.components);
  stored.array->SetNumberOfTuples(rows);
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
