#include "CloudFiles.h"

#include "ClippedCloud.h"
#include "CloudAppearance.h"
#include "Core/Base/Boxes.h"
#include "Core/Base/Host/OutOfMemory.h"
#include "EventLink.h"
#include "IO/Info/LengthUnit.h"
#include "MergedCloud.h"
#include "vtkPointCloudReader.h"
#include "vtkPointCloudWriter.h"

#include <fmt/format.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnsignedShortArray.h>

#include <algorithm>
#include <exception>

namespace pointhaptics
{
namespace
{

std::string baseName(const std::string& fileName)
{
  const std::size_t slash = fileName.find_last_of('/');
  return slash == std::string::npos ? fileName : fileName.substr(slash + 1);
}

/// The points of a file with all arrays, without its cells. Null: @p message says why.
vtkSmartPointer<vtkPolyData> readPoints(const std::string& fileName, const CloudRequest& request,
  const std::function<bool(double)>& goesOn, Findings& findings, std::string& message)
{
  vtkNew<vtkPointCloudReader> reader;
  EventLink progress(
    [&reader, &goesOn](unsigned long, void* part)
    {
      if (part && !reader->GetAbortExecute() && !goesOn(*static_cast<double*>(part)))
      {
        reader->SetAbortExecute(1);
      }
    });
  progress.follow(reader, vtkCommand::ProgressEvent);
  // The reader's error is in its message; without an observer it would go where the errors of the scene are
  // collected.
  EventLink silence([] {});
  silence.follow(reader, vtkCommand::ErrorEvent);
  reader->SetFileName(fileName.c_str());
  reader->SetResolution(request.options.resolution);
  reader->SetColumns(request.options.columns);
  reader->SetSalvage(request.options.salvage);
  reader->SetSamples(request.options.vertices ? 0 : vtkPointCloudReader::AUTOMATIC);
  reader->SetMostPoints(request.mostPoints);
  reader->Update();
  message = reader->GetErrorMessage();
  vtkPolyData* read = reader->GetOutput();
  if (message.empty() && read->GetNumberOfPoints() == 0)
  {
    message = fileName + ": holds no points; give a file with at least one";
  }
  if (!message.empty())
  {
    return nullptr;
  }
  findings.format = reader->GetFormat();
  findings.isCoarse = findings.isCoarse || reader->IsCoarse();
  findings.hasSamples = findings.hasSamples || reader->HasSamples();
  for (const std::string& note : reader->GetNotes())
  {
    findings.notes.push_back(baseName(fileName) + ": " + note);
  }
  return withoutCells(read);
}

} // namespace

vtkSmartPointer<vtkPolyData> readFiles(const CloudRequest& request, const std::function<bool(double)>& goesOn,
  Findings& findings, std::string& message)
{
  if (request.points)
  {
    return request.points;
  }
  std::vector<vtkSmartPointer<vtkPolyData>> clouds;
  std::vector<vtkPolyData*> inputs;
  double begin = 0.0;
  const double share = 1.0 / double(request.files.size());
  for (const std::string& file : request.files)
  {
    const auto askOn = [&](double part) { return goesOn(begin + share * part); };
    clouds.push_back(readPoints(file, request, askOn, findings, message));
    inputs.push_back(clouds.back());
    if (!inputs.back())
    {
      return nullptr;
    }
    if (request.files.size() > 1)
    {
      vtkNew<vtkUnsignedShortArray> number;
      number->SetName(kFileArrayName);
      number->SetNumberOfValues(inputs.back()->GetNumberOfPoints());
      number->Fill(double(inputs.size() - 1));
      inputs.back()->GetPointData()->AddArray(number);
    }
    begin += share;
  }
  if (clouds.size() == 1)
  {
    return clouds.front();
  }
  vtkSmartPointer<vtkPolyData> merged = io::mergeClouds(inputs, request.files, findings.notes);
  if (!merged)
  {
    message = findings.notes.back();
    return nullptr;
  }
  vtkNew<vtkStringArray> names;
  names->SetName(kFileArrayName);
  for (const std::string& file : request.files)
  {
    names->InsertNextValue(baseName(file));
  }
  merged->GetFieldData()->AddArray(names);
  if (!std::all_of(inputs.begin(), inputs.end(), hasColors))
  {
    merged->GetPointData()->SetActiveScalars(nullptr); // those of some would leave the others black
  }
  return merged;
}

vtkSmartPointer<vtkPolyData> withoutCells(vtkPolyData* cloud)
{
  auto points = vtkSmartPointer<vtkPolyData>::New();
  points->SetPoints(cloud->GetPoints());
  points->GetPointData()->ShallowCopy(cloud->GetPointData());
  points->GetFieldData()->ShallowCopy(cloud->GetFieldData());
  return points;
}

std::string titleOf(const std::vector<std::string>& files)
{
  std::string names;
  for (const std::string& file : files)
  {
    names += (names.empty() ? "" : ", ") + baseName(file);
  }
  return names;
}

bool writePart(const CloudRequest& request, const Vec3& up, const std::string& fileName, std::string& message)
try
{
  Findings findings;
  const auto cloud = readFiles(
    request, [](double) { return true; }, findings, message);
  if (!cloud)
  {
    return false;
  }
  const vtkSmartPointer<vtkPolyData> local = inLocalMetres(cloud, !request.options.unitIsChosen);
  auto measured = vtkSmartPointer<vtkPolyData>::New();
  measured->ShallowCopy(local);
  addHeightArray(measured, up);
  std::vector<HiddenValues> hidden = request.options.picture.hidden;
  if (!completeHidden(measured, request.options.names.hidden, hidden, message))
  {
    return false;
  }
  const auto isShown = notHidden(measured, hidden);
  const std::optional<Bounds> box = clipBox(request.options.clip, local);
  const auto part = partOfCloud(cloud,
    [&](vtkIdType i, const Vec3&)
    {
      Vec3 place;
      local->GetPoint(i, &place.x);
      return (!box || contains(*box, place)) && isShown(i);
    });
  vtkNew<vtkPointCloudWriter> writer;
  EventLink silence([] {});
  silence.follow(writer, vtkCommand::ErrorEvent); // its message says it
  writer->SetFileName(fileName.c_str());
  writer->KeepDoublesOn();
  writer->SetInputData(part);
  const bool isWritten = writer->Write() != 0;
  message = isWritten ? fmt::format("saved: {}, {} of {} points", fileName, part->GetNumberOfPoints(),
                          cloud->GetNumberOfPoints())
                      : writer->GetErrorMessage();
  return isWritten;
}
catch (const std::exception& fault)
{
  message =
    fileName + ": " + (isOutOfMemory(fault) ? pointhaptics::message(Status::OutOfMemory) : fault.what());
  return false;
}

} // namespace pointhaptics
