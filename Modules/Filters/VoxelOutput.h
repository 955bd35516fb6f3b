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

/// Lets the engine write its results in memory that VTK arrays then take over.
class ArrayAllocator : public OutputAllocator
{
public:
  explicit ArrayAllocator(ArrayPool& pool)
    : pool_(pool)
  {
  }
  ~ArrayAllocator() override { release(); }
  ArrayAllocator(const ArrayAllocator&) = delete;
  ArrayAllocator& operator=(const ArrayAllocator&) = delete;

  void* allocate(std::size_t part, std::size_t bytes) override;
  /// Moves the memory of a part into @p array, of so many tuples; where there is none, allocates it.
  void take(std::size_t part, vtkDataArray* array, std::int64_t tuples);
  /// Frees the memory that no array took.
  void release();

private:
  void*& of(std::size_t part);

  ArrayPool& pool_;
  std::vector<void*> memory_; ///< Memory of each part, or null.
};

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
  ArrayAllocator& allocator;
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
