/// @file
/// The point arrays of a cloud that have values in voxels, and those values.
#pragma once

#include "OutputMemory.h"

#include "Core/Base/Executor.h"
#include "Core/Resample/AttributeView.h"
#include "Core/Resample/VoxelMeanSettings.h"
#include "Core/Resample/VoxelResampler.h"

#include "vtkSmartPointer.h"

#include <cstddef>
#include <string>
#include <vector>

class vtkDataArray;
class vtkPointSet;

namespace pointhaptics
{

/// The array of KeepOriginalPointIds.
constexpr const char* kOriginalPointIds = "vtkOriginalPointIds";

/// A point array of the input, and its values in voxels.
struct VoxelAttribute
{
  vtkSmartPointer<vtkDataArray> array;
  AttributeStatistic statistic = AttributeStatistic::Mean;
  int roles = 0; ///< As rolesOf() says.
  bool isNormal = false;
  vtkSmartPointer<vtkDataArray> plain = nullptr; ///< The array as tuples in memory, after request().

  /// The values as the resampler takes them. Copies the array if its memory is not plain tuples of numbers.
  AttributeRequest request();
  /// Adds the values to @p wanted, whose representative is set.
  void addTo(VoxelRequest& wanted);
  /// The values of the voxels of @p engine, which has run @p request, in the type of the input: the tuples of
  /// points where a representative is a point of the input, else those of attribute @p i.
  vtkSmartPointer<vtkDataArray> reduced(const VoxelResampler& engine, const VoxelRequest& request,
    std::size_t i, OutputMemory& memory, const Executor& executor) const;
};

/// Arrays of @p input that have values in voxels, in its order; not identifiers, ghost flags and results of
/// an earlier resampling.
/// @p dropped: a sentence for each array that has no value in voxels.
std::vector<VoxelAttribute> voxelArrays(
  vtkPointSet* input, const VoxelMeanSettings& settings, std::vector<std::string>& dropped);

} // namespace pointhaptics
