#include "Clouds/Pipeline.h"

#include "Terminal/Messages.h"
#include "Terminal/ProgressBar.h"
#include "Terminal/StandardStreams.h"
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
#include <sstream>

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

/// @p shown: what messages call the file.
bool readFile(const std::string& path, const std::string& shown, Cloud& cloud, std::string& message,
  const ReadOptions& options)
{
  vtkNew<vtkPointCloudReader> reader;
  reader->SetFileName(path.c_str());
  reader->SetExtension(options.extension);
  reader->SetResolution(options.resolution);
  reader->SetApplyPoses(options.applyPoses);
  reader->SetRanks(options.ranks);
  reader->SetGenerateVertices(false); // a writer whose format has cells makes them
  {
    const ProgressBar bar("reading", reader);
    reader->Update();
  }
  message = reader->GetErrorMessage();
  if (message.compare(0, path.size(), path) == 0)
  {
    message.replace(0, path.size(), shown);
  }
  const std::string other = firstOf(takeVtkErrors());
  if (message.empty() && !other.empty())
  {
    message = shown + ": " + other;
  }
  if (message.empty() && !options.ranks && reader->GetOutput()->GetNumberOfPoints() == 0)
  {
    message = shown + ": holds no points; give a file with at least one";
  }
  cloud.points = reader->GetOutput();
  cloud.format = reader->GetFormat();
  cloud.notes = reader->GetNotes();
  cloud.isValidWithoutPoints = reader->IsValidWithoutPoints();
  cloud.bytesRead = reader->GetNumberOfBytesRead();
  return message.empty() && !reader->FailedElsewhere();
}

bool writeFile(vtkPointSet* points, const std::string& path, const std::string& shown,
  const std::string& command, std::string& message, const std::string& extension, vtkIdType* count)
{
  vtkNew<vtkPointCloudWriter> writer;
  writer->SetFileName(path.c_str());
  writer->SetExtension(extension);
  writer->SetInputDataObject(points);
  bool written = false;
  {
    const ProgressBar bar("writing", writer);
    written = writer->Write() == 1;
  }
  for (const std::string& note : writer->GetNotes())
  {
    warn(command, shown + ": " + note);
  }
  if (count)
  {
    *count = writer->GetNumberOfPointsWritten();
  }
  if (written)
  {
    return true;
  }
  message = writer->GetErrorMessage();
  const std::string other = firstOf(takeVtkErrors());
  if (message.compare(0, path.size(), path) == 0)
  {
    message.replace(0, path.size(), shown);
  }
  if (message.empty())
  {
    message =
      shown + ": " + (other.empty() ? "cannot be written; check the folder and the space left" : other);
  }
  return false;
}

} // namespace

bool readCloud(const std::string& fileName, Cloud& cloud, std::string& message, const ReadOptions& options)
{
  if (fileName != kStandardStream)
  {
    return readFile(fileName, fileName, cloud, message, options);
  }
  const TemporaryFolder folder;
  const std::string path = folder.path("input");
  return copyStandardInput(path, message) && readFile(path, "standard input", cloud, message, options);
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

std::vector<std::string> writableExtensions()
{
  std::vector<std::string> extensions;
  std::istringstream words(vtkPointCloudWriter::GetExtensions()); // ".vtp, .ply or .csv"
  for (std::string word; words >> word;)
  {
    if (word.front() == '.')
    {
      extensions.push_back(word.substr(1, word.find_last_not_of(',')));
    }
  }
  return extensions;
}

bool writeCloud(vtkPointSet* points, const std::string& fileName, const std::string& command,
  std::string& message, const std::string& extension, vtkIdType* written)
{
  rememberStopSignals();
  if (fileName != kStandardStream)
  {
    return writeFile(points, fileName, fileName, command, message, extension, written);
  }
  // Not straight into the pipe: nobody shall get half a cloud, and VTP goes back in its file.
  const TemporaryFolder folder;
  const std::string path = folder.path("output");
  return writeFile(points, path, "standard output", command, message, extension, written) &&
    copyToStandardOutput(path, message);
}

vtkSmartPointer<vtkPolyData> transformedPoints(vtkPolyData* cloud, const AffineTransform& transform)
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
  auto result = vtkSmartPointer<vtkPolyData>::New();
  result->SetPoints(points);
  return result;
}

std::string noFinitePoint(const std::string& fileName, std::int64_t count)
{
  return fmt::format("{}: no point is finite: {} with a coordinate that is NaN or infinite; mend the file",
    fileName, countOfPoints(count));
}

void showNotes(const std::string& command, const std::string& fileName, const Cloud& cloud)
{
  for (const std::string& note : cloud.notes)
  {
    warn(command, fileName + ": " + note);
  }
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
