/// @file
/// Which point arrays of a cloud have values in voxels.
#pragma once

#include "VoxelAttribute.h"

#include "Core/Resample/VoxelMeanSettings.h"

#include <string>
#include <vector>

class vtkDataArray;
class vtkPointSet;

namespace pointhaptics
{

/// The array of KeepOriginalPointIds.
constexpr const char* kOriginalPointIds = "vtkOriginalPointIds";

/// A point array of the input, and what becomes of it.
struct VoxelArray
{
  vtkDataArray* array = nullptr;
  AttributeStatistic statistic = AttributeStatistic::Mean;
  int roles = 0; ///< As rolesOf() says.
  bool isNormal = false;
};

/// Arrays of @p input that have values in voxels, in its order; not identifiers, ghost flags and results of
/// an earlier resampling.
/// @p dropped: a sentence for each array that has no value in voxels.
std::vector<VoxelArray> voxelArrays(
  vtkPointSet* input, const VoxelMeanSettings& settings, std::vector<std::string>& dropped);

} // namespace pointhaptics
