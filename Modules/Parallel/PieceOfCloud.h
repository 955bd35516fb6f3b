/// @file
/// Clouds in pieces, one on each rank.
#pragma once

#include "PointHapticsParallelModule.h"

#include "Core/Distributed/Ranks.h"

#include "vtkSmartPointer.h"

#include <vector>

class vtkPointSet;
class vtkPolyData;

namespace pointhaptics
{

/// The pieces of all ranks, by rank one after the other, on rank 0; on the others null. Field data is that of
/// rank 0. @pre all pieces have arrays of the same names, types and components.
POINTHAPTICSPARALLEL_EXPORT vtkSmartPointer<vtkPolyData> gatherPieces(Ranks& ranks, vtkPolyData* piece);

/// The points of all ranks that are meant for this one, with their arrays, in the order of ranks and on each
/// in its own. @p to: for each point of @p piece the rank that gets it, or -1. @pre as of gatherPieces();
/// arrays of numbers alone.
POINTHAPTICSPARALLEL_EXPORT vtkSmartPointer<vtkPolyData> exchangePoints(
  Ranks& ranks, vtkPolyData* piece, const std::vector<int>& to);

/// @p piece; where it has no points and others have, an empty cloud with point arrays as those of the first
/// rank that has: sources that know no pieces give all to one rank, and to the others nothing at all.
POINTHAPTICSPARALLEL_EXPORT vtkSmartPointer<vtkPointSet> withArraysOfOthers(Ranks& ranks, vtkPointSet* piece);

} // namespace pointhaptics
