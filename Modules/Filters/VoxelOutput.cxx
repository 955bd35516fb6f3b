#include "VoxelOutput.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"

#include <algorithm>

namespace pointhaptics
{

vtkSmartPointer<vtkPoints> makePoints(
  const VoxelResampler& engine, int level, bool singlePrecision, const Executor& executor)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataType(singlePrecision ? VTK_FLOAT : VTK_DOUBLE);
  points->SetNumberOfPoints(vtkIdType(engine.size(level)));
  if (singlePrecision)
  {
    engine.copyMeans(level, vtkFloatArray::FastDownCast(points->GetData())->GetPointer(0), executor);
  }
  else
  {
    engine.copyMeans(level, vtkDoubleArray::FastDownCast(points->GetData())->GetPointer(0), executor);
  }
  return points;
}

vtkSmartPointer<vtkIdTypeArray> makeCounts(const VoxelResampler& engine, int level, const Executor& executor)
{
  static_assert(sizeof(vtkIdType) == sizeof(std::int64_t), "VTK must be built with 64-bit ids");
  auto counts = vtkSmartPointer<vtkIdTypeArray>::New();
  counts->SetName("VoxelPointCount");
  counts->SetNumberOfValues(vtkIdType(engine.size(level)));
  engine.copyCounts(level, reinterpret_cast<std::int64_t*>(counts->GetPointer(0)), executor);
  return counts;
}

vtkSmartPointer<vtkDoubleArray> makeCovariances(
  const VoxelResampler& engine, int level, const Executor& executor)
{
  static_assert(sizeof(SymMat3) == 6 * sizeof(double), "six numbers, xx yy zz xy yz xz");
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName("VoxelCovariance");
  array->SetNumberOfComponents(6);
  const char* names[6] = { "XX", "YY", "ZZ", "XY", "YZ", "XZ" };
  for (int c = 0; c < 6; ++c)
  {
    array->SetComponentName(c, names[c]);
  }
  array->SetNumberOfTuples(vtkIdType(engine.size(level)));
  engine.copyCovariances(level, reinterpret_cast<SymMat3*>(array->GetPointer(0)), executor);
  return array;
}

namespace
{

void addField(vtkFieldData* field, const char* name, const double* values, int count)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(count);
  array->SetNumberOfTuples(1);
  array->SetTypedTuple(0, values);
  field->AddArray(array);
}

}

void addLattice(const Lattice& lattice, const AffineTransform& transform, vtkFieldData* field)
{
  addField(field, "LatticeOrigin", &lattice.origin.x, 3);
  addField(field, "LatticeSpacing", &lattice.spacing.x, 3);
  vtkNew<vtkIntArray> dimensions;
  dimensions->SetName("LatticeDimensions");
  dimensions->SetNumberOfComponents(3);
  dimensions->SetNumberOfTuples(1);
  for (int axis = 0; axis < 3; ++axis)
  {
    dimensions->SetValue(axis, int(lattice.dimensions[std::size_t(axis)]));
  }
  field->AddArray(dimensions);
  double matrix[16] = { 0 };
  std::copy(&transform.m[0][0], &transform.m[0][0] + 12, matrix);
  matrix[15] = 1.0;
  addField(field, "ModelToWorkspace", matrix, 16);
}

} // namespace pointhaptics
