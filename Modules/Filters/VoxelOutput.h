/// @file
/// From the resampler's results to VTK's arrays.
#pragma once

#include "ArrayPool.h"

#include "Core/Base/AffineTransform.h"
#include "Core/Base/Executor.h"
#include "Core/Resample/VoxelResampler.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

class vtkCellArray;
class vtkDataArray;
class vtkPointData;
class vtkPointSet;
class vtkPolyData;

namespace pointhaptics
{

class VoxelAttribute;
struct VoxelArray;

/// @p count vertex cells, one per point, in order.
vtkSmartPointer<vtkCellArray> makeVertices(vtkIdType count, ArrayPool& pool, const Executor& executor);
/// Makes @p output the points of @p input with the array VoxelIndex: what @p rows says of the voxel of each,
/// -1 without a voxel; empty: its number.
void fillVoxelIndex(vtkPolyData* output, vtkPointSet* input, const std::vector<std::int64_t>& voxels,
  const std::vector<std::int64_t>& rows, ArrayPool& pool, const Executor& executor);

/// Fills outputs with what the engine made. Their field data is already that of the input; poses in it move
/// with the points.
struct OutputFiller
{
  const VoxelResampler& engine;
  const AffineTransform& transform;
  ArrayPool& pool;
  const Executor& executor;
  bool singlePrecision = false; ///< Setting of the request.
  bool covariances = false;
  vtkIdType minimumPoints = 1;                       ///< Voxels of fewer are left out.
  std::optional<std::vector<std::int64_t>> pointIds; ///< The array of KeepOriginalPointIds, if there is one.

  /// Adds the arrays of the points' attributes. @return false where the work was aborted.
  using AddArrays = std::function<bool(vtkPointData* data)>;
  /// @p kept: the voxels that stay, where a minimum above 1 may leave some out. @return false where @p
  /// addArrays did; the output is not complete then.
  bool fill(
    vtkPolyData* output, const AddArrays& addArrays, std::optional<std::vector<std::int64_t>>& kept) const;
  /// The engine's result for @p found: the tuples of points where a representative is a point of the input,
  /// else those of attribute @p i of @p request.
  void addReduced(vtkPointData* data, std::size_t i, const VoxelAttribute& attribute, const VoxelArray& found,
    const VoxelRequest& request) const;
};

} // namespace pointhaptics
