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

class vtkCellArray;
class vtkDataArray;
class vtkDoubleArray;
class vtkFieldData;
class vtkIdTypeArray;
class vtkPoints;

namespace pointhaptics
{

/// Puts the engine's results where an array can take them.
class OutputMemory : public ResultMemory
{
public:
  explicit OutputMemory(ArrayPool& pool)
    : pool_(pool)
  {
  }
  ~OutputMemory() override { release(); }
  OutputMemory(const OutputMemory&) = delete;
  OutputMemory& operator=(const OutputMemory&) = delete;

  void* reserve(Part part, std::size_t bytes) override;
  /// Gives @p array the memory of a part, or where there is none new memory, for so many tuples.
  void take(Part part, vtkDataArray* array, std::int64_t tuples);
  /// Lets go of what was not taken.
  void release();

private:
  static constexpr int kParts = 3;
  ArrayPool& pool_;
  void* memory_[kParts] = {};
};

// Level 0 takes what the engine was given, @p memory.

/// @p singlePrecision as the engine was asked for.
vtkSmartPointer<vtkPoints> makePoints(const VoxelResampler& engine, int level, bool singlePrecision,
  OutputMemory& memory, const Executor& executor);
/// @p count vertex cells, one per point, in order.
vtkSmartPointer<vtkCellArray> makeVertices(vtkIdType count, ArrayPool& pool, const Executor& executor);
/// The array VoxelPointCount.
vtkSmartPointer<vtkIdTypeArray> makeCounts(
  const VoxelResampler& engine, int level, OutputMemory& memory, const Executor& executor);
/// The array VoxelCovariance.
vtkSmartPointer<vtkDoubleArray> makeCovariances(
  const VoxelResampler& engine, int level, OutputMemory& memory, const Executor& executor);
/// What the lattice and the transform were: a scene is built from it.
void addLattice(const Lattice& lattice, const AffineTransform& transform, vtkFieldData* field);

} // namespace pointhaptics
