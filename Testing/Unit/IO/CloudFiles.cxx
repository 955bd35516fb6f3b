#include "CloudFiles.h"

#include <cstdint>
#include <cstdlib>

std::string makeLas(int minor, int format, std::size_t recordLength)
{
  const std::size_t headerSize = minor == 4 ? 375 : 227;
  std::string las(headerSize + 2 * recordLength, '\0');
  las.replace(0, 4, "LASF");
  las[24] = 1;
  las[25] = static_cast<char>(minor);
  put(las, 94, static_cast<std::uint16_t>(headerSize));
  put(las, 96, static_cast<std::uint32_t>(headerSize));
  las[104] = static_cast<char>(format);
  put(las, 105, static_cast<std::uint16_t>(recordLength));
  if (minor == 4)
  {
    put(las, 247, std::uint64_t{ 2 });
  }
  else
  {
    put(las, 107, std::uint32_t{ 2 });
  }
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    put(las, 131 + 8 * axis, 0.01);
    put(las, 155 + 8 * axis, 1000.0 * static_cast<double>(axis));
  }
  for (int point = 0; point < 2; ++point)
  {
    const std::size_t at = headerSize + static_cast<std::size_t>(point) * recordLength;
    put(las, at, std::int32_t{ 100 * point });
    put(las, at + 4, std::int32_t{ 200 * point });
    put(las, at + 8, std::int32_t{ -300 * point });
  }
  return las;
}

std::string sharedData()
{
  const char* chosen = std::getenv("POINTHAPTICS_SHARED_DATA");
  const std::string folder = chosen ? chosen : POINTHAPTICS_SHARED_DATA;
  return std::filesystem::is_directory(folder) ? folder : std::string();
}
