// Resample IN OUT: a VTK pipeline from file to file. OUT has one point per voxel of 1 mm: the mean of the
// points in it and of their arrays, how many they are, a kernel bandwidth and a proxy radius.
#include <vtkKernelBandwidthFilter.h>
#include <vtkPointCloudReader.h>
#include <vtkPointCloudWriter.h>
#include <vtkVoxelMeanResampler.h>

#include <vtkNew.h>
#include <vtkPolyData.h>

#include <cstdio>

int main(int argc, char* argv[])
{
  if (argc != 3)
  {
    std::fprintf(stderr, "usage: Resample IN OUT (.vtp, .ply, .pcd, .las, .laz, .csv or .xyz)\n");
    return 2;
  }
  vtkNew<vtkPointCloudReader> reader;
  reader->SetFileName(argv[1]);

  vtkNew<vtkVoxelMeanResampler> resampler;
  resampler->SetInputConnection(reader->GetOutputPort());
  resampler->SetVoxelSize(0.001); // or SetDimensions() in SetWorkspaceBounds(), after SetTransform()

  vtkNew<vtkKernelBandwidthFilter> bandwidth;
  bandwidth->SetInputConnection(resampler->GetOutputPort());

  vtkNew<vtkPointCloudWriter> writer;
  writer->SetInputConnection(bandwidth->GetOutputPort());
  writer->SetFileName(argv[2]);
  const bool written = writer->Write() == 1;
  std::printf("%lld points became %lld\n", static_cast<long long>(reader->GetOutput()->GetNumberOfPoints()),
    static_cast<long long>(bandwidth->GetOutput()->GetNumberOfPoints()));
  return written ? 0 : 1;
}
