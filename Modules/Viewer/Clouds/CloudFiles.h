/// @file
/// Reads the files of a cloud, and writes the part of them that is shown.
#pragma once

#include "LoadedCloud.h"

namespace pointhaptics
{

/// Findings collected while files are read.
struct Findings
{
  std::string format; ///< Format of the last file.
  std::vector<std::string> notes;
  bool isCoarse = false;
  bool hasSamples = false; ///< Of faces.
};

/// One cloud of all files with all arrays, in their coordinates, or the points that are there already. Points
/// of several files have the number of their file, kFileArrayName; the field data of that name has the files'
/// names. Null: @p message says why.
vtkSmartPointer<vtkPolyData> readFiles(const CloudRequest& request, const std::function<bool(double)>& goesOn,
  Findings& findings, std::string& message);

/// The points of @p cloud with all arrays, which are shared, without its cells.
vtkSmartPointer<vtkPolyData> withoutCells(vtkPolyData* cloud);

/// Reads the files of @p request again and writes what its options clip and hide to @p fileName, with all
/// arrays, in their coordinates. @p up is for heights that hide. False: @p message says why nothing was
/// written; else what was. Any thread; nothing is thrown.
bool writePart(
  const CloudRequest& request, const Vec3& up, const std::string& fileName, std::string& message);

} // namespace pointhaptics
