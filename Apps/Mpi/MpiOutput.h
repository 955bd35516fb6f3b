/// @file
/// Clouds of a job: read in pieces, written as one file or as one per rank.
#pragma once

#include "MpiCommands.h"
#include "Traffic.h"

#include "Clouds/CloudCommands.h"

#include <vtkSmartPointer.h>
#include <vtkType.h>

#include <functional>
#include <memory>

namespace pointhaptics::app
{

/// A rank's part of a cloud.
struct Piece
{
  vtkSmartPointer<vtkPolyData> points;
  vtkIdType pointsOfAll = 0; ///< Number of points on all ranks.
};

/// Adds a command to @p program, which has the options of @p shared beside those of ranks. Its callback
/// checks the files, those of @p ranks processes among them, fills in the input, and stores what they run in
/// @p work.
void addRankCommand(CLI::App& program, const char* name, const char* description, int ranks, MpiWork& work,
  std::shared_ptr<CloudCommand> shared, std::shared_ptr<Traffic> traffic,
  std::function<void(Job&, Files&)> run);

/// Sets the threads, one per rank unless the options say more, and reads this rank's points of the input:
/// contiguous ones, as many on each rank.
Piece openPiece(Job& job, const CloudCommand& options, Traffic& traffic);

/// Writes the pieces of all ranks: as one file by rank 0, or for a .pvtp a file of each rank beside it and
/// the list of these.
void writePieces(Job& job, const CloudCommand& options, vtkPolyData* piece, Files& files);
/// Gives the outputs of all ranks their names, or none of them.
void commitTogether(Job& job, Files& files);

} // namespace pointhaptics::app
