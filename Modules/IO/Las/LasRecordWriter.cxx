#include "IO/Las/LasRecordWriter.h"

#include "IO/Las/LasHeader.h"
#include "IO/Text/TextScan.h"

#include "vtkFieldData.h"
#include "vtkStringArray.h"

namespace pointhaptics::io
{

namespace
{

constexpr std::size_t kMostText = 65535; ///< 16 bits hold the length of a record

} // namespace

std::string lasRecordHeader(const std::string& user, int id, std::size_t size)
{
  std::string header(kLasVlrHeader, '\0');
  header.replace(2, user.size(), user);
  putLittle(header, 18, static_cast<std::uint16_t>(id));
  putLittle(header, 20, static_cast<std::uint16_t>(size));
  return header;
}

std::string lasCoordinateSystemRecord(vtkFieldData* fieldData, std::uint16_t& encoding)
{
  vtkStringArray* array = vtkStringArray::SafeDownCast(fieldData->GetAbstractArray("CoordinateSystem"));
  const std::string system = array && array->GetNumberOfValues() == 1 ? array->GetValue(0) : std::string();
  unsigned long long code = 0;
  if (system.rfind("EPSG:", 0) == 0 && parseCount(std::string_view(system).substr(5), code) && code < 32767)
  {
    const bool geographic = code >= 4000 && code < 5000;
    const int keys[] = { 1, 1, 0, 2, 1024, 0, 1, geographic ? 2 : 1, geographic ? 2048 : 3072, 0, 1,
      static_cast<int>(code) };
    std::string content(sizeof(keys) / sizeof(keys[0]) * 2, '\0');
    for (std::size_t i = 0; i < content.size() / 2; ++i)
    {
      putLittle(content, 2 * i, static_cast<std::uint16_t>(keys[i]));
    }
    return lasRecordHeader("LASF_Projection", 34735, content.size()) + content;
  }
  if (!system.empty() && system.size() < kMostText)
  {
    encoding = static_cast<std::uint16_t>(encoding | kLasWellKnownTextBit);
    return lasRecordHeader("LASF_Projection", 2112, system.size() + 1) + system + '\0';
  }
  return {};
}

} // namespace pointhaptics::io
