#include "Feel/FeelReplay.h"

#include "Terminal/Messages.h"
#include "Terminal/ProgressBar.h"
#include "Terminal/StopSignals.h"
#include "View/ViewSettings.h"

#include "ClippedCloud.h"
#include "LoadedCloud.h"

#include "Core/Base/OutputFile.h"

#include <vtkPolyData.h>

#include <filesystem>

namespace pointhaptics::app
{
namespace
{

/// @throws Failure where a recorded cloud has moved, with the cure.
void requireClouds(const std::vector<std::string>& files, const std::string& fileName)
{
  for (const std::string& file : files)
  {
    std::error_code ignored;
    require(std::filesystem::exists(file, ignored) || !OutputFile::missedPart(file).empty(),
      fileName + ": its cloud " + file +
        " is not there; name where it is now beside the recording, as in "
        "feel MOVED.ply --replay REC.csv");
  }
}

} // namespace

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

Recording readRecordingFor(
  HapticViewerOptions& viewer, std::vector<std::string>& files, const std::string& fileName)
{
  Recording recording;
  std::string message;
  require(readRecording(fileName, recording, message), message);
  warn(recording.note, recording.note.empty() ? "" : fileName);
  if (files.empty())
  {
    files = recording.header.cloud.files;
    viewer.together = files.size() > 1;
    viewer.resolution = recording.header.cloud.resolution;
  }
  takeRecordedReading(recording.header.settings, viewer);
  return recording;
}

std::pair<Recording, vtkSmartPointer<vtkPolyData>> openRecording(
  const std::string& fileName, const std::string& cloudFile, Files& files)
{
  HapticViewerOptions viewer;
  std::vector<std::string> clouds;
  Recording recording = readRecordingFor(viewer, clouds, files.input(fileName));
  requireClouds(cloudFile.empty() ? clouds : std::vector<std::string>(), fileName);
  CloudRequest request(cloudFile.empty() ? clouds : std::vector<std::string>{ cloudFile }, viewer);
  request.isOnlyRead = true;
  for (std::string& file : request.files)
  {
    file = files.input(file);
  }
  ProgressBar bar("reading");
  vtkSmartPointer<vtkPolyData> cloud;
  const auto progress = [&bar](const std::string& step, double part)
  {
    bar.show(step == "reading" ? part : 1.0);
    return !stopIsRequested();
  };
  bool isLoaded = false;
  const auto takeCloud = [&]
  {
    std::string problem;
    LoadedCloud loaded;
    isLoaded = loadCloud(request, progress, loaded, problem);
    if (isLoaded)
    {
      cloud = shownPart(loaded.cloud, viewer.clip, loaded.showing.hidden);
      const bool isRight = isOf(recording, cloud, problem);
      problem.insert(0, isRight ? "" : request.files.front() + ": ");
    }
    return problem;
  };
  std::string problem = takeCloud();
  if (!problem.empty() && isLoaded && !request.options.vertices)
  {
    // Before faces were sampled, meshes were felt by their vertices, and recordings did not say so.
    request.options.vertices = true;
    problem = takeCloud().empty() ? "" : problem;
  }
  require(problem.empty(), problem);
  return { std::move(recording), cloud };
}

ReplayDifference feelAgain(const std::string& fileName, const Recording& recording, vtkPolyData* cloud,
  std::optional<ProxyMethod> method, const std::string& label,
  const std::function<void(const RecordedTick&, const ServoSample&)>& onTick)
{
  Replay replay(recording, cloud, method);
  ProgressBar bar(label);
  while (!replay.isAtEnd())
  {
    const RecordedTick& row = replay.row();
    ServoSample sample;
    std::string problem;
    const bool isFelt = replay.step(sample, problem);
    require(isFelt, fileName + ": " + problem);
    onTick(row, sample);
    bar.show(double(replay.difference().ticks) / double(recording.ticks.size()));
    require(!stopIsRequested(), fileName + ": feeling was stopped on request; start it again");
  }
  return replay.difference();
}

} // namespace pointhaptics::app
