#include "IO/Las/LasRecordWriter.h"

#include "IO/Las/LasHeader.h"

namespace pointhaptics::io
{

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
