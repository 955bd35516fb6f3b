#include "ClippedCloud.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

namespace pointhaptics
{
namespace
{

constexpr std::size_t kNumbers = 6;

vtkSmartPointer<vtkAbstractArray> picked(vtkAbstractArray* array, vtkIdList* ids)
{
  auto kept = vtkSmartPointer<vtkAbstractArray>::Take(array->NewInstance());
  kept->SetName(array->GetName());
  kept->SetNumberOfComponents(array->GetNumberOfComponents());
  kept->CopyComponentNames(array);
  kept->SetNumberOfTuples(ids->GetNumberOfIds());
  array->GetTuples(ids, kept);
  return kept;
}

} // namespace

std::optional<Bounds> clipBox(const std::vector<double>& clip)
{
  if (clip.size() != kNumbers)
  {
    return std::nullopt;
  }
  return Bounds{ { clip[0], clip[2], clip[4] }, { clip[1], clip[3], clip[5] } };
}

std::vector<double> clipNumbers(const Bounds& box)
{
  return { box.minimum.x, box.maximum.x, box.minimum.y, box.maximum.y, box.minimum.z, box.maximum.z };
}

bool isWithin(const Bounds& box, const Vec3& place)
{
  return place.x >= box.minimum.x && place.x <= box.maximum.x && place.y >= box.minimum.y &&
    place.y <= box.maximum.y && place.z >= box.minimum.z && place.z <= box.maximum.z;
}

vtkSmartPointer<vtkPolyData> clippedCloud(vtkPolyData* cloud, const std::optional<Bounds>& box)
{
  const vtkIdType count = cloud->GetNumberOfPoints();
  vtkNew<vtkIdList> kept;
  for (vtkIdType i = 0; box && i < count; ++i)
  {
    Vec3 place;
    cloud->GetPoint(i, &place.x);
    if (isWithin(*box, place))
    {
      kept->InsertNextId(i);
    }
  }
  if (!box || kept->GetNumberOfIds() == count)
  {
    return cloud;
  }
  auto result = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataType(cloud->GetPoints()->GetDataType());
  cloud->GetPoints()->GetPoints(kept, points);
  result->SetPoints(points);
  result->GetFieldData()->ShallowCopy(cloud->GetFieldData());
  vtkPointData* data = cloud->GetPointData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = data->GetAbstractArray(i);
    const int index = result->GetPointData()->AddArray(picked(array, kept));
    const int attribute = data->IsArrayAnAttribute(i);
    if (attribute >= 0)
    {
      result->GetPointData()->SetActiveAttribute(index, attribute);
    }
  }
  return result;
}

} // namespace pointhaptics
