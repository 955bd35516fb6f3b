/// @file
/// The Falcon's firmware: read from a file that the user names.
#pragma once

#include "Core/Base/Status.h"

#include <cstdint>
#include <string>
#include <vector>

namespace pointhaptics
{

/// The Falcon loses its firmware when it loses power, and Novint's licence does not allow anyone else to
/// hand the image on: the user takes it from Novint's own driver and names it here.
struct FalconFirmware
{
  std::vector<std::uint8_t> bytes;
  std::string note; ///< Empty, or why the file looks unlike the image known to work; it is used all the same.
};

/// Size of the image that is known to work, bytes.
constexpr std::size_t kKnownFirmwareSize = 8492;
/// Variable of the environment that names the file where no option does.
constexpr const char* kFirmwareVariable = "POINTHAPTICS_FALCON_FIRMWARE";

/// Returns @p fileName, or if that is empty the file that kFirmwareVariable names; may stay empty.
std::string falconFirmwareFile(const std::string& fileName);

/// FirmwareMissing: no name, no such file, empty, or larger than 64 KiB; @p message says what the file is,
/// why it is not part of this package, and what to do.
Status readFalconFirmware(const std::string& fileName, FalconFirmware& firmware, std::string& message);

} // namespace pointhaptics
