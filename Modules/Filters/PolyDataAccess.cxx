#include "PolyDataAccess.h"

#include "vtkAbstractArray.h"
#include "vtkAbstractTransform.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkHomogeneousTransform.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <sstream>

namespace pointhaptics
{

PointAccess::PointAccess(vtkPoints* points)
{
  if (!points || points->GetNumberOfPoints() == 0)
  {
    return;
  }
  keep_ = points->GetData();
  const std::int64_t count = points->GetNumberOfPoints();
  if (auto* floats = vtkFloatArray::FastDownCast(keep_))
  {
    view_ = PointView(floats->GetPointer(0), count);
    return;
  }
  if (!vtkDoubleArray::FastDownCast(keep_))
  {
    vtkNew<vtkDoubleArray> copy;
    copy->DeepCopy(points->GetData());
    keep_ = copy;
  }
  view_ = PointView(vtkDoubleArray::FastDownCast(keep_)->GetPointer(0), count);
}

vtkSmartPointer<vtkAbstractArray> emptyLike(vtkAbstractArray* array, int type)
{
  auto empty = vtkSmartPointer<vtkAbstractArray>::Take(vtkAbstractArray::CreateArray(type));
  empty->SetName(array->GetName());
  empty->SetNumberOfComponents(array->GetNumberOfComponents());
  empty->CopyComponentNames(array);
  if (array->HasInformation())
  {
    empty->CopyInformation(array->GetInformation());
  }
  if (auto* numbers = vtkDataArray::SafeDownCast(array))
  {
    vtkDataArray::SafeDownCast(empty)->SetLookupTable(numbers->GetLookupTable());
  }
  return empty;
}

int rolesOf(vtkDataSetAttributes* data, vtkAbstractArray* array)
{
  int roles = 0;
  for (int type = 0; type < vtkDataSetAttributes::NUM_ATTRIBUTES; ++type)
  {
    roles |= int(data->GetAbstractAttribute(type) == array) << type;
  }
  return roles;
}

void addWithRoles(vtkDataSetAttributes* data, vtkAbstractArray* array, int roles)
{
  const int index = data->AddArray(array);
  for (int type = 0; type < vtkDataSetAttributes::NUM_ATTRIBUTES; ++type)
  {
    if ((roles >> type & 1) != 0)
    {
      data->SetActiveAttribute(index, type);
    }
  }
}

ScalarType scalarTypeOf(vtkDataArray* array)
{
  const int type = array->GetDataType();
  if (type == VTK_FLOAT || type == VTK_DOUBLE)
  {
    return type == VTK_FLOAT ? ScalarType::Float : ScalarType::Double;
  }
  const bool isSigned = array->GetDataTypeMin() < 0.0;
  switch (array->GetDataTypeSize())
  {
    case 1:
      return isSigned ? ScalarType::Int8 : ScalarType::UInt8;
    case 2:
      return isSigned ? ScalarType::Int16 : ScalarType::UInt16;
    case 4:
      return isSigned ? ScalarType::Int32 : ScalarType::UInt32;
    default:
      return isSigned ? ScalarType::Int64 : ScalarType::UInt64;
  }
}

bool affineFromTransform(vtkAbstractTransform* transform, AffineTransform& result)
{
  result = AffineTransform();
  if (!transform)
  {
    return true;
  }
  auto* homogeneous = vtkHomogeneousTransform::SafeDownCast(transform);
  if (!homogeneous)
  {
    return false;
  }
  homogeneous->Update();
  const vtkMatrix4x4* matrix = homogeneous->GetMatrix();
  const double w = matrix->GetElement(3, 3);
  if (matrix->GetElement(3, 0) != 0.0 || matrix->GetElement(3, 1) != 0.0 || matrix->GetElement(3, 2) != 0.0 ||
    w == 0.0)
  {
    return false;
  }
  result = transformOf(matrix);
  std::for_each(result.m[0], result.m[0] + 12, [w](double& element) { element /= w; });
  return true;
}

void setElements(vtkMatrix4x4* matrix, const AffineTransform& transform)
{
  double rows[16] = {};
  std::copy_n(transform.m[0], 12, rows);
  rows[15] = 1.0;
  matrix->DeepCopy(rows);
}

AffineTransform transformOf(const vtkMatrix4x4* matrix)
{
  return AffineTransform::fromRows(matrix->Element[0]);
}

bool fieldValues(vtkPolyData* cloud, const char* name, int count, double* values)
{
  vtkDataArray* array = cloud->GetFieldData()->GetArray(name);
  if (!array || array->GetNumberOfValues() < count)
  {
    return false;
  }
  for (int i = 0; i < count; ++i)
  {
    const int components = array->GetNumberOfComponents();
    values[i] = array->GetComponent(i / components, i % components);
  }
  return true;
}

std::optional<Lattice> latticeOf(vtkPolyData* means)
{
  Lattice lattice;
  double n[3];
  if (!fieldValues(means, "LatticeOrigin", 3, &lattice.origin.x) ||
    !fieldValues(means, "LatticeSpacing", 3, &lattice.spacing.x) ||
    !fieldValues(means, "LatticeDimensions", 3, n))
  {
    return std::nullopt;
  }
  lattice.dimensions = { std::int64_t(n[0]), std::int64_t(n[1]), std::int64_t(n[2]) };
  return lattice;
}

namespace
{

/// Tells why a matrix is not affine: NaN times 0 is NaN, so one that holds NaN mostly is not.
bool holdsNonFinite(vtkAbstractTransform* transform)
{
  auto* homogeneous = vtkHomogeneousTransform::SafeDownCast(transform);
  const double* elements = homogeneous ? homogeneous->GetMatrix()->GetData() : nullptr;
  return elements && !std::all_of(elements, elements + 16, [](double e) { return std::isfinite(e); });
}

}

std::string readTransform(vtkAbstractTransform* transform, AffineTransform& result)
{
  const auto problem = [](Status status) { return std::string("SetTransform: ") + message(status) + "."; };
  if (!affineFromTransform(transform, result))
  {
    return holdsNonFinite(transform) ? problem(Status::NonFiniteTransform)
                                     : std::string("SetTransform: ") + transform->GetClassName() +
        " is not affine; use a vtkTransform or vtkMatrixToLinearTransform whose matrix has the last row 0, "
        "0, "
        "0, 1.";
  }
  const Status status = result.check();
  return status == Status::Ok ? std::string() : problem(status);
}

std::string latticeProblem(const LatticeSettings& settings, Status status)
{
  std::ostringstream text;
  const std::array<std::int64_t, 3>& n = settings.dimensions;
  settings.voxelSize != 0.0 ? text << "Lattice of voxel size " << settings.voxelSize
                            : text << "Lattice of " << n[0] << " x " << n[1] << " x " << n[2] << " voxels";
  text << ": " << message(status) << ".";
  return text.str();
}

} // namespace pointhaptics
