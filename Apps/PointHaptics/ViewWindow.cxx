#include "ViewWindow.h"

#include "HandDevice.h"
#include "Messages.h"
#include "StopSignals.h"
#include "ViewScene.h"
#include "ViewTouch.h"

#include "vtkHapticChart.h"
#include "vtkHapticOverlay.h"
#include "vtkHapticProps.h"
#include "vtkInteractorStyleHaptic.h"

#include "Devices/DeviceList.h"
#include "Devices/PathReplay.h"
#include "Devices/SimulatedDevice.h"
#include "Devices/SpaceMouse/SpaceMouse.h"
#include "Haptics/ServoLoop.h"

#include <fmt/format.h>
#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>
#include <vtkStringArray.h>
#include <vtkTransform.h>

#include <chrono>
#include <cstdio>
#include <memory>

namespace pointhaptics
{
namespace app
{
namespace
{

constexpr double kChartHeight = 0.24; // part of the window

/// Everything the window needs while it is open. The servo loop stops before what it works on goes away.
class Window
{
public:
  Window(ViewScene& scene, const ViewOptions& options)
    : scene_(scene)
    , options_(options)
  {
  }

  bool run(std::string& message);

private:
  void setUpRendering();
  bool openDevice(std::string& message);
  void openSimulated();
  void openFalcon();
  void onTimer();
  bool startServo(std::string& message);
  void connectStyle();
  void observe(unsigned long event, void (Window::*handler)(void*));
  void onSamples(void* callData);
  void onFilesDropped(void* callData);
  void onScreenshot(void*);
  void onModelChanged(void*);
  void onSceneChanged(void*);
  void showNote();
  void tell(const std::string& message);
  void say(const std::string& news);
  bool finish(std::string& message);

