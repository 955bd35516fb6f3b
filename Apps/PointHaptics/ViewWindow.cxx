#include "ViewWindow.h"

#include "FileWatch.h"
#include "HandDevice.h"
#include "Messages.h"
#include "StopSignals.h"
#include "ViewScene.h"
#include "ViewSettings.h"
#include "ViewTouch.h"

#include "vtkHapticChart.h"
#include "vtkHapticOverlay.h"
#include "vtkHapticProps.h"
#include "vtkHapticSliders.h"
#include "vtkInteractorStyleHaptic.h"
#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

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

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

namespace pointhaptics
{
namespace app
{
namespace
{

constexpr double kChartHeight = 0.24; // part of the window
/// Calls of the timer, of 33 ms each, between two looks at the files.
constexpr int kLooksApart = 8;

/// The first of STEM-001.EXTENSION, STEM-002.EXTENSION, ... after @p last that is not there yet.
std::string freeFileName(const char* extension, int& last)
{
  std::string name;
  std::error_code error;
  do
  {
    name = fmt::format("pointhaptics-{:03}.{}", ++last, extension);
  } while (std::filesystem::exists(name, error));
  return name;
}

/// Everything the window needs while it is open. The servo loop stops before what it works on goes away.
class Window
{
public:
  Window(ViewScene& scene, const ViewOptions& options)
    : scene_(scene)
    , options_(options)
    , parameters_(options.hapticParameters())
    , files_(options.files)
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
  void onNextFile(void*);
  void onPreviousFile(void*);
  void onWriteSettings(void*);
  void onSlider(int slider);
  void connectSliders();
  void setContact(const ContactParameters& contact);
  void showSliderValues();
  bool show(const std::vector<std::string>& files, bool keepsModel);
  void showFile(std::size_t index);
  nlohmann::ordered_json settings();
  void onModelChanged(void*);
  void onSceneChanged(void*);
  void showNote();
  void tell(const std::string& message);
  void say(const std::string& news);
  bool finish(std::string& message);

