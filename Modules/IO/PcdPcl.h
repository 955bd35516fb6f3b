/// @file
/// The only door to PCL. Nothing of PCL or Eigen appears here.
#pragma once

#include "PcdHeader.h"

#include <cstdint>
#include <string>
#include <vector>

namespace pointhaptics::io
{

/// The records of the binary or binary_compressed file @p path, unpacked: header.points times
/// header.recordSize bytes. @pre parsePcdHeader accepted the file.
/// Calls from several threads wait for each other, because PCL's verbosity is global.
/// @throws FileProblem when PCL refuses the file, or when this build has no PCL.
std::vector<std::uint8_t> readPcdRecords(const std::string& path, const PcdHeader& header);

} // namespace pointhaptics::io
