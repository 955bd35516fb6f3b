/// @file
/// A point array of the input, and the array that it becomes.
#pragma once

#include "ArrayPool.h"

#include "Core/Base/AffineTransform.h"
#include "Core/Base/Executor.h"
#include "Core/Resample/AttributeView.h"

#include "vtkSmartPointer.h"

#include <cstdint>
#include <optional>
#include <vector>

class vtkDataArray;

namespace pointhaptics
{

/// Properties of an input array, independent of which points are averaged: valid until its values change.
struct AttributeValues
{
  std::optional<AttributeRange> range; ///< For means, once it was looked for.
  vtkSmartPointer<vtkDataArray> copy; ///< Plain tuples in memory, where the input is something else; or null.
};

/// An array of the input and what it is reduced to.
class VoxelAttribute
{
public:
  /// Keeps a reference to @p input; if its memory is not plain tuples of numbers, it is copied first. @p
  /// known: values() of an earlier object of the same input and statistic, or null.
  VoxelAttribute(vtkDataArray* input, AttributeStatistic statistic, const AttributeValues* known = nullptr);
  /// Finds the range once, for many requests: without it each looks for it.
  void findRange(const Executor& executor);
  const AttributeValues& values() const { return values_; }

  /// For the resampler, where no point of the input stands for a voxel.
  AttributeRequest request() const { return { view_, statistic_, values_.range }; }
  const AttributeView& view() const { return view_; }
  /// An empty array of the name, components, information and lookup table of the input, whose numbers are as
  /// the resampler gives them.
  vtkSmartPointer<vtkDataArray> emptyArray() const;
  /// Returns @p plain in the type of the input.
  vtkSmartPointer<vtkDataArray> inOwnType(vtkSmartPointer<vtkDataArray> plain) const;
  /// The tuples of the @p points, which stand for the voxels.
  vtkSmartPointer<vtkDataArray> chosen(
    const std::vector<std::int64_t>& points, ArrayPool& pool, const Executor& executor) const;

private:
  vtkSmartPointer<vtkDataArray> input_; ///< The array as given.
  vtkSmartPointer<vtkDataArray> plain_; ///< The input as tuples in memory.
  AttributeStatistic statistic_;
  AttributeView view_; ///< View of plain_.
  AttributeValues values_;
};

/// Turns normals by the inverse transpose of @p transform and makes them unit vectors; those in integers keep
/// their length.
void turnNormals(vtkDataArray* normals, const AffineTransform& transform);

} // namespace pointhaptics
