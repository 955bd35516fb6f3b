#include "SurfaceArrays.h"

#include "PolyDataAccess.h"
#include "SmpExecutor.h"

#include "Haptics/Contact/SurfaceSamples.h"

#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <cmath>

namespace pointhaptics
{
namespace
{

/// Length in the workspace of a unit of the cloud.
double scaleOf(const AffineTransform& transform)
{
  const auto& m = transform.m;
  const Vec3 x{ m[0][0], m[1][0], m[2][0] };
  const Vec3 y{ m[0][1], m[1][1], m[2][1] };
  const Vec3 z{ m[0][2], m[1][2], m[2][2] };
  return std::cbrt(std::abs(dot(x, cross(y, z))));
}

} // namespace

void addSurfaceArrays(vtkPolyData* means, const HapticScene& scene, bool residuals, bool normals)
{
  if (!(residuals || normals) || means->GetNumberOfPoints() == 0)
  {
    return;
  }
  const PointAccess access(means->GetPoints());
  vtkNew<vtkFloatArray> distances;
  distances->SetName(kResidualArrayName);
  distances->SetNumberOfTuples(means->GetNumberOfPoints());
  vtkNew<vtkFloatArray> directions;
  directions->SetName(kSurfaceNormalArrayName);
  directions->SetNumberOfComponents(3);
  directions->SetNumberOfTuples(means->GetNumberOfPoints());
  sampleSurface(scene, access.view(), SmpExecutor(), distances->GetPointer(0), directions->GetPointer(0));
  if (residuals)
  {
    const auto perMetre = static_cast<float>(1.0 / scaleOf(scene.modelToWorkspace()));
    for (vtkIdType i = 0; i < distances->GetNumberOfTuples(); ++i)
    {
      distances->SetValue(i, perMetre * distances->GetValue(i));
    }
    means->GetPointData()->AddArray(distances);
  }
  if (normals)
  {
    means->GetPointData()->AddArray(directions);
  }
}

} // namespace pointhaptics
