#include "LatticeChoice.h"

#include "vtkVoxelMeanResampler.h"

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

namespace pointhaptics
{
namespace
{
constexpr int kUsual = 300;
constexpr int kFinest = 4 * kUsual;
/// So many means show and feel a shape well.
constexpr vtkIdType kEnough = 30000;
/// Finer voxels that give less than so many times the means only repeat the points.
constexpr double kGain = 1.25;

struct Asker
{
  vtkVoxelMeanResampler* resampler;
  const std::function<bool()>& goesOn;
};

/// 0 where that was stopped.
vtkIdType numberOfMeans(vtkVoxelMeanResampler* resampler, int dimension)
{
  resampler->SetDimensions(dimension, dimension, dimension);
  resampler->Update();
  return resampler->GetOutput()->GetNumberOfPoints();
}
} // namespace

int chooseLatticeDimension(vtkPolyData* cloud, const std::function<bool()>& goesOn)
{
  vtkNew<vtkPolyData> points;
  points->SetPoints(cloud->GetPoints());
  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(points);
  Asker asker{ resampler, goesOn };
  vtkNew<vtkCallbackCommand> ask;
  ask->SetClientData(&asker);
  ask->SetCallback(
    [](vtkObject*, unsigned long, void* client, void*)
    {
      const auto& self = *static_cast<Asker*>(client);
      self.resampler->SetAbortExecute(self.goesOn() ? 0 : 1);
    });
  resampler->AddObserver(vtkCommand::ProgressEvent, ask);
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

} // namespace pointhaptics
