#include "PngFile.h"

#include "Core/Base/OutputFile.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"
#include "vtkUnsignedCharArray.h"

namespace pointhaptics
{

bool writePng(vtkImageData* image, const std::string& fileName, std::string& message)
{
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(image);
  writer->WriteToMemoryOn();
  writer->Write();
  vtkUnsignedCharArray* bytes = writer->GetResult();
  OutputFile file;
  static_cast<void>(file.open(fileName)); // commit() tells
  static_cast<void>(file.write({ reinterpret_cast<const char*>(bytes->GetPointer(0)),
    static_cast<std::size_t>(bytes->GetNumberOfValues()) }));
  if (file.commit() != Status::Ok)
  {
    message = fileName + ": cannot be written: " + file.reason() + "; " + file.cure();
    return false;
  }
  return true;
}

} // namespace pointhaptics
