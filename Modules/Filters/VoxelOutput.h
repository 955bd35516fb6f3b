/// @file
/// From the resampler's results to VTK's arrays.
#pragma once

#include "ArrayPool.h"

#include "Core/AffineTransform.h"
#include "Core/Executor.h"
#include "Core/Lattice.h"
#include "Core/VoxelResampler.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

class vtkCellArray;
class vtkDoubleArray;
class vtkFieldData;
class vtkIdTypeArray;
class vtkPoints;

namespace pointhaptics
{

/// @p singlePrecision as the engine was asked for.
vtkSmartPointer<vtkPoints> makePoints(
  const VoxelResampler& engine, int level, bool singlePrecision, ArrayPool& pool, const Executor& executor);
/// @p count vertex cells, one per point, in order.
vtkSmartPointer<vtkCellArray> makeVertices(vtkIdType count, ArrayPool& pool, const Executor& executor);
/// The array VoxelPointCount.
vtkSmartPointer<vtkIdTypeArray> makeCounts(
  const VoxelResampler& engine, int level, ArrayPool& pool, const Executor& executor);
/// The array VoxelCovariance.
vtkSmartPointer<vtkDoubleArray> makeCovariances(
  const VoxelResampler& engine, int level, ArrayPool& pool, const Executor& executor);
/// What the lattice and the transform were: a scene is built from it.
void addLattice(const Lattice& lattice, const AffineTransform& transform, vtkFieldData* field);

} // namespace pointhaptics
