// Thins a coloured point cloud to one point per voxel.
//
//   VoxelMeanResamplerExample [IN [OUT.ply]]
//
// Without IN it makes a cloud: a ball of 20 cm radius, red on the left and blue on the right.
#include <vtkPointCloudReader.h>
#include <vtkPointCloudWriter.h>
#include <vtkVoxelMeanResampler.h>

#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTransform.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>
#include <cstdio>

namespace
{

/// Points evenly over a sphere (a Fibonacci spiral). A cloud needs points only; cells are not read.
void makeColouredBall(vtkPolyData* cloud, int count, double radius)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkUnsignedCharArray> colours;
  colours->SetName("RGB");
  colours->SetNumberOfComponents(3);
  const double golden = 3.14159265358979323846 * (3.0 - std::sqrt(5.0));
  for (int i = 0; i < count; ++i)
  {
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const double ring = std::sqrt(1.0 - z * z);
    const double x = ring * std::cos(golden * i);
    points->InsertNextPoint(radius * x, radius * ring * std::sin(golden * i), radius * z);
    colours->InsertNextTuple3(127.5 - 127.5 * x, 0, 127.5 + 127.5 * x);
  }
  cloud->SetPoints(points);
  cloud->GetPointData()->SetScalars(colours);
}

/// The voxel that holds most points, with its averaged colour.
void describeFullestVoxel(vtkPolyData* voxels)
{
  vtkDataArray* const counts = voxels->GetPointData()->GetArray("VoxelPointCount");
  vtkIdType fullest = 0;
  for (vtkIdType v = 1; v < voxels->GetNumberOfPoints(); ++v)
  {
    fullest = counts->GetTuple1(v) > counts->GetTuple1(fullest) ? v : fullest;
  }
  const double* const mean = voxels->GetPoint(fullest);
  std::printf("fullest voxel: %.0f points, mean (%.4f, %.4f, %.4f)", counts->GetTuple1(fullest), mean[0],
    mean[1], mean[2]);
  // Point arrays keep their names, types and roles: the active scalars are the averaged colours.
  if (vtkDataArray* const colours = voxels->GetPointData()->GetArray("RGB"))
  {
    const double* const rgb = colours->GetTuple3(fullest);
    std::printf(", mean colour (%.0f, %.0f, %.0f)", rgb[0], rgb[1], rgb[2]);
  }
  std::printf("\n");
}

}

int main(int argc, char* argv[])
{
  // A cloud from anywhere: a file ...
  vtkNew<vtkPointCloudReader> reader;
  vtkNew<vtkPolyData> ball;
  vtkNew<vtkVoxelMeanResampler> resampler;
  if (argc > 1)
  {
    reader->SetFileName(argv[1]);
    resampler->SetInputConnection(reader->GetOutputPort());
  }
  else
  {
    // ... or points of one's own.
    makeColouredBall(ball, 200000, 0.2);
    resampler->SetInputData(ball);
  }

  // First the points are moved into the frame of the workspace: here to a quarter of their size, turned.
  vtkNew<vtkTransform> transform;
  transform->RotateZ(30.0);
  transform->Scale(0.25, 0.25, 0.25);
  resampler->SetTransform(transform);

  // Then they are averaged, voxel by voxel: 100^3 voxels in a cube of 10 cm, whose lower half is cut off.
  // Without SetWorkspaceBounds the workspace is a cube about the whole cloud.
  resampler->SetWorkspaceBounds(-0.05, 0.05, -0.05, 0.05, 0.0, 0.1);
  resampler->SetDimensions(100, 100, 100);
  if (argc > 1)
  {
    resampler->AutomaticWorkspaceOn();
  }
  resampler->Update();

  vtkPolyData* const voxels = resampler->GetOutput();
  std::printf("%lld voxels hold points; %lld points were outside the workspace, %lld not finite\n",
    static_cast<long long>(voxels->GetNumberOfPoints()),
    static_cast<long long>(resampler->GetNumberOfClippedPoints()),
    static_cast<long long>(resampler->GetNumberOfInvalidPoints()));
  if (voxels->GetNumberOfPoints() == 0)
  {
    std::fprintf(stderr, "nothing to show: the cloud is empty or outside the workspace\n");
    return 1;
  }
  describeFullestVoxel(voxels);

  if (argc > 2)
  {
    vtkNew<vtkPointCloudWriter> writer;
    writer->SetInputConnection(resampler->GetOutputPort());
    writer->SetFileName(argv[2]);
    return writer->Write() == 1 ? 0 : 1;
  }
  return 0;
}
