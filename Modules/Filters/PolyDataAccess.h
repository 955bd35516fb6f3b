/// @file
/// Between VTK's data objects and Core's views.
#pragma once

#include "Core/Base/AffineTransform.h"
#include "Core/Base/Lattice.h"
#include "Core/Base/PointView.h"
#include "Core/Base/ScalarType.h"
#include "Core/Base/Status.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <optional>
#include <string>

class vtkAbstractTransform;
class vtkDataArray;
class vtkMatrix4x4;
class vtkPoints;
class vtkPolyData;

namespace pointhaptics
{

/// The coordinates of a vtkPoints as a view; anything but plain float or double arrays is copied to double
/// first.
class PointAccess
{
public:
  explicit PointAccess(vtkPoints* points);
  const PointView& view() const { return view_; }

private:
  vtkSmartPointer<vtkDataArray> keep_;
  PointView view_;
};

/// Core's type of the numbers of @p array. @pre they are no bits.
ScalarType scalarTypeOf(vtkDataArray* array);
/// The matrix of a linear transform; null gives the identity. @return false for a transform that is not
/// affine.
bool affineFromTransform(vtkAbstractTransform* transform, AffineTransform& result);
/// Null gives the identity. @return empty, or why @p transform is of no use.
std::string readTransform(vtkAbstractTransform* transform, AffineTransform& result);
/// The lattice that vtkVoxelMeanResampler says in the field data of its output; nothing where it says none.
std::optional<Lattice> latticeOf(vtkPolyData* means);
/// Why makeLattice() gave @p status for @p settings.
std::string latticeProblem(const LatticeSettings& settings, Status status);

///@{
/// The first three rows of a matrix whose fourth is 0, 0, 0, 1.
void setElements(vtkMatrix4x4* matrix, const AffineTransform& transform);
AffineTransform transformOf(const vtkMatrix4x4* matrix);
///@}

} // namespace pointhaptics
