#include "PolyDataAccess.h"

#include "vtkAbstractTransform.h"
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
  for (int r = 0; r < 3; ++r)
  {
    for (int c = 0; c < 4; ++c)
    {
      result.m[r][c] = matrix->GetElement(r, c) / w;
    }
  }
  return true;
}

void setElements(vtkMatrix4x4* matrix, const AffineTransform& transform)
{
  matrix->Identity();
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      matrix->SetElement(row, column, transform.m[row][column]);
    }
  }
}

AffineTransform transformOf(const vtkMatrix4x4* matrix)
{
  AffineTransform transform;
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 4; ++column)
    {
      transform.m[row][column] = matrix->GetElement(row, column);
    }
  }
  return transform;
}

std::optional<Lattice> latticeOf(vtkPolyData* means)
{
  vtkFieldData* fields = means->GetFieldData();
  vtkDataArray* origin = fields->GetArray("LatticeOrigin");
  vtkDataArray* spacing = fields->GetArray("LatticeSpacing");
  vtkDataArray* dimensions = fields->GetArray("LatticeDimensions");
  if (!origin || !spacing || !dimensions)
  {
    return std::nullopt;
  }
  Lattice lattice;
  for (int axis = 0; axis < 3; ++axis)
  {
    lattice.origin[axis] = origin->GetComponent(0, axis);
    lattice.spacing[axis] = spacing->GetComponent(0, axis);
    lattice.dimensions[std::size_t(axis)] = std::int64_t(dimensions->GetComponent(0, axis));
  }
  return lattice;
}

namespace
{

std::string latticeText(const LatticeSettings& lattice)
{
  std::ostringstream text;
  if (lattice.voxelSize != 0.0)
  {
    text << "Lattice of voxel size " << lattice.voxelSize;
  }
  else
  {
    const std::array<std::int64_t, 3>& n = lattice.dimensions;
    text << "Lattice of " << n[0] << " x " << n[1] << " x " << n[2] << " voxels";
  }
  return text.str();
}

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
  return latticeText(settings) + ": " + message(status) + ".";
}

} // namespace pointhaptics
