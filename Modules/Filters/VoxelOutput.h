/// @file
/// From the resampler's results to VTK's arrays.
#pragma once

#include "ArrayPool.h"

#include "Core/Base/AffineTransform.h"
#include "Core/Base/Executor.h"
#include "Core/Base/Lattice.h"
#include "Core/Resample/VoxelResampler.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

class vtkCellArray;
class vtkDataArray;
class vtkDoubleArray;
class vtkFieldData;
class vtkIdTypeArray;
class vtkPointData;
class vtkPoints;
class vtkPolyData;

namespace pointhaptics
{

class VoxelAttribute;

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

// Memory comes from the @p allocator that the engine wrote to.

/// Makes points of the means. @p singlePrecision: that of the request.
vtkSmartPointer<vtkPoints> makePoints(
  const VoxelResampler& engine, bool singlePrecision, ArrayAllocator& allocator, const Executor& executor);
/// The engine's result for the array of @p attribute: the tuples of points where a representative is a point
/// of the input, else those of attribute @p i of @p request.
vtkSmartPointer<vtkDataArray> reducedArray(const VoxelResampler& engine, std::size_t i,
  const VoxelAttribute& attribute, bool isNormal, const VoxelRequest& request, ArrayPool& pool,
  ArrayAllocator& allocator, const Executor& executor);
/// @p count vertex cells, one per point, in order.
vtkSmartPointer<vtkCellArray> makeVertices(vtkIdType count, ArrayPool& pool, const Executor& executor);
/// The array VoxelPointCount.
vtkSmartPointer<vtkIdTypeArray> makeCounts(
  const VoxelResampler& engine, ArrayAllocator& allocator, const Executor& executor);
/// The array VoxelCovariance.
vtkSmartPointer<vtkDoubleArray> makeCovariances(
  const VoxelResampler& engine, ArrayAllocator& allocator, const Executor& executor);
/// An array of ids. @p numbers: what becomes of each id that is not negative; empty: they stay.
vtkSmartPointer<vtkIdTypeArray> makeIds(const std::vector<std::int64_t>& ids, const char* name,
  const std::vector<std::int64_t>& numbers, ArrayPool& pool, const Executor& executor);
/// Leaves out the points of @p cloud whose @p counts, one of its arrays, are below @p minimum. @return those
/// that stay; nothing for a minimum of 1, with which all do.
std::optional<std::vector<std::int64_t>> keepVoxels(
  vtkPolyData* cloud, vtkIdTypeArray* counts, vtkIdType minimum, ArrayPool& pool, const Executor& executor);
/// Records the lattice and the transform: a scene is built from them.
void addLattice(const Lattice& lattice, const AffineTransform& transform, vtkFieldData* field);
/// Adds @p array, as the active one of the @p roles of vtkDataSetAttributes::AttributeTypes.
void addArray(vtkPointData* data, vtkDataArray* array, const std::vector<int>& roles);

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
  using AddArrays = std::function<bool(vtkIdTypeArray* counts, vtkPointData* data)>;
  /// @p kept: of keepVoxels(). @return false where @p addArrays did; the output is not complete then.
  bool fill(
    vtkPolyData* output, const AddArrays& addArrays, std::optional<std::vector<std::int64_t>>& kept) const;
};

} // namespace pointhaptics
