/// @file
/// From the resampler's results to VTK's arrays.
#pragma once

#include "OutputMemory.h"
#include "VoxelAttribute.h"

#include "Core/Base/Executor.h"
#include "Core/Resample/VoxelResampler.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstdint>
#include <optional>
#include <vector>

class vtkCellArray;
class vtkPointSet;
class vtkPolyData;

namespace pointhaptics
{

/// @p count vertex cells, one per point, in order.
vtkSmartPointer<vtkCellArray> makeVertices(vtkIdType count, const Executor& executor);
/// Makes @p output the points of @p input with the array VoxelIndex: what @p rows says of the voxel of each,
/// -1 without a voxel; empty: its number.
void fillVoxelIndex(vtkPolyData* output, vtkPointSet* input, const std::vector<std::int64_t>& voxels,
  const std::vector<std::int64_t>& rows, const Executor& executor);

/// Fills outputs with what the engine made.
struct OutputFiller
{
  const VoxelResampler& engine;
  const VoxelRequest& request; ///< The request that the engine has run.
  OutputMemory& memory;
  const Executor& executor;
  vtkIdType minimumPoints = 1;                    ///< Voxels of fewer are left out.
  const std::vector<std::int64_t>* ids = nullptr; ///< The array of KeepOriginalPointIds, if there is one.

  /// Fills @p output with points, the arrays of the @p attributes, and what describes the lattice.
  /// @p observer: hears of each attribute. @p kept: the voxels that stay, where a minimum above 1 may leave
  /// some out. @return false where the observer said so; the output is not complete then.
  bool fill(vtkPolyData* output, const std::vector<VoxelAttribute>& attributes, ProgressObserver* observer,
    std::optional<std::vector<std::int64_t>>& kept) const;
};

} // namespace pointhaptics
