#include "Devices/Falcon/FalconFirmware.h"

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

namespace pointhaptics
{
namespace
{
constexpr std::size_t kLargestFirmware = 65536;

Status refuse(std::string& message, const std::string& reason)
{
  message = reason +
    ". The Falcon runs a program that it loses without power. Its licence does not allow us to ship it: "
    "take the file (8492 bytes) from Novint's own driver and name it, or set the variable " +
    kFirmwareVariable + " to its path; Documentation/Devices.md says how";
  return Status::FirmwareMissing;
}
}

std::string falconFirmwareFile(const std::string& fileName)
{
  const char* const variable = std::getenv(kFirmwareVariable);
  return fileName.empty() && variable ? variable : fileName;
}

Status readFalconFirmware(const std::string& fileName, FalconFirmware& firmware, std::string& message)
{
  firmware = FalconFirmware();
  message.clear();
  if (fileName.empty())
  {
    return refuse(message, "no firmware file is named");
  }
  std::error_code error;
  errno = 0;
  std::ifstream file(fileName, std::ios::binary);
  if (!file || std::filesystem::is_directory(fileName, error))
  {
    const std::string reason = errno ? std::generic_category().message(errno) : "it is a folder";
    return refuse(message, fileName + ": the firmware file cannot be opened (" + reason + ")");
  }
  std::vector<std::uint8_t> bytes(kLargestFirmware + 1);
  file.read(reinterpret_cast<char*>(bytes.data()), std::streamsize(bytes.size()));
  bytes.resize(std::size_t(file.gcount()));
  if (bytes.empty() || bytes.size() > kLargestFirmware)
  {
    return refuse(message,
      fileName + ": " + (bytes.empty() ? "the file is empty" : "the file has more than 65536 bytes") +
        ", which no Falcon firmware is");
  }
  if (bytes.size() != kKnownFirmwareSize)
  {
    firmware.note = fileName + ": " + std::to_string(bytes.size()) + " bytes; the image known to work has " +
      std::to_string(kKnownFirmwareSize);
  }
  firmware.bytes = std::move(bytes);
  return Status::Ok;
}

} // namespace pointhaptics
