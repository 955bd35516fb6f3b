/// @file
/// One VTP file that several ranks write together, each its part of the points.
#pragma once

#include "PointHapticsIOModule.h"

#include "Core/Distributed/Ranks.h"

#include <string>

class vtkPolyData;

namespace pointhaptics::io
{

/// Collective: writes the points of all ranks, one rank after the other, with their arrays and a vertex for
/// each: the bytes that vtkPointCloudWriter writes of all points in one cloud. Field data is that of rank 0.
/// Each rank writes its own points to their place; the file has its name once all are there. @p problem: what
/// kept this rank from it, empty on those that had none; nothing is left then. @pre all pieces have arrays of
/// the same names, types and components.
///
/// @return false, the same on all ranks, with nothing written: the file needs a rank that has all points.
/// That is so where clouds have other cells, arrays of strings or bits, or no points at all, where the file
/// is none that can be replaced, and where a rank does not see what rank 0 writes, as on another machine.
POINTHAPTICSIO_EXPORT bool writeVtpTogether(
  Ranks& ranks, vtkPolyData* piece, const std::string& fileName, std::string& problem);

} // namespace pointhaptics::io
