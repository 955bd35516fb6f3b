// Recording, replay and sound of the touch in the window.
#include "PolyDataAccess.h"
#include "ViewWindow.h"

#include "vtkVoxelMeanResampler.h"

#include <fmt/format.h>
#include <vtkMatrix4x4.h>
#include <vtkPointSet.h>

namespace pointhaptics
{

bool ViewWindow::startRecording(const std::string& fileName, std::string& message)
{
  auto* cloud = vtkPointSet::SafeDownCast(scene_.resampler()->GetInputDataObject(0, 0));
  std::vector<std::string> files =
    files_.shown().empty() ? std::vector<std::string>{ scene_.title() } : files_.shown();
  for (std::string& file : files)
  {
    if (file == options_.passingFile && !file.empty())
    {
      const std::string passing = std::exchange(file, keptCloudName(fileName));
      if (!keepCloud(passing, file, message))
      {
        return false;
      }
    }
  }
  RecordingHeader header =
    headerOf(files, options_.resolution, cloud); // of the clipping box, where there is one
  header.program = observer_.program;
  header.settings = observer_.describeState ? observer_.describeState(this->state()) : std::string();
  return recording_.open(fileName, header, message);
}

/// Ends the recording and says where it is, and @p cause where that ends it early. False: @p message says
/// what is lost.
bool ViewWindow::closeRecording(std::string& message, const std::string& cause)
{
  if (!recording_.isOpen())
  {
    return true;
  }
  style_->CollectSamples();
  const bool isWritten = recording_.close(message, cause);
  const std::string why = recording_.problem();
  if (!why.empty())
  {
    const std::string verb = recording_.numberOfTicks() == 0 ? "" : "it ends early: ";
    observer_.say(kWarning, recording_.fileName() + ": " + verb + why);
  }
  if (!isWritten || recording_.numberOfTicks() == 0)
  {
    return isWritten;
  }
  this->say(fmt::format("recording: {} ({} ticks, {} marker{}){}", recording_.fileName(),
    recording_.numberOfTicks(), recording_.numberOfMarkers(), recording_.numberOfMarkers() == 1 ? "" : "s",
    why.empty() ? "" : "; it ends early: " + why));
  return true;
}

/// As closeRecording(), in a window that goes on.
void ViewWindow::endRecording(const std::string& cause)
{
  std::string message;
  if (!this->closeRecording(message, cause))
  {
    this->say(message, kError);
  }
}

void ViewWindow::toggleRecording()
{
  std::string message;
  if (recording_.isOpen())
  {
    this->endRecording();
    return;
  }
  if (!device_ || !servo_.running())
  {
    this->say("nothing is touched here that could be recorded");
    return;
  }
  if (files_.isReading())
  {
    this->say("not all points are read yet; record once they are");
    return;
  }
  const std::string name = this->freeFileName("csv");
  if (!this->startRecording(name, message))
  {
    this->say(message, kError);
    return;
  }
  servo_.beginAnew();
  recordingWaits_ = false;
  this->say("recording to " + name);
}

void ViewWindow::setMarker()
{
  if (recording_.isWaiting() && recordingWaits_)
  {
    this->say("no marker: recording begins when the hand lets go of the surface");
    return;
  }
  const std::uint32_t marker = recording_.mark(servo_.latest().tick, options_.markerText);
  this->say(marker > 0 ? fmt::format("marker {}", marker) : "no marker: nothing is recorded");
}

/// Called at every timer event.
void ViewWindow::followRecording()
{
  if (!recording_.isOpen())
  {
    return;
  }
  if (!recording_.problem().empty())
  {
    this->endRecording();
    return;
  }
  if (recording_.isWaiting() && !recordingWaits_ && servo_.latest().state.contact)
  {
    recordingWaits_ = true;
    this->say("recording begins when the hand lets go of the surface");
  }
  else if (!recording_.isWaiting() && recordingWaits_)
  {
    recordingWaits_ = false;
    this->say("recording to " + recording_.fileName());
  }
}

/// Switches the sound on or off.
void ViewWindow::toggleSound()
{
  options_.sound = !options_.sound;
  std::string message;
  std::unique_ptr<SoundOutput> loudspeaker;
  if (!options_.sound)
  {
    sound_.stop();
    this->say("sound: off");
  }
  else if (!device_ && !player_)
  {
    options_.sound = false;
    this->say("nothing is touched here that could be heard");
  }
  else if ((loudspeaker = openLoudspeaker(message)))
  {
    sound_.start(servo_, std::move(loudspeaker));
    this->say("sound: as loud as the force, a click where contact begins");
  }
  else
  {
    options_.sound = false;
    this->say(message, kError);
  }
}

/// Called at every timer event.
void ViewWindow::followSound()
{
  const std::string problem = sound_.takeProblem();
  if (!problem.empty())
  {
    sound_.stop();
    options_.sound = false;
    this->say(problem, kError);
  }
}

bool ViewWindow::openReplay(std::string& message)
{
  player_ = std::make_unique<ReplayPlayer>();
  auto* cloud = vtkPointSet::SafeDownCast(scene_.resampler()->GetInputDataObject(0, 0));
  return player_->open(options_.replay, cloud, message);
}

/// Called at every timer event: moves the model as in the recording.
void ViewWindow::followReplay()
{
  if (const auto model = player_ ? player_->takeModel() : std::nullopt)
  {
    vtkNew<vtkMatrix4x4> matrix;
    setElements(matrix, *model);
    style_->SetModelMatrix(matrix);
  }
  const std::string news = player_ ? player_->takeMessage() : std::string();
  if (!news.empty())
  {
    this->say(news);
  }
}

} // namespace pointhaptics
