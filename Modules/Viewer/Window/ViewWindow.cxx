#include "ViewWindow.h"

#include "ViewDisplay.h"

#include "CloudAppearance.h"
#include "Gesture.h"
#include "ScreenScale.h"
#include "SteadyTime.h"
#include "StereoPicture.h"

#include <fmt/format.h>
#include <vtkTransform.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace pointhaptics
{
namespace
{

constexpr double kChartHeight = 0.15; // part of the window
/// Frames that take longer than this, seconds, are announced in the title.
constexpr double kLongFrame = 1.0;

} // namespace

ViewWindow::ViewWindow(ViewScene& scene, const HapticViewerOptions& options,
  const HapticViewerObserver& observer, std::vector<std::string> files)
  : scene_(scene)
  , options_(options)
  , asked_(options)
  , observer_(observer)
  , tools_{ scene, options_, style_->GetCommands(), window_, interactor_, [this] { this->clipFelt(); },
    [this](const std::string& news) { this->say(news); } }
  , controls_(tools_)
  , colorBar_(tools_, controls_)
  , profile_(tools_)
  , measuring_(tools_, profile_)
  , clipping_(tools_)
  , files_(tools_, controls_, observer, style_->GetModelTransform(), std::move(files),
      { [this](LoadedCloud cloud, const FileLoad& load) { this->show(std::move(cloud), load); },
        [this](const std::vector<std::string>& notes) { this->warn(notes); },
        [this](const std::string& error) { this->say(error, kError); },
        [this](const std::string& words, double part) { this->showProgress(words, part); } })
{
  ViewWindow::addCommands(style_->GetCommands(), this);
  for (const std::string& conflict : style_->GetCommands().conflicts())
  {
    observer_.say(kError, "two commands have one key by default: " + conflict);
  }
  style_->GetCommands().bind(options_.bindings);
}

ViewWindow::~ViewWindow()
{
  std::string message;
  if (isStarted_ && !this->finish(message))
  {
    observer_.say(kError, message);
  }
  layout_.follow(nullptr);
  scene_.leaveLayout();
  if (isOpen_)
  {
    window_->RemoveRenderer(scene_.renderer());
  }
}

/// Opens the window once, with or without a cloud.
void ViewWindow::openWindow()
{
  window_->SetMultiSamples(0);
  window_->SetStereoCapableWindow(options_.picture.stereo == kQuadBuffers);
  const auto screen = window_->GetOffScreenRendering() ? std::array<int, 2>() : screenSize();
  window_->SetSize(lengthOnScreen(options_.width, screen[0]), lengthOnScreen(options_.height, screen[1]));
  window_->SetWindowName("PointHaptics");
  interactor_->SetRenderWindow(window_);
  interactor_->SetInteractorStyle(nullptr); // until there is something to move
  isOpen_ = true;
}

void ViewWindow::setTitle(const std::string& words)
{
  const std::string title = "PointHaptics: " + words;
  if (title != window_->GetWindowName())
  {
    window_->SetWindowName(title.c_str());
  }
}

/// Shows the bar in a renderer of its own: the scene's would ask filters that have no cloud.
void ViewWindow::showBar(const std::string& words, double part)
{
  if (!isOpen_)
  {
    this->openWindow();
  }
  applyGround(waiting_, groundOf(options_.picture));
  progress_->SetProgress(words, part);
  progress_->AddTo(waiting_);
  applyTextScale(window_, options_.picture.fontScale);
  layout_.setProgress(progress_);
  layout_.follow(waiting_);
  window_->AddRenderer(waiting_);
  window_->Render();
  interactor_->Initialize();
  // The title comes after the window hears keys: a person who waits for it may press one.
  this->setTitle(words);
}

/// The keys that leave or quit.
bool ViewWindow::isCancelKey()
{
  const std::string key = interactor_->GetKeySym() ? interactor_->GetKeySym() : "";
  const Command* command = style_->GetCommands().find(gestureOf(
    key, interactor_->GetControlKey() != 0, interactor_->GetShiftKey() != 0, interactor_->GetAltKey() != 0));
  return command && (command->name == "quit" || command->name == "leave");
}

bool ViewWindow::awaitCloud(const CloudLoader& loader, const std::string& title)
{
  bool isRead = false;
  this->showBar("reading " + title, loader.step().part);
  const auto look = [&](unsigned long event, void*)
  {
    if (interactor_->GetDone())
    {
      return; // it is decided; this was in the queue
    }
    const bool cancels = (event == vtkCommand::KeyPressEvent && this->isCancelKey()) || observer_.stops();
    isRead = !cancels && loader.waitFor(0.0);
    if (event == vtkCommand::KeyPressEvent && !cancels)
    {
      waitingKeys_.keep(interactor_);
    }
    if (cancels || isRead)
    {
      leaveEvents(interactor_);
    }
    const CloudLoader::Step step = loader.step();
    if (observer_.progress)
    {
      observer_.progress(step.name, isRead || cancels ? 1.0 : std::min(step.part, kAlmostDone));
    }
    if (progress_->SetProgress(step.name + (" " + title), step.part))
    {
      window_->Render();
    }
  };
  EventLink events(look);
  events.follow(interactor_, { vtkCommand::TimerEvent, vtkCommand::KeyPressEvent });
  const int timer = interactor_->CreateRepeatingTimer(33);
  runEvents(interactor_);
  interactor_->DestroyTimer(timer);
  return isRead; // not where the close button ended it
}

void ViewWindow::setUpRendering()
{
  if (!isOpen_)
  {
    this->openWindow();
  }
  progress_->Hide();
  progress_->RemoveFrom(waiting_);
  window_->RemoveRenderer(waiting_);
  this->setTitle(scene_.title());
  window_->AddRenderer(scene_.renderer());
  overlay_->AddTo(scene_.renderer());
  progress_->AddTo(scene_.renderer());
  layout_.setOverlay(overlay_);
  layout_.setSliders(sliders_);
  layout_.setProgress(progress_);
  scene_.join(layout_);
  layout_.follow(scene_.renderer());
  if (options_.device != HapticViewerDevice::None || options_.followsFile())
  {
    chart_->SetDark(!isLightGround(groundOf(options_.picture)));
    window_->AddRenderer(chart_->GetRenderer());
    chart_->GetRenderer()->SetViewport(0.0, 0.0, 1.0, kChartHeight);
    style_->SetChart(chart_);
    style_->GetDisplay().hideChartUntilTouch();
  }
  scene_.detail().setEnabled(true);
  scene_.setPicture(options_.picture);
  scene_.placeCamera();
  scene_.setCamera(options_.camera);
  scene_.showAxes(options_.axes);
  scene_.placeAxes(scene_.modelMatrix());
}

void ViewWindow::connectStyle()
{
  style_->SetWorkspaceBounds(scene_.workspaceBounds().data());
  scene_.showAmbient(options_.ambient);
  this->setSceneOptions();
  style_->SetResampler(scene_.resampler());
  style_->SetBandwidthFilter(scene_.bandwidth());
  style_->SetCloudActor(scene_.actor());
  style_->GetPicker().setPointsOfFile(
    scene_.pointsActor(), { kArraysOfPicture.begin(), kArraysOfPicture.end() });
  style_->SetProps(scene_.props());
  style_->SetOverlay(overlay_);
  style_->GetHand().setPushesPointer(options_.pushPointer);
  style_->SetDefaultRenderer(scene_.renderer());
  this->showNote();
  modelChanged_.follow(style_, vtkInteractorStyleHaptic::ModelChangedEvent);
  sceneChanged_.follow(style_, vtkInteractorStyleHaptic::SceneChangedEvent);
  samples_.follow(style_, vtkInteractorStyleHaptic::SamplesEvent);
  dropped_.follow(style_, vtkInteractorStyleHaptic::FilesDroppedEvent);
  interactor_->SetInteractorStyle(style_);
  sliders_->SetInteractor(interactor_);
  this->showSliderValues();
  sliderMoved_.follow(sliders_, vtkHapticSliders::ValueChangedEvent);
  style_->SetSliders(sliders_);
  if (options_.figure)
  {
    this->showFigure(true);
  }
  timer_.follow(interactor_, vtkCommand::TimerEvent);
  abortCheck_.follow(window_, vtkCommand::AbortCheckEvent);
  acted_.follow(interactor_,
    { vtkCommand::KeyPressEvent, vtkCommand::LeftButtonPressEvent, vtkCommand::MiddleButtonPressEvent,
      vtkCommand::RightButtonPressEvent, vtkCommand::MouseWheelForwardEvent,
      vtkCommand::MouseWheelBackwardEvent },
    1.0F);
}

void ViewWindow::onSamples(void* callData)
{
  const auto& samples = *static_cast<std::vector<ServoSample>*>(callData);
  recording_.add(servo_, samples);
  std::string message;
  const auto ideal = [this](const ServoSample& sample)
  { return wholeIdeal_ ? idealForce(*wholeIdeal_, scene_, sample.state.hip, this->contactOf(sample)) : NAN; };
  if (!touchFiles_.add(samples, ideal, message)) // said at once: the session may last for hours
  {
    observer_.say(kError, message);
  }
}

/// Called 30 times a second. Looks for a finished file, messages of the device and a request to end, and
/// refines a picture that rests.
void ViewWindow::onTimer()
{
  const bool wasGivenUp = std::exchange(isGivenUp_, false);
  if (scene_.followMeasurement(false) || scene_.refinementDue() || wasGivenUp)
  {
    interactor_->Render();
  }
  if (!files_.isReading())
  {
    const std::optional<double> part = scene_.measuredPart();
    this->setTitle(part ? fmt::format("measuring {} {:.0f} %", scene_.title(), std::floor(100.0 * *part))
                        : scene_.title());
  }
  if (controls_.turnTable(steadySeconds()))
  {
    style_->GetDisplay().requestRender();
  }
  if (observer_.stops())
  {
    interactor_->TerminateApp();
  }
  this->followDevices();
  this->followRecording();
  this->followReplay();
  this->followSound();
  files_.follow();
  this->followSaving();
}

/// Called several times in a frame that takes long. All points may take seconds to draw: a frame at rest is
/// given up for keys and buttons and drawn after them. Until then the window shows the former picture.
void ViewWindow::onAbortCheck()
{
  const std::optional<double> seconds = scene_.detail().restingFrame();
  if (!seconds)
  {
    return;
  }
  if (inputWaits(window_) || observer_.stops())
  {
    isGivenUp_ = true;
    window_->SetAbortRender(1);
  }
  else if (!files_.isReading() && *seconds > kLongFrame)
  {
    this->setTitle("drawing " + scene_.title());
  }
}

void ViewWindow::say(const std::string& news, HapticViewerObserver::Kind kind)
{
  observer_.say(kind, news);
  news_ = news;
  this->showNote();
}

void ViewWindow::onModelChanged()
{
  news_.clear();
  scene_.placeModel(style_->GetModelTransform()->GetMatrix());
  scene_.placeAxes(style_->GetModelTransform()->GetMatrix());
  this->showNote();
}

/// Shows new means, which may bring the colours that the picture waits for. Errors of VTK classes go where
/// the user looks.
void ViewWindow::onSceneChanged()
{
  const bool wasResampled = scene_.isResampled();
  scene_.meansChanged();
  if (!wasResampled)
  {
    this->showSliderValues();
  }
  this->endAwaitingColors();
  for (const std::string& error :
    observer_.takeVtkErrors ? observer_.takeVtkErrors() : std::vector<std::string>())
  {
    this->say(error, kError);
  }
}

bool ViewWindow::finish(std::string& message)
{
  isStarted_ = false;
  files_.stop();
  style_->StopUpdates();
  sound_.stop();
  if (observer_.rememberState)
  {
    observer_.rememberState(this->state());
  }
  if (player_)
  {
    player_->stop();
  }
  servo_.stop();
  style_->Refresh(); // the last ticks
  saving_.valid() ? saving_.wait() : void();
  this->followSaving();
  spaceMouse_.stop();
  if (device_)
  {
    device_->close();
  }
  if (const std::string refusals = describeRefusals(servo_.statistics()); falcon_ && !refusals.empty())
  {
    observer_.say(kWarning, refusals);
  }
  const bool isRecorded = this->closeRecording(message);
  return touchFiles_.commit(observer_, message) && isRecorded;
}

/// Parameters that @p sample was felt with.
ContactParameters ViewWindow::contactOf(const ServoSample& sample) const
{
  ContactParameters contact = player_ ? player_->contactOf(sample) : options_.haptics.contact;
  contact.forceLimit = device_ && servo_.running() ? servo_.forceLimit().newtons() : contact.forceLimit;
  return contact;
}

bool ViewWindow::start(std::size_t cloud, const std::string& news, std::string& message)
{
  options_.picture.hidden = scene_.picture().hidden; // as the arrays are written
  if (!touchFiles_.open(options_, true, message))
  {
    return false;
  }
  const bool hasWaited = isOpen_;
  news_ = news;
  this->setUpRendering();
  if (!this->openDevice(message))
  {
    return false;
  }
  files_.begin(cloud);
  recording_.follow(&markers_);
  if (options_.markerPort >= 0 && !markers_.open(options_.markerPort, servo_, message))
  {
    return false;
  }
  if (!options_.record.empty() && !this->startRecording(options_.record, message))
  {
    return false;
  }
  this->connectStyle();
  const std::string told = news_;
  this->giveModel(scene_.modelMatrix());
  news_ = told; // the first model makes nothing old
  this->showNote();
  window_->Render();
  interactor_->Initialize();
  this->findIdeal(); // the first picture has no chart to compare with
  if (!this->startServo(message))
  {
    return false;
  }
  isStarted_ = true;
  if (options_.sound)
  {
    options_.sound = false;
    this->toggleSound();
  }
  style_->StartUpdates();
  style_->GetScenes().poll(); // the first picture did not wait for what it asks for
  if (options_.fullScreen)
  {
    controls_.toggleFullScreen();
  }
  if (hasWaited)
  {
    this->forgiveEscape();
  }
  files_.refine();
  return true;
}

void ViewWindow::handleEvents()
{
  waitingKeys_.press(interactor_);
  runEvents(interactor_);
}

} // namespace pointhaptics
