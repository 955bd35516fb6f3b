/// @file
/// Averages point arrays voxel by voxel.
#pragma once

#include "Core/AffineTransform.h"
#include "Core/Executor.h"
#include "Core/VoxelMean.h"

#include "vtkSmartPointer.h"

class vtkDataArray;

namespace pointhaptics
{

enum class AttributeKind
{
  Mean,     ///< Averaged in double, integers rounded to nearest.
  Normal,   ///< Turned with the transform, averaged, re-normalised.
  Category, ///< The value most points have, component by component; the smallest on a tie.
};

/// One tuple per active voxel, of the type, name and components of @p input.
vtkSmartPointer<vtkDataArray> voxelAttribute(vtkDataArray* input, AttributeKind kind,
  const VoxelMeans& voxels, const AffineTransform& transform, const Executor& executor);

} // namespace pointhaptics
