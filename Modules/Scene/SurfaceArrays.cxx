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
    const auto perMetre =
      static_cast<float>(1.0 / std::cbrt(std::abs(scene.modelToWorkspace().determinant())));
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
