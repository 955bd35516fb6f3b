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

class vtkAbstractArray;
class vtkAbstractTransform;
class vtkDataArray;
class vtkDataSetAttributes;
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

/// An array without tuples, of @p type, with the name, the components, the information and the lookup table
/// of @p array.
vtkSmartPointer<vtkAbstractArray> emptyLike(vtkAbstractArray* array, int type);
/// Bit n: @p array is the active one of vtkDataSetAttributes::AttributeTypes n. It may be that of several.
int rolesOf(vtkDataSetAttributes* data, vtkAbstractArray* array);
/// Adds @p array, as the active one of these types.
void addWithRoles(vtkDataSetAttributes* data, vtkAbstractArray* array, int roles);
/// Core's type of the numbers of @p array. @pre they are no bits.
ScalarType scalarTypeOf(vtkDataArray* array);
/// The matrix of a linear transform; null gives the identity. @return false for a transform that is not
/// affine.
bool affineFromTransform(vtkAbstractTransform* transform, AffineTransform& result);
/// Null gives the identity. @return empty, or why @p transform is of no use.
std::string readTransform(vtkAbstractTransform* transform, AffineTransform& result);
/// Gets @p count values of a field array, tuple by tuple. False: @p cloud has no such array, or fewer values.
bool fieldValues(vtkPolyData* cloud, const char* name, int count, double* values);
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
