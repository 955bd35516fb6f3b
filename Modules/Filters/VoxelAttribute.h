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

enum class AttributeKind
{
  Mean,     ///< Averaged, integers rounded to nearest.
  Normal,   ///< Averaged, turned with the transform, re-normalised.
  Category, ///< The value most points have, component by component; the smallest on a tie.
  Median,   ///< Component by component, of an even number the lower middle one.
  Chosen,   ///< Value of the point that represents the voxel.
};

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
  /// known: values() of an earlier object of the same input and kind, or null.
  VoxelAttribute(vtkDataArray* input, AttributeKind kind, const AttributeValues* known = nullptr);
  /// Finds the range once, for many requests: without it each looks for it.
  void findRange(const Executor& executor);
  const AttributeValues& values() const { return values_; }

  /// For the resampler. @pre it is not AttributeKind::Chosen.
  AttributeRequest request() const;
  const AttributeView& view() const { return view_; }
  /// An empty array of the name, components, information and lookup table of the input, whose numbers are as
  /// the resampler gives them.
  vtkSmartPointer<vtkDataArray> emptyArray() const;
  /// Returns @p plain in the type of the input.
  vtkSmartPointer<vtkDataArray> inOwnType(vtkSmartPointer<vtkDataArray> plain) const;
  /// The tuples of the @p points, for AttributeKind::Chosen.
  vtkSmartPointer<vtkDataArray> chosen(
    const std::vector<std::int64_t>& points, ArrayPool& pool, const Executor& executor) const;

private:
  vtkSmartPointer<vtkDataArray> input_; ///< The array as given.
  vtkSmartPointer<vtkDataArray> plain_; ///< The input as tuples in memory.
  AttributeKind kind_;
  AttributeView view_; ///< View of plain_.
  AttributeValues values_;
};

/// Turns normals by the inverse transpose of @p transform and makes them unit vectors; those in integers keep
/// their length.
void turnNormals(vtkDataArray* normals, const AffineTransform& transform);

} // namespace pointhaptics
