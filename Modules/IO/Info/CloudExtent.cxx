#include "IO/Info/CloudExtent.h"

#include "Core/Base/Boxes.h"

#include <vtkPolyData.h>

namespace pointhaptics
{

CloudExtent extentOf(vtkPolyData* cloud, const AffineTransform& transform)
{
  CloudExtent extent;
  Vec3 p;
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    cloud->GetPoint(i, &p.x);
    if (isFinite(p))
    {
      ++extent.finite;
      if (isAtZero(p))
      {
        ++extent.atZero;
      }
      else
      {
        extent.returned.include(transform.apply(p));
      }
    }
  }
  extent.invalid = cloud->GetNumberOfPoints() - extent.finite;
  extent.all = extent.returned;
  if (extent.atZero > 0)
  {
    extent.all.include(transform.apply(Vec3()));
  }
  if (areNoReturns(extent.atZero, extent.finite))
  {
    extent.noReturns = extent.atZero;
  }
  else
  {
    extent.returned = extent.all;
  }
  return extent;
}

} // namespace pointhaptics
