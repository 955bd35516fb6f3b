#include "LatticeChoice.h"

#include "vtkVoxelMeanResampler.h"

#include <vtkNew.h>
#include <vtkPolyData.h>

namespace pointhaptics
{
namespace app
{
namespace
{
constexpr int kUsual = 300;
constexpr int kFinest = 4 * kUsual;
/// So many means show and feel a shape well.
constexpr vtkIdType kEnough = 30000;
/// Finer voxels that give less than so many times the means only repeat the points.
constexpr double kGain = 1.25;

vtkIdType numberOfMeans(vtkVoxelMeanResampler* resampler, int dimension)
{
  resampler->SetDimensions(dimension, dimension, dimension);
  resampler->Update();
  return resampler->GetOutput()->GetNumberOfPoints();
}
} // namespace

int chooseLatticeDimension(vtkPolyData* cloud)
{
  vtkNew<vtkPolyData> points;
  points->SetPoints(cloud->GetPoints());
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(points);
  int dimension = kUsual;
  vtkIdType means = numberOfMeans(resampler, dimension);
  while (dimension < kFinest && means > 0 && means < kEnough)
  {
    const vtkIdType finer = numberOfMeans(resampler, 2 * dimension);
    if (double(finer) < kGain * double(means))
    {
      break;
    }
    dimension *= 2;
    means = finer;
  }
  return dimension;
}

} // namespace app
} // namespace pointhaptics
