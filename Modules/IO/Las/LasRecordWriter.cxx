#include "IO/Las/LasRecordWriter.h"

#include "Bytes/NumericType.h"
#include "IO/Las/LasHeader.h"

#include <iterator>

namespace pointhaptics::io
{

int lasTypeCode(int type)
{
  const int codes[][2] = { { VTK_TYPE_UINT8, 1 }, { VTK_TYPE_INT8, 2 }, { VTK_TYPE_UINT16, 3 },
    { VTK_TYPE_INT16, 4 }, { VTK_TYPE_UINT32, 5 }, { VTK_TYPE_INT32, 6 }, { VTK_TYPE_UINT64, 7 },
    { VTK_TYPE_INT64, 8 }, { VTK_FLOAT, 9 }, { VTK_DOUBLE, 10 } };
  const int plain = fixedSizeType(type);
  return (*std::find_if(
    std::begin(codes), std::end(codes), [&](const int(&entry)[2]) { return entry[0] == plain; }))[1];
}

std::string lasRecordHeader(const std::string& user, int id, std::size_t size, std::string_view description)
{
  std::string header(kLasVlrHeader, '\0');
  header.replace(2, user.size(), user);
  putLittle(header, 18, static_cast<std::uint16_t>(id));
  putLittle(header, 20, static_cast<std::uint16_t>(size));
  header.replace(22, description.size(), description);
  return header;
}

} // namespace pointhaptics::io
