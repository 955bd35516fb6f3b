#include "Feel/FeelReplay.h"

#include "Options/ConfigFile.h"
#include "Terminal/ProgressBar.h"
#include "Terminal/StopSignals.h"

#include "ClippedCloud.h"
#include "LoadedCloud.h"
#include "Recording.h"

#include <vtkPolyData.h>

#include <vector>

namespace pointhaptics
{
namespace app
{

void declareRecordedClouds(const std::string& fileName, const std::string& cloudFile, Files& files)
{
  Recording recording;
  std::string ignored;
  if (!cloudFile.empty() || !readRecording(files.input(fileName), recording, ignored, true))
  {
    return;
  }
  for (const std::string& file : recording.header.cloud.files)
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
  const RecordedReading reading = recordedReading(recording.header.settings);
  request.columns = reading.columns;
  request.salvage = reading.salvage;
  request.vertices = reading.vertices;
  std::string wrong;
  request.hidden = hiddenIn(reading.hide, wrong);
  request.up = reading.up;
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
  bool isLoaded = false;
  const auto takeCloud = [&](std::string& problem)
  {
    isLoaded = loadCloud(request, goesOn, loaded, problem);
    if (!isLoaded)
    {
      return false;
    }
    cloud = shownPart(loaded.cloud, reading.clip, loaded.showing.hidden);
    const bool isRight = isOf(recording, cloud, problem);
    problem.insert(0, isRight ? "" : request.files.front() + ": ");
    return isRight;
  };
  std::string problem;
  if (!takeCloud(problem) && isLoaded && !request.vertices)
  {
    // Before faces were sampled, meshes were felt by their vertices, and recordings did not say so.
    request.vertices = true;
    std::string ignored;
    problem = takeCloud(ignored) ? "" : problem;
  }
  message = problem;
  return problem.empty();
}

} // namespace app
} // namespace pointhaptics
