#include "Clouds/Pipeline.h"

#include "Terminal/Messages.h"
#include "Terminal/ProgressBar.h"
#include "Terminal/StopSignals.h"

#include "vtkPointCloudReader.h"
#include "vtkPointCloudWriter.h"

#include <fmt/format.h>
#include <vtkAlgorithm.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointSet.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>

#include <filesystem>

namespace pointhaptics
{
namespace app
{
namespace
{

std::string firstOf(const std::vector<std::string>& messages)
{
  return messages.empty() ? std::string() : messages.front();
}

} // namespace

bool readCloud(const std::string& fileName, Cloud& cloud, std::string& message, double resolution)
{
  vtkNew<vtkPointCloudReader> reader;
  reader->SetResolution(resolution);
  reader->SetFileName(fileName.c_str());
  {
    const ProgressBar bar("reading", reader);
    reader->Update();
  }
  message = reader->GetErrorMessage();
  const std::string other = firstOf(takeVtkErrors());
  if (message.empty() && !other.empty())
  {
    message = fileName + ": " + other;
  }
  if (message.empty() && reader->GetOutput()->GetNumberOfPoints() == 0)
  {
    message = fileName + ": holds no points; give a file with at least one";
  }
  cloud.points = reader->GetOutput();
  cloud.format = reader->GetFormat();
  return message.empty();
}

bool updateFilter(vtkAlgorithm* filter, const std::string& label, std::string& message)
{
  const ProgressBar bar(label, filter);
  filter->Update();
  message = firstOf(takeVtkErrors());
  if (stopIsRequested())
  {
    message = label + " was stopped on request; start it again";
  }
  return message.empty();
}

bool canWriteCloud(const std::string& fileName, std::string& message)
{
  if (vtkPointCloudWriter::CanWrite(fileName))
  {
    return true;
  }
  message = fmt::format("{}: unknown extension \"{}\"; end the name in {}", fileName,
    std::filesystem::path(fileName).extension().string(), vtkPointCloudWriter::GetExtensions());
  return false;
}

bool writeCloud(
  vtkPointSet* points, const std::string& fileName, const std::string& command, std::string& message)
{
  rememberStopSignals();
  vtkNew<vtkPointCloudWriter> writer;
  writer->SetFileName(fileName.c_str());
  writer->SetInputDataObject(points);
  bool written = false;
  {
    const ProgressBar bar("writing", writer);
    written = writer->Write() == 1;
  }
  for (const std::string& note : writer->GetNotes())
  {
    warn(command, fileName + ": " + note);
  }
  if (written)
  {
    return true;
  }
  message = writer->GetErrorMessage();
  const std::string other = firstOf(takeVtkErrors());
  if (message.empty())
  {
    message =
      fileName + ": " + (other.empty() ? "cannot be written; check the folder and the space left" : other);
  }
  return false;
}

vtkSmartPointer<vtkPolyData> transformedPoints(
  vtkPolyData* cloud, const AffineTransform& transform, std::int64_t& invalid)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->Allocate(cloud->GetNumberOfPoints());
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    Vec3 p;
    cloud->GetPoint(i, &p.x);
    const Vec3 moved = transform.apply(p);
    if (isFinite(moved))
    {
      points->InsertNextPoint(moved.x, moved.y, moved.z);
    }
  }
  invalid = cloud->GetNumberOfPoints() - points->GetNumberOfPoints();
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(points);
  return result;
}

void showWarnings(const std::string& command)
{
  for (const std::string& warning : takeVtkWarnings())
  {
    warn(command, warning);
  }
}

void useThreads(std::int64_t threads)
{
  if (threads > 0)
  {
    vtkSMPTools::Initialize(static_cast<int>(threads));
  }
}

} // namespace app
} // namespace pointhaptics