  ViewScene& scene_;
  ViewOptions options_;
  vtkNew<vtkRenderWindow> window_;
  vtkNew<vtkRenderWindowInteractor> interactor_;
  vtkNew<vtkInteractorStyleHaptic> style_;
  vtkNew<vtkHapticChart> chart_;
  vtkNew<vtkHapticChart> wholeChart_; // for --force-chart
  vtkNew<vtkHapticOverlay> overlay_;
  TraceFile trace_;
  int screenshots_ = 0;
  std::string news_; // last line of the status
  std::unique_ptr<SimulatedDevice> hand_;
  std::unique_ptr<PathReplayDevice> replay_;
  std::unique_ptr<FalconDevice> falcon_;
  FalconState falconState_ = FalconState::Closed; ///< As the user was told.
  SpaceMouse spaceMouse_;
  HapticDevice* device_ = nullptr;
  ServoLoop servo_; // last: destroyed, and so stopped, first
};

void Window::setUpRendering()
{
  window_->SetMultiSamples(0);
  window_->SetSize(options_.width, options_.height);
  window_->SetWindowName(("PointHaptics: " + scene_.title()).c_str());
  window_->AddRenderer(scene_.renderer());
  overlay_->AddTo(scene_.renderer());
  if (options_.device != "none" || !options_.path.empty())
  {
    window_->AddRenderer(chart_->GetRenderer());
    chart_->GetRenderer()->SetViewport(0.0, 0.0, 1.0, kChartHeight);
    scene_.renderer()->SetViewport(0.0, kChartHeight, 1.0, 1.0);
    style_->SetChart(chart_);
  }
  interactor_->SetRenderWindow(window_);
  scene_.detail().setEnabled(true);
  scene_.placeCamera();
}

void Window::openSimulated()
{
  SimulatedHandSettings settings;
  settings.workspace = scene_.workspace();
  // In front of the cloud, where the person sees it.
  const Bounds& box = scene_.workspace();
  const Vec3 front = scene_.towardsViewer();
  settings.start = box.center() +
    0.47 * Vec3{ front.x * box.extent().x, front.y * box.extent().y, front.z * box.extent().z };
  hand_ = std::make_unique<SimulatedDevice>(settings);
  hand_->setTarget(settings.start);
  device_ = hand_.get();
}

/// Its workspace is the 10 cm cube about the origin, which the cloud is fitted to.
void Window::openFalcon()
{
  falcon_ = std::make_unique<FalconDevice>(options_.falcon.settings());
  device_ = falcon_.get();
  fmt::print("falcon: starting; loading its firmware takes some seconds\n");
  std::fflush(stdout);
}

bool falconIsUsable()
{
  std::vector<std::string> notes;
  const std::vector<ListedDevice> devices = listDevices(notes);
  return !devices.empty() && devices.front().kind == "falcon" && devices.front().problem.empty();
}

bool Window::openDevice(std::string& message)
{
  if (!options_.path.empty())
  {
    HipPath path;
    if (readHipPath(options_.path, path, message) != Status::Ok)
    {
      return false;
    }
    replay_ = std::make_unique<PathReplayDevice>(std::move(path), true);
    device_ = replay_.get();
  }
  else if (options_.device == "falcon" || (options_.device == "auto" && falconIsUsable()))
  {
    this->openFalcon();
  }
  else if (options_.device != "none")
  {
    this->openSimulated();
  }
  const Status status = device_ ? device_->open() : Status::Ok;
  if (status != Status::Ok)
  {
    message = fmt::format("the {} device cannot be used: {}", device_->name(),
      device_->message().empty() ? sentence(status) : device_->message());
    return false;
  }
  style_->SetDevice(hand_.get());
  style_->SetServoLoop(device_ ? &servo_ : nullptr);
  // Where there is none, it may be plugged in later; where there is no driver, the window does without.
  static_cast<void>(spaceMouse_.start());
  style_->SetSpaceMouse(&spaceMouse_);
  return true;
}

/// After the first scene was published: a path must not begin in an empty world.
bool Window::startServo(std::string& message)
{
  const ServoSettings settings = falcon_ ? pushingServoSettings(1000.0) : ServoSettings();
  const Status status =
    device_ ? servo_.start(*device_, options_.hapticParameters(), settings, &message) : Status::Ok;
  return status == Status::Ok;
}

void Window::observe(unsigned long event, void (Window::*handler)(void*))
{
  struct Link
  {
    Window* window;
    void (Window::*handler)(void*);
  };
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(new Link{ this, handler });
  command->SetClientDataDeleteCallback([](void* link) { delete static_cast<Link*>(link); });
  command->SetCallback(
    [](vtkObject*, unsigned long, void* client, void* callData)
    {
      const Link* link = static_cast<Link*>(client);
      (link->window->*link->handler)(callData);
    });
  style_->AddObserver(event, command);
}

void Window::connectStyle()
{
  double bounds[6];
  scene_.getWorkspaceBounds(bounds);
  style_->SetWorkspaceBounds(bounds);
  style_->SetUseCovariance(!options_.noCovariance);
  style_->SetModelMatrix(scene_.modelMatrix());
  style_->SetResampler(scene_.resampler());
  style_->SetBandwidthFilter(scene_.bandwidth());
  style_->SetCloudActor(scene_.actor());
  style_->SetProps(scene_.props());
  style_->SetOverlay(overlay_);
  style_->SetDefaultRenderer(scene_.renderer());
  this->showNote();
  this->observe(vtkInteractorStyleHaptic::ModelChangedEvent, &Window::onModelChanged);
  this->observe(vtkInteractorStyleHaptic::SceneChangedEvent, &Window::onSceneChanged);
  this->observe(vtkInteractorStyleHaptic::SamplesEvent, &Window::onSamples);
  this->observe(vtkInteractorStyleHaptic::FilesDroppedEvent, &Window::onFilesDropped);
  this->observe(vtkInteractorStyleHaptic::ScreenshotEvent, &Window::onScreenshot);
  interactor_->SetInteractorStyle(style_);
  vtkNew<vtkCallbackCommand> timer;
  timer->SetClientData(this);
  timer->SetCallback(
    [](vtkObject*, unsigned long, void* window, void*) { static_cast<Window*>(window)->onTimer(); });
  interactor_->AddObserver(vtkCommand::TimerEvent, timer);
}

void Window::onSamples(void* callData)
{
  const auto& samples = *static_cast<std::vector<ServoSample>*>(callData);
  if (trace_.isOpen())
  {
    trace_.add(samples);
  }
  if (!options_.forceChart.empty())
  {
    for (const ServoSample& sample : samples)
    {
      wholeChart_->AddSample(sample.timeSeconds, norm(sample.state.force), sample.state.radius);
    }
  }
}

/// 30 times a second: what the device has to say, whether the program is asked to end, and whether a picture
/// that rests is to become finer.
void Window::onTimer()
{
  if (scene_.detail().refinementDue(
        std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count()))
  {
    interactor_->Render();
  }
  if (stopIsRequested())
  {
    interactor_->TerminateApp();
  }
  const FalconState state = falcon_ ? falcon_->state() : FalconState::Closed;
  if (state != falconState_)
  {
    falconState_ = state;
    this->say(advice(state));
  }
}

void Window::say(const std::string& news)
{
  fmt::print("{}\n", news);
  std::fflush(stdout);
  news_ = news;
  this->showNote();
}

/// The scale as it is after all zooming, and the last news.
void Window::showNote()
{
  const std::string scale = describeScale(style_->GetModelTransform()->GetMatrix());
  style_->SetStatusNote(news_.empty() ? scale : scale + "\n" + news_);
}

/// On the terminal and in the window.
void Window::tell(const std::string& message)
{
  fail("view", message);
  news_ = message;
  this->showNote();
}

void Window::onModelChanged(void*)
{
  news_.clear();
  this->showNote();
}

/// What VTK classes complained of while the scene was made goes where the user looks.
void Window::onSceneChanged(void*)
{
  for (const std::string& error : takeVtkErrors())
  {
    this->tell(error);
  }
}

void Window::onFilesDropped(void* callData)
{
  auto* names = static_cast<vtkStringArray*>(callData);
  std::vector<std::string> files;
  for (vtkIdType i = 0; names && i < names->GetNumberOfValues(); ++i)
  {
    files.push_back(names->GetValue(i));
  }
  std::string message;
  if (files.empty() || !scene_.open(files, options_, message))
  {
    this->tell(message);
    return;
  }
  // From here on the window shows the new cloud, also where nothing of it lies in the workspace.
  if (!scene_.build(options_, message))
  {
    this->tell(message);
  }
  double bounds[6];
  scene_.getWorkspaceBounds(bounds);
  style_->SetWorkspaceBounds(bounds);
  style_->SetModelMatrix(scene_.modelMatrix());
  style_->SetResampler(scene_.resampler());
  style_->UpdateModel();
  scene_.placeCamera();
  window_->SetWindowName(("PointHaptics: " + scene_.title()).c_str());
}

void Window::onScreenshot(void*)
{
  std::string name;
  std::FILE* taken = nullptr;
  do
  {
    name = fmt::format("pointhaptics-{:03}.png", ++screenshots_);
    taken = std::fopen(name.c_str(), "rb");
    if (taken)
    {
      std::fclose(taken);
    }
  } while (taken);
  std::string message;
  scene_.detail().showAllOnce();
  window_->Render();
  say(writePicture(window_, name, message) ? "screenshot: " + name : message);
}

bool Window::finish(std::string& message)
{
  style_->StopUpdates();
  servo_.stop();
  style_->Refresh(); // the last ticks
  style_->SetServoLoop(nullptr);
  style_->SetDevice(nullptr);
  style_->SetSpaceMouse(nullptr);
  spaceMouse_.stop();
  if (device_)
  {
    device_->close();
  }
  if (const std::string refusals = describeRefusals(servo_.statistics()); falcon_ && !refusals.empty())
  {
    warn("view", refusals);
  }
  if (trace_.isOpen())
  {
    if (!trace_.close(message))
    {
      return false;
    }
    fmt::print("trace: {}\n", options_.trace);
  }
  if (!options_.forceChart.empty())
  {
    if (!wholeChart_->WriteImage(options_.forceChart.c_str()))
    {
      message = fmt::format(
        "{}: cannot be written; check that its folder exists and can be written", options_.forceChart);
      return false;
    }
    fmt::print("force chart: {}\n", options_.forceChart);
  }
  return true;
}

bool Window::run(std::string& message)
{
  if (!options_.trace.empty() && !trace_.open(options_.trace, message))
  {
    return false;
  }
  this->setUpRendering();
  if (!this->openDevice(message))
  {
    return false;
  }
  this->connectStyle();
  style_->UpdateModel();
  window_->Render();
  interactor_->Initialize();
  if (!this->startServo(message))
  {
    return false;
  }
  style_->StartUpdates();
  rememberStopSignals();
  interactor_->Start();
  return this->finish(message);
}

} // namespace

bool runWindow(ViewScene& scene, const ViewOptions& options, std::string& message)
{
  Window window(scene, options);
  return window.run(message);
}

} // namespace app
} // namespace pointhaptics
