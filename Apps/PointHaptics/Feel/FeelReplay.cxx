#include "Feel/FeelReplay.h"

#include "Options/ConfigFile.h"
#include "Terminal/ProgressBar.h"
#include "Terminal/StopSignals.h"

#include "ClippedCloud.h"
#include "LoadedCloud.h"
#include "RecordedScenes.h"

#include <vtkPolyData.h>

#include <filesystem>
#include <vector>

namespace pointhaptics
{
namespace app
{

void declareRecordedClouds(const std::string& fileName, const std::string& cloudFile, Files& files)
{
  RecordingHeader header;
  std::string ignored;
  if (!cloudFile.empty() || !readRecordingHeader(files.input(fileName), header, ignored))
  {
    return;
  }
  for (const std::string& file : header.cloud.files)
  {
    files.addInput(file);
  }
}

bool openRecording(const std::string& fileName, const std::string& cloudFile, Files& files,
  Recording& recording, vtkSmartPointer<vtkPolyData>& cloud, std::string& message)
{
  if (!readRecording(files.input(fileName), recording, message))
  {
    return false;
  }
  if (!recording.note.empty())
  {
    warn("replay", recording.note, fileName);
  }
  const RecordedFiles& felt = recording.header.cloud;
  CloudRequest request;
  request.files = cloudFile.empty() ? felt.files : std::vector<std::string>{ cloudFile };
  request.resolution = felt.resolution;
  request.vertices = numbersOf(recording.header.settings, "vertices") == std::vector<double>{ 1.0 };
  for (std::string& file : request.files)
  {
    file = files.input(file);
  }
  ProgressBar bar("reading");
  LoadedCloud loaded;
  const auto goesOn = [&bar](double part)
  {
    bar.show(part);
    return !stopIsRequested();
  };
  const auto takeCloud = [&](std::string& problem)
  {
    if (!loadCloud(request, goesOn, loaded, problem))
    {
      return false;
    }
    cloud = clippedCloud(loaded.cloud, clipBox(numbersOf(recording.header.settings, "clip")));
    const bool isOf = RecordedScenes::isOf(recording, cloud, problem);
    problem.insert(0, isOf ? "" : request.files.front() + ": ");
    return isOf;
  };
  std::string problem;
  if (!takeCloud(problem) && !request.vertices)
  {
    // Before faces were sampled, meshes were felt by their vertices, and recordings did not say so.
    request.vertices = true;
    std::string ignored;
    problem = takeCloud(ignored) ? "" : problem;
  }
  message = problem;
  return problem.empty();
}

RecordingHeader headerOf(const std::string& fileName, double resolution, vtkPolyData* cloud)
{
  RecordingHeader header;
  std::error_code error;
  const std::filesystem::path path = std::filesystem::absolute(fileName, error);
  header.program = "pointhaptics " POINTHAPTICS_VERSION;
  header.cloud.files = { error ? fileName : path.string() };
  header.cloud.resolution = resolution;
  header.cloud.points = cloud->GetNumberOfPoints();
  header.cloud.checksum = checksumOf(cloud);
  return header;
}

} // namespace app
} // namespace pointhaptics
