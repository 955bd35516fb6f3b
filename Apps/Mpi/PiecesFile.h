/// @file
/// Clouds in one file per rank: VTK's parallel format, a list of VTP files.
#pragma once

#include <string>
#include <vector>

class vtkPolyData;

namespace pointhaptics::app
{

/// True if @p fileName ends in .pvtp.
bool isPiecesFile(const std::string& fileName);

/// Name of a rank's piece: "means_2.vtp" beside "means.pvtp".
std::string pieceFileOf(const std::string& fileName, int rank);

/// Writes the list of the files of @p ranks beside @p fileName, whose points have arrays as those of @p like,
/// to @p path, where that file comes from. False: @p message says why.
bool writePiecesFile(const std::string& path, const std::string& fileName, vtkPolyData* like,
  const std::vector<int>& ranks, std::string& message);

} // namespace pointhaptics::app
