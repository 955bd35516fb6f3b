#include "CloudParts.h"

#include "vtkSplatMapper.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIdList.h"
#include "vtkMapper.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

namespace pointhaptics
{
namespace
{

/// The array by which @p mapper colours the points of @p cloud; null: none.
vtkDataArray* colorArray(vtkPolyData* cloud, vtkMapper* mapper)
{
  if (!mapper->GetScalarVisibility())
  {
    return nullptr;
  }
  return mapper->GetScalarMode() == VTK_SCALAR_MODE_USE_POINT_FIELD_DATA
    ? cloud->GetPointData()->GetArray(mapper->GetArrayName())
    : cloud->GetPointData()->GetScalars();
}

/// Adds the tuples @p ids of @p array to @p part.
int addTuples(vtkDataArray* array, vtkIdList* ids, vtkPolyData* part)
{
  const auto some = vtkSmartPointer<vtkDataArray>::Take(array->NewInstance());
  some->SetName(array->GetName());
  some->SetNumberOfComponents(array->GetNumberOfComponents());
  some->SetNumberOfTuples(ids->GetNumberOfIds());
  array->GetTuples(ids, some);
  return part->GetPointData()->AddArray(some);
}

} // namespace

PointView viewOf(vtkPolyData* cloud, std::vector<Vec3>& copy)
{
  vtkDataArray* data = cloud->GetPoints()->GetData();
  if (auto* floats = vtkFloatArray::SafeDownCast(data))
  {
    return { floats->GetPointer(0), cloud->GetNumberOfPoints() };
  }
  if (auto* doubles = vtkDoubleArray::SafeDownCast(data))
  {
    return { doubles->GetPointer(0), cloud->GetNumberOfPoints() };
  }
  copy.resize(std::size_t(cloud->GetNumberOfPoints()));
  for (std::size_t i = 0; i < copy.size(); ++i)
  {
    cloud->GetPoint(vtkIdType(i), &copy[i].x);
  }
  return { copy.data(), std::int64_t(copy.size()) };
}

double quantileOfPositive(vtkDataArray* array, std::size_t tenths)
{
  std::vector<double> values;
  const vtkIdType step = 1 + array->GetNumberOfTuples() / 10000;
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); i += step)
  {
    const double value = array->GetComponent(i, 0);
    if (value > 0.0 && std::isfinite(value))
    {
      values.push_back(value);
    }
  }
  if (values.empty())
  {
    return 0.0;
  }
  const auto place = values.begin() + std::ptrdiff_t(tenths * values.size() / 10);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

bool drawsInOrder(vtkPolyData* cloud)
{
  if (cloud->GetNumberOfCells() == 0)
  {
    return true;
  }
  vtkCellArray* vertices = cloud->GetVerts();
  vtkIdType next = 0;
  vtkIdType size = 0;
  const vtkIdType* points = nullptr;
  for (vtkIdType cell = 0; vertices && cell < vertices->GetNumberOfCells(); ++cell)
  {
    vertices->GetCellAtId(cell, size, points);
    for (vtkIdType i = 0; i < size; ++i, ++next)
    {
      if (points[i] != next)
      {
        return false;
      }
    }
  }
  return next == cloud->GetNumberOfPoints() && cloud->GetNumberOfCells() == vertices->GetNumberOfCells();
}

void colorAlike(vtkMapper* from, vtkMapper* to)
{
  to->SetLookupTable(from->GetLookupTable());
  to->SetUseLookupTableScalarRange(from->GetUseLookupTableScalarRange());
  to->SetScalarRange(from->GetScalarRange());
  to->SetScalarVisibility(from->GetScalarVisibility());
  to->SetScalarMode(from->GetScalarMode());
  to->SetColorMode(from->GetColorMode());
  to->SetInterpolateScalarsBeforeMapping(from->GetInterpolateScalarsBeforeMapping());
  if (from->GetArrayName() && from->GetScalarMode() == VTK_SCALAR_MODE_USE_POINT_FIELD_DATA)
  {
    to->SelectColorArray(from->GetArrayName());
    to->SetArrayComponent(from->GetArrayComponent());
  }
}

vtkSmartPointer<vtkPolyData> pickPoints(vtkPolyData* cloud, vtkSplatMapper* mapper, vtkIdList* ids)
{
  auto part = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataType(cloud->GetPoints()->GetDataType());
  cloud->GetPoints()->GetPoints(ids, points);
  part->SetPoints(points);
  if (vtkDataArray* colors = colorArray(cloud, mapper))
  {
    const int index = addTuples(colors, ids, part);
    if (colors == cloud->GetPointData()->GetScalars())
    {
      part->GetPointData()->SetActiveAttribute(index, vtkDataSetAttributes::SCALARS);
    }
  }
  const std::string names[] = { mapper->Settings().sizeArray,
    mapper->Settings().ambientLight ? mapper->Settings().normalArray : std::string() };
  for (const std::string& name : names)
  {
    vtkDataArray* array = name.empty() ? nullptr : cloud->GetPointData()->GetArray(name.c_str());
    if (array && !part->GetPointData()->HasArray(name.c_str()))
    {
      addTuples(array, ids, part);
    }
  }
  if (cloud->GetNumberOfCells() > 0) // splats without cells round otherwise
  {
    vtkNew<vtkCellArray> vertices;
    vertices->InsertNextCell(static_cast<int>(ids->GetNumberOfIds()));
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
    {
      vertices->InsertCellPoint(i);
    }
    part->SetVerts(vertices);
  }
  return part;
}

} // namespace pointhaptics