  ViewScene& scene_;
  ViewOptions options_;
  HapticParameters parameters_; ///< As the servo loop has them.
  double voxelSize_ = 0.0;      ///< As the slider set it, metres; 0: as the options say.
  std::vector<std::string> files_;
  std::size_t fileIndex_ = 0;
  std::vector<std::string> shown_; ///< What the window shows: one of files_, or all together.
  FileWatch watch_;
  int sinceLook_ = 0;
  int writtenSettings_ = 0;
  vtkNew<vtkRenderWindow> window_;
  vtkNew<vtkRenderWindowInteractor> interactor_;
  vtkNew<vtkInteractorStyleHaptic> style_;
  vtkNew<vtkHapticChart> chart_;
  vtkNew<vtkHapticChart> wholeChart_; // for --force-chart
  vtkNew<vtkHapticOverlay> overlay_;
  vtkNew<vtkHapticSliders> sliders_;
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
  style_->SetDeviceNote(device_ ? device_->name() : "none");
  // Where there is none, it may be plugged in later; where there is no driver, the window does without.
  static_cast<void>(spaceMouse_.start());
  style_->SetSpaceMouse(&spaceMouse_);
  return true;
}

/// After the first scene was published: a path must not begin in an empty world.
bool Window::startServo(std::string& message)
{
  const ServoSettings settings = falcon_ ? pushingServoSettings(1000.0) : ServoSettings();
  const Status status = device_ ? servo_.start(*device_, parameters_, settings, &message) : Status::Ok;
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
  this->observe(vtkInteractorStyleHaptic::NextFileEvent, &Window::onNextFile);
  this->observe(vtkInteractorStyleHaptic::PreviousFileEvent, &Window::onPreviousFile);
  this->observe(vtkInteractorStyleHaptic::WriteSettingsEvent, &Window::onWriteSettings);
  interactor_->SetInteractorStyle(style_);
  this->connectSliders();
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
    style_->SetDeviceNote(fmt::format("falcon, {}", name(state)));
    this->say(advice(state));
  }
  if (options_.watch && ++sinceLook_ >= kLooksApart)
  {
    sinceLook_ = 0;
    if (watch_.look() && this->show(shown_, true))
    {
      this->say("read again: " + scene_.title());
    }
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
  if (!files.empty() &&
    this->show(options_.together ? files : std::vector<std::string>{ files.front() }, false))
  {
    files_ = files;
    fileIndex_ = 0;
  }
}

/// False: they cannot be read, which the window says; it shows what it showed before.
bool Window::show(const std::vector<std::string>& files, bool keepsModel)
{
  std::string message;
  if (!scene_.open(files, options_, message))
  {
    this->tell(message);
    return false;
  }
  shown_ = files;
  watch_.watch(shown_);
  if (voxelSize_ > 0.0)
  {
    scene_.resampler()->SetVoxelSize(voxelSize_);
  }
  scene_.bandwidth()->SetRadiusScale(sliders_->GetValue(vtkHapticSliders::RadiusScale));
  vtkNew<vtkMatrix4x4> model;
  model->DeepCopy(keepsModel ? style_->GetModelTransform()->GetMatrix() : scene_.modelMatrix());
  // From here on the window shows the new cloud, also where nothing of it lies in the workspace.
  if (!scene_.build(options_, message))
  {
    this->tell(message);
  }
  double bounds[6];
  scene_.getWorkspaceBounds(bounds);
  style_->SetWorkspaceBounds(bounds);
  style_->SetModelMatrix(model);
  style_->SetResampler(scene_.resampler());
  style_->UpdateModel();
  if (!keepsModel)
  {
    scene_.placeCamera();
  }
  window_->SetWindowName(("PointHaptics: " + scene_.title()).c_str());
  this->showSliderValues();
  return true;
}

void Window::showFile(std::size_t index)
{
  if (options_.together || files_.size() < 2)
  {
    this->say("there is no other file");
  }
  else if (this->show({ files_[index] }, false))
  {
    fileIndex_ = index;
    this->say(fmt::format("file {} of {}: {}", index + 1, files_.size(), scene_.title()));
  }
  else
  {
    fileIndex_ = index; // the next key goes on from here, not to the broken file again
  }
}

void Window::onNextFile(void*)
{
  this->showFile((fileIndex_ + 1) % files_.size());
}

void Window::onPreviousFile(void*)
{
  this->showFile((fileIndex_ + files_.size() - 1) % files_.size());
}

/// All that --config needs to come back to what the window shows.
nlohmann::ordered_json Window::settings()
{
  nlohmann::ordered_json settings = options_.given;
  double bounds[6];
  scene_.getWorkspaceBounds(bounds);
  setModel(settings, style_->GetModelTransform()->GetMatrix(), bounds);
  if (voxelSize_ > 0.0)
  {
    setVoxel(settings, voxelSize_);
  }
  settings["stiffness"] = parameters_.contact.stiffness;
  settings["mu-s"] = parameters_.contact.staticFriction;
  settings["mu-d"] = parameters_.contact.dynamicFriction;
  settings["beta"] = sliders_->GetValue(vtkHapticSliders::RadiusScale);
  const int* size = window_->GetSize();
  settings["size"] = fmt::format("{}x{}", size[0], size[1]);
  return settings;
}

void Window::onWriteSettings(void*)
{
  const std::string name = freeFileName("json", writtenSettings_);
  std::string message;
  if (writeSettings(this->settings(), name, message))
  {
    this->say("settings: " + name);
  }
  else
  {
    this->tell(message);
  }
}

void Window::connectSliders()
{
  sliders_->SetInteractor(interactor_);
  this->showSliderValues();
  vtkNew<vtkCallbackCommand> moved;
  moved->SetClientData(this);
  moved->SetCallback([](vtkObject*, unsigned long, void* window, void* slider)
    { static_cast<Window*>(window)->onSlider(*static_cast<int*>(slider)); });
  sliders_->AddObserver(vtkHapticSliders::ValueChangedEvent, moved);
  style_->SetSliders(sliders_);
}

void Window::showSliderValues()
{
  double voxel[3];
  scene_.getVoxel(voxel);
  sliders_->SetValue(vtkHapticSliders::Stiffness, parameters_.contact.stiffness);
  sliders_->SetValue(vtkHapticSliders::Friction, parameters_.contact.dynamicFriction);
  sliders_->SetValue(vtkHapticSliders::RadiusScale, scene_.bandwidth()->GetRadiusScale());
  sliders_->SetValue(vtkHapticSliders::VoxelSize, 1e3 * std::cbrt(voxel[0] * voxel[1] * voxel[2]));
}

void Window::onSlider(int slider)
{
  const double value = sliders_->GetValue(slider);
  ContactParameters contact = parameters_.contact;
  switch (slider)
  {
    case vtkHapticSliders::Stiffness:
      contact.stiffness = value;
      this->setContact(contact);
      break;
    case vtkHapticSliders::Friction:
      contact.dynamicFriction = value;
      contact.staticFriction = std::max(value, options_.contact.staticFriction);
      this->setContact(contact);
      break;
    case vtkHapticSliders::RadiusScale:
      scene_.bandwidth()->SetRadiusScale(value);
      style_->InvalidateModel();
      break;
    default:
      voxelSize_ = 1e-3 * value;
      scene_.resampler()->SetVoxelSize(voxelSize_);
      style_->InvalidateModel();
  }
}

/// A device may refuse what it cannot render: then everything stays as it was, and the window says why.
void Window::setContact(const ContactParameters& contact)
{
  HapticParameters parameters = parameters_;
  parameters.contact = contact;
  std::string message;
  const Status status = device_ ? servo_.setParameters(parameters, &message) : parameters.check();
  if (status == Status::Ok)
  {
    parameters_ = parameters;
    return;
  }
  this->showSliderValues();
  this->tell(message.empty() ? sentence(status) : message);
}

void Window::onScreenshot(void*)
{
  const std::string name = freeFileName("png", screenshots_);
  std::string message;
  scene_.detail().showAllOnce();
  window_->Render();
  say(writePicture(window_, name, message) ? "screenshot: " + name : message);
}

bool Window::finish(std::string& message)
{
  style_->StopUpdates();
  rememberSettings(this->settings());
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
  shown_ = options_.firstFiles();
  watch_.watch(shown_);
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
