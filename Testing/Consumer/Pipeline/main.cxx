// Resamples a sphere of points, computes the proxy radius and feels it: the installed package in a pipeline.
#include <HapticSceneBuilder.h>
#include <vtkInteractorStyleHaptic.h>
#include <vtkKernelBandwidthFilter.h>
#include <vtkPointCloudReader.h>
#include <vtkVoxelMeanResampler.h>

#include <Devices/SimulatedDevice.h>
#include <Haptics/Proxy.h>

#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <cmath>
#include <cstdio>

using namespace pointhaptics;

namespace
{
constexpr double kRadius = 0.025;

/// 100,000 points on a Fibonacci spiral; no cells, as in most scans.
void makeSphere(vtkPolyData* cloud)
{
  constexpr int kPoints = 100000;
  const double golden = 3.14159265358979323846 * (3.0 - std::sqrt(5.0));
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int i = 0; i < kPoints; ++i)
  {
    const double z = 1.0 - (2.0 * i + 1.0) / kPoints;
    const double ring = std::sqrt(1.0 - z * z);
    points->InsertNextPoint(
      kRadius * ring * std::cos(golden * i), kRadius * ring * std::sin(golden * i), kRadius * z);
  }
  cloud->SetPoints(points);
}
}

int main()
{
  vtkNew<vtkPolyData> cloud;
  makeSphere(cloud);

  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputData(cloud);
  resampler->SetVoxelSize(0.0005);
  resampler->ComputeCovarianceOn();
  vtkNew<vtkKernelBandwidthFilter> bandwidth;
  bandwidth->SetInputConnection(resampler->GetOutputPort());
  bandwidth->Update();
  vtkPolyData* const result = bandwidth->GetOutput();
  std::printf("%lld voxel means\n", static_cast<long long>(result->GetNumberOfPoints()));
  for (const char* name : { "VoxelPointCount", "VoxelCovariance", "Bandwidth", "ProxyRadius" })
  {
    vtkDataArray* const array = result->GetPointData()->GetArray(name);
    if (!array || array->GetNumberOfTuples() != result->GetNumberOfPoints())
    {
      std::fprintf(stderr, "the array %s is missing or too short\n", name);
      return 1;
    }
  }

  Status status = Status::Ok;
  const std::shared_ptr<const HapticScene> scene = makeHapticScene(result, status);
  if (!scene)
  {
    std::fprintf(stderr, "no scene: %s\n", message(status));
    return 1;
  }
  Proxy proxy;
  proxy.setScene(scene.get());
  ProxyState state;
  for (int tick = 0; tick <= 100; ++tick)
  {
    state = proxy.step({ 0.0, 0.0, kRadius + 0.001 - 0.00002 * tick }, 0.001);
  }
  std::printf("force %.6f N at 1 mm depth, expected 0.8 N\n", state.force.z);

  // The other modules link and load.
  vtkNew<vtkPointCloudReader> reader;
  vtkNew<vtkInteractorStyleHaptic> style;
  SimulatedDevice device;
  const bool opened = device.open() == Status::Ok && reader && style;
  return opened && std::abs(state.force.z - 0.8) < 0.008 ? 0 : 1;
}
