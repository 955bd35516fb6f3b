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
  if (!loadCloud(request, goesOn, loaded, message))
  {
    return false;
  }
  cloud = clippedCloud(loaded.cloud, clipBox(numbersOf(recording.header.settings, "clip")));
  if (!isOf(recording, cloud, message))
  {
    message.insert(0, request.files.front() + ": ");
    return false;
  }
  return true;
}

} // namespace app
} // namespace pointhaptics
