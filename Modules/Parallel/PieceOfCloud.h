/// @file
/// Clouds in pieces, one on each rank.
#pragma once

#include "PointHapticsParallelModule.h"

#include "Core/Distributed/Ranks.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

class vtkPolyData;

namespace pointhaptics
{

/// The points of @p cloud from @p first to before @p last with their arrays, one vertex each, and all of its
/// field data. Copies.
POINTHAPTICSPARALLEL_EXPORT vtkSmartPointer<vtkPolyData> pieceOfCloud(
  vtkPolyData* cloud, vtkIdType first, vtkIdType last);

/// The pieces of all ranks, by rank one after the other, on rank 0; on the others null. Field data is that of
/// rank 0. @pre all pieces have arrays of the same names, types and components.
POINTHAPTICSPARALLEL_EXPORT vtkSmartPointer<vtkPolyData> gatherPieces(Ranks& ranks, vtkPolyData* piece);

} // namespace pointhaptics
