#include "ImageComparison.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGReader.h>
#include <vtkPNGWriter.h>

#include <algorithm>
#include <cstdlib>

namespace pointhaptics
{
namespace testing
{

ImageDifference compareImages(vtkImageData* test, vtkImageData* baseline, vtkImageData* picture)
{
  ImageDifference difference;
  const int* size = test->GetDimensions();
  difference.sameSize = std::equal(size, size + 3, baseline->GetDimensions()) &&
    test->GetNumberOfScalarComponents() == 3 && baseline->GetNumberOfScalarComponents() == 3;
  if (!difference.sameSize)
  {
    return difference;
  }
  picture->SetDimensions(size);
  picture->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  const auto* a = static_cast<const unsigned char*>(test->GetScalarPointer());
  const auto* b = static_cast<const unsigned char*>(baseline->GetScalarPointer());
  auto* out = static_cast<unsigned char*>(picture->GetScalarPointer());
  const long long pixels = 1LL * size[0] * size[1];
  for (long long pixel = 0; pixel < pixels; ++pixel)
  {
    int largest = 0;
    for (int channel = 0; channel < 3; ++channel, ++a, ++b, ++out)
    {
      const int step = std::abs(int(*a) - int(*b));
      largest = std::max(largest, step);
      *out = static_cast<unsigned char>(std::min(255, 5 * step));
    }
    difference.any += largest > 0;
    difference.visible += largest > kVisibleStep;
    difference.largest = std::max(difference.largest, largest);
  }
  return difference;
}

bool readPng(const std::string& fileName, vtkImageData* image)
{
  vtkNew<vtkPNGReader> reader;
  if (!reader->CanReadFile(fileName.c_str()))
  {
    return false;
  }
  reader->SetFileName(fileName.c_str());
  reader->Update();
  image->DeepCopy(reader->GetOutput());
  return reader->GetErrorCode() == 0;
}

bool writePng(const std::string& fileName, vtkImageData* image)
{
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName(fileName.c_str());
  writer->SetInputData(image);
  writer->Write();
  return writer->GetErrorCode() == 0;
}

} // namespace testing
} // namespace pointhaptics
