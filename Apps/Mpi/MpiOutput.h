/// @file
/// Clouds of a job: read in pieces, written as one file or as one per rank.
#pragma once

#include "Forward.h"
#include "Traffic.h"

#include "Clouds/CloudToCloud.h"

#include <vtkSmartPointer.h>
#include <vtkType.h>

#include <string>

namespace pointhaptics::app
{

/// A rank's part of a cloud.
struct Piece
{
  vtkSmartPointer<vtkPolyData> points;
  vtkIdType pointsOfAll = 0; ///< Number of points on all ranks.
};

/// Adds the options that a command of ranks has beside those of pointhaptics, and the common ones.
void addOutputOptions(CLI::App& command);
/// Checks the files of the parsed @p command, those of @p ranks processes among them, and fills in the input.
/// False: there is nothing to do (--dry-run).
bool takeFiles(CLI::App& command, CloudToCloudOptions& options, int ranks, Files& files);

/// Sets the threads, one per rank unless the options say more, and
/// reads this rank's points of the input: contiguous ones, as many on each rank. False on all ranks: the
/// message is printed.
bool openPiece(
  Job& job, const std::string& command, const CloudToCloudOptions& files, Traffic& traffic, Piece& piece);

/// Writes the pieces of all ranks: as one file by rank 0, or for a .pvtp a file of each rank beside it and
/// the list of these. False on all ranks: the message is printed.
bool writePieces(
  Job& job, const std::string& command, const CloudToCloudOptions& options, vtkPolyData* piece, Files& files);
/// Gives the outputs of all ranks their names. False on all ranks: none has appeared, and the message is
/// printed.
bool commitTogether(Job& job, const std::string& command, Files& files);

} // namespace pointhaptics::app
