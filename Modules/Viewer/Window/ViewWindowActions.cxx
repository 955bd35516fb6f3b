#include "ViewPicture.h"
#include "ViewWindow.h"

#include "ClippedCloud.h"
#include "PolyDataAccess.h"
#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include <fmt/format.h>
#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkMatrix4x4.h>
#include <vtkRenderer.h>
#include <vtkStringArray.h>
#include <vtkTransform.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>

namespace pointhaptics
{
namespace
{

constexpr const char* kAsSoonAsComputed = ", as soon as it is computed";
constexpr auto kLateEscape = std::chrono::milliseconds(700);
/// A second Escape within this time quits while the touch is recorded.
constexpr auto kRepeatedEscape = std::chrono::seconds(5);

} // namespace

void ViewWindow::onFilesDropped(void* callData)
{
  auto* names = static_cast<vtkStringArray*>(callData);
  std::vector<std::string> files;
  for (vtkIdType i = 0; names && i < names->GetNumberOfValues(); ++i)
  {
    files.push_back(names->GetValue(i));
  }
  if (!files.empty())
  {
    this->load(options_.together ? files : std::vector<std::string>{ files.front() }, Load::New,
      [this, files](bool isShown)
      {
        if (isShown)
        {
          files_ = files;
          fileIndex_ = 0;
        }
      });
  }
}

/// Begins to read files; a load in flight is given up.
void ViewWindow::load(const std::vector<std::string>& files, Load kind, std::function<void(bool)> then)
{
  HapticViewerOptions options = options_;
  if (kind == Load::New)
  {
    options.clip.clear(); // it is of another cloud, as are colours that nobody asked for on the way in
    options.colorBy = askedColorBy_;
    options.picture.colorRange = askedColorRange_;
    options.picture.hidden.clear();
  }
  options.up = this->upOf(files.front());
  if (voxelSize_ > 0.0)
  {
    options.voxels.lattice.voxelSize = voxelSize_;
  }
  options.bandwidth.radiusScale = sliders_->GetValue(vtkHapticSliders::RadiusScale);
  loading_ = { files, kind, options, std::move(then), FileWatch() };
  loading_.watch.watch(files);
  CloudRequest request = CloudRequest::of(files, options);
  request.makesScene = true;
  request.measuresLater = true;
  request.resamplesLater = true;
  request.mostPoints = kind == Load::New ? options.coarsePoints : 0;
  if (kind == Load::Finer)
  {
    request.before = scene_.showing();
  }
  AffineTransform model;
  if (kind != Load::New && affineFromTransform(style_->GetModelTransform(), model))
  {
    request.placement = transformOf(scene_.modelMatrix());
    request.model = model;
  }
  loader_.start(std::move(request));
}

/// Reads all points of a cloud that is shown coarsely.
void ViewWindow::refine()
{
  this->load(shown_, Load::Finer,
    [this](bool isShown)
    {
      if (isShown)
      {
        this->say(fmt::format("{}: all {} points", scene_.title(), scene_.numberOfPoints()));
      }
    });
}

/// Called at every timer event.
void ViewWindow::followLoading()
{
  if (!loader_.busy())
  {
    return;
  }
  LoadedCloud cloud;
  std::string message;
  if (!loader_.take(cloud, message))
  {
    const CloudLoader::Step step = loader_.step();
    const std::string words =
      step.name + std::string(loading_.kind == Load::Finer ? " all of " : " ") + titleOf(loading_.files);
    if (loader_.seconds() > kProgressDelay && progress_->SetProgress(words, step.part))
    {
      window_->SetWindowName(("PointHaptics: " + words).c_str());
      interactor_->Render();
    }
    return;
  }
  if (!message.empty())
  {
    this->tell(message); // the window shows what it showed before
    this->endLoading(false);
    return;
  }
  const std::vector<std::string> notes =
    loading_.kind == Load::Finer ? std::vector<std::string>() : cloud.notes; // they were told
  this->show(std::move(cloud));
  this->endLoading(true);
  this->warn(notes);
  if (scene_.isCoarse())
  {
    this->refine();
  }
}

/// Reports each note of the readers as a warning.
void ViewWindow::warn(const std::vector<std::string>& notes)
{
  for (const std::string& note : notes)
  {
    this->report(HapticViewerObserver::Kind::Warning, note);
  }
  if (!notes.empty())
  {
    news_ += (news_.empty() ? "" : "\n") + shortNote(notes);
    this->showNote();
  }
}

void ViewWindow::endLoading(bool isShown)
{
  if (progress_->Hide())
  {
    window_->SetWindowName(("PointHaptics: " + scene_.title()).c_str());
    this->forgiveEscape();
    interactor_->Render();
  }
  const Loading ended = std::move(loading_);
  loading_ = Loading();
  ended.then(isShown);
}

void ViewWindow::cancelLoading()
{
  loader_.cancel();
  const bool isFiner = loading_.kind == Load::Finer;
  this->say(titleOf(loading_.files) + ": not read" + (isFiner ? " to its end" : "") +
    ", it was cancelled; the " + (isFiner ? "coarse level" : "former cloud") + " stays");
  this->endLoading(false);
}

void ViewWindow::forgiveEscape()
{
  escapeIsLate_ = std::chrono::steady_clock::now() + kLateEscape;
}

/// Escape leaves the first thing that is on, and quits where nothing is.
void ViewWindow::leave()
{
  const auto now = std::chrono::steady_clock::now();
  if (loader_.busy())
  {
    this->cancelLoading();
    return;
  }
  if (overlay_->GetHelpVisibility())
  {
    overlay_->SetHelpVisibility(false);
    return;
  }
  if (now < escapeIsLate_ || this->endProfile() || measuring_.end() || clipping_.hide() ||
    controls_.endWalk() || controls_.leaveFullScreen())
  {
    return;
  }
  if (style_->GetHand().followsMouse())
  {
    style_->GetCommands().run("hand-mode");
    return;
  }
  if (recording_.isOpen() && now > escapeQuits_)
  {
    escapeQuits_ = now + kRepeatedEscape;
    this->say("recording: " + style_->GetCommands().label("leave") + " once more ends it and quits");
    return;
  }
  style_->GetCommands().run("quit");
}

void ViewWindow::show(LoadedCloud cloud)
{
  const bool isNew = loading_.kind == Load::New;
  // A file that changed so much that it is placed anew is looked at anew; what was chosen for it stays.
  const bool keepsModel = !isNew && cloud.placement == transformOf(scene_.modelMatrix()) &&
    areAlike(cloud.workspace, scene_.workspace());
  const AffineTransform model = cloud.model;
  std::string message;
  if (!this->endRecording(message, "another cloud is shown"))
  {
    this->tell(message);
  }
  if (player_)
  {
    player_->stop(); // it is of the former cloud
  }
  shown_ = loading_.files;
  watch_ = loading_.watch;
  // From here on the window shows the new cloud, also where none of it lies in the workspace.
  if (!scene_.open(std::move(cloud), loading_.options, message))
  {
    this->tell(message);
  }
  double bounds[6];
  scene_.getWorkspaceBounds(bounds);
  style_->SetWorkspaceBounds(bounds);
  style_->SetResampler(scene_.resampler());
  if (isNew)
  {
    options_.colorBy = loading_.options.colorBy;
    options_.picture.colorRange = loading_.options.picture.colorRange;
    options_.picture.measure.clear(); // they were in the first cloud
    options_.picture.hidden.clear();
    clipping_.forget();
  }
  this->setSceneOptions();
  this->adoptModel(model, keepsModel);
  this->followOptions();
  scene_.placeAxes(style_->GetModelTransform()->GetMatrix());
  scene_.setPicture(options_.picture); // as it is by now
  if (options_.picture.hidden != loading_.options.picture.hidden)
  {
    this->clipFelt();
  }
  if (isNew)
  {
    options_.camera.clear(); // it was for the first cloud
  }
  if (!keepsModel && options_.camera.empty())
  {
    scene_.placeCamera();
  }
  window_->SetWindowName(("PointHaptics: " + scene_.title()).c_str());
  this->showSliderValues();
  style_->GetScenes().poll(); // what is near the hand, before the picture
  this->findIdeal();
  this->followProfile();
}

/// Applies the options that keys changed while the cloud was read.
void ViewWindow::followOptions()
{
  if (options_.felt != loading_.options.felt)
  {
    scene_.setShowsFelt(options_.felt);
  }
  if (options_.clip != loading_.options.clip)
  {
    scene_.setClip(options_.clip);
    this->clipFelt();
  }
  if (options_.colorBy != loading_.options.colorBy && scene_.setColorBy(options_.colorBy))
  {
    this->setSceneOptions();
    style_->InvalidateModel();
  }
}

/// Gives the style the model, with the scene that came with the cloud, or with one to be made.
void ViewWindow::giveModel(vtkMatrix4x4* matrix)
{
  if (scene_.isResampled())
  {
    Status status = Status::Ok;
    style_->AdoptModel(matrix, scene_.makeScene(options_.voxels.computeCovariance, status));
  }
  else
  {
    style_->StartModel(matrix, scene_.findsLattice());
  }
}

/// Shows the cloud that was read in the frame in which it was resampled. Moves that the user made meanwhile
/// are repeated where @p keepsModel.
void ViewWindow::adoptModel(const AffineTransform& model, bool keepsModel)
{
  vtkNew<vtkMatrix4x4> kept;
  kept->DeepCopy(style_->GetModelTransform()->GetMatrix());
  AffineTransform keptModel;
  const bool isMoved =
    keepsModel && affineFromTransform(style_->GetModelTransform(), keptModel) && !(keptModel == model);
  vtkNew<vtkMatrix4x4> matrix;
  setElements(matrix, model);
  this->giveModel(matrix);
  if (isMoved)
  {
    style_->SetModelMatrix(kept);
  }
  const double radiusScale = sliders_->GetValue(vtkHapticSliders::RadiusScale);
  const bool isFiner = voxelSize_ > 0.0 && voxelSize_ != loading_.options.voxels.lattice.voxelSize;
  if (isFiner)
  {
    scene_.resampler()->SetVoxelSize(voxelSize_);
  }
  if (isFiner || radiusScale != loading_.options.bandwidth.radiusScale)
  {
    scene_.bandwidth()->SetRadiusScale(radiusScale);
    style_->InvalidateModel();
  }
}

/// Finds the exact force for the chart, where the shown cloud is a shape that has one.
void ViewWindow::findIdeal()
{
  const std::shared_ptr<IdealForce> ideal = idealFor(scene_, options_);
  wholeIdeal_ = ideal ? std::make_shared<IdealForce>(*ideal) : nullptr;
  style_->GetDisplay().setIdealForce(ideal ? [this, ideal](const ServoSample& sample)
      { return idealForce(*ideal, scene_, sample.state.hip, this->contactOf(sample)); }
                                           : std::function<double(const ServoSample&)>());
}

void ViewWindow::showFile(std::size_t index)
{
  if (files_.size() < 2)
  {
    this->say("there is no other file");
  }
  else if (options_.together)
  {
    fileIndex_ = index;
    controls_.showAlone(index);
  }
  else
  {
    // The next key continues from here, not from a broken or cancelled file.
    fileIndex_ = index;
    this->load({ files_[index] }, Load::New,
      [this, index](bool isShown)
      {
        if (isShown)
        {
          this->say(fmt::format("file {} of {}: {}", index + 1, files_.size(), scene_.title()));
        }
      });
  }
}

void ViewWindow::showNextFile()
{
  this->showFile((fileIndex_ + 1) % this->fileChoices());
}

void ViewWindow::showPreviousFile()
{
  const std::size_t count = this->fileChoices();
  this->showFile((fileIndex_ + count - 1) % count);
}

/// Each file, and all of them where they are shown together.
std::size_t ViewWindow::fileChoices() const
{
  return std::max<std::size_t>(1, files_.size()) + (options_.together ? 1 : 0);
}

HapticViewerState ViewWindow::state()
{
  HapticViewerState state;
  const double* model = style_->GetModelTransform()->GetMatrix()->GetData();
  std::copy_n(model, state.modelToWorkspace.size(), state.modelToWorkspace.begin());
  scene_.getWorkspaceBounds(state.workspace.data());
  state.voxelSize = voxelSize_;
  state.contact = parameters_.contact;
  state.radiusScale = sliders_->GetValue(vtkHapticSliders::RadiusScale);
  vtkCamera* camera = scene_.renderer()->GetActiveCamera();
  // In a parallel projection the wheel changes only the scale.
  Vec3 focus;
  Vec3 forward;
  camera->GetFocalPoint(&focus.x);
  camera->GetDirectionOfProjection(&forward.x);
  const Vec3 position = focus - scene_.viewDistance() * forward;
  std::copy_n(&position.x, 3, state.camera.begin());
  camera->GetFocalPoint(&state.camera[3]);
  camera->GetViewUp(&state.camera[6]);
  state.pushPointer = style_->GetHand().pushesPointer();
  state.axes = scene_.showsAxes();
  state.figure = scene_.isFigure();
  state.felt = options_.felt;
  state.ambient = options_.ambient;
  state.picture = options_.picture;
  state.clip = options_.clip;
  state.sound = options_.sound;
  state.fullScreen = controls_.fullScreen().isFull();
  state.colorBy = options_.colorBy;
  state.up = shown_.empty() ? std::string() : this->upOf(shown_.front());
  if (scene_.unit().name == scene_.likelyUnit().name)
  {
    state.unit = scene_.unit().name;
    state.metresPerUnit = scene_.unit().metres;
  }
  const int* size = window_->GetSize();
  state.width = size[0];
  state.height = size[1];
  return state;
}

void ViewWindow::writeSettings()
{
  if (!observer_.writeState)
  {
    return;
  }
  const std::string name = freeFileName("json", writtenSettings_);
  std::string message;
  if (observer_.writeState(this->state(), name, message))
  {
    this->say("settings: " + name);
  }
  else
  {
    this->tell(message);
  }
}

void ViewWindow::toggleAxes()
{
  scene_.showAxes(!scene_.showsAxes());
  scene_.placeAxes(style_->GetModelTransform()->GetMatrix());
}

void ViewWindow::toggleFigure()
{
  style_->GetPicker().forget();
  this->showFigure(!scene_.isFigure());
}

void ViewWindow::toggleMeasuring()
{
  measuring_.toggle(style_->GetCommands().label("measure"));
}

/// Clicks that measure set no pivot.
void ViewWindow::setPivot()
{
  if (!measuring_.isOn())
  {
    controls_.setPivot();
  }
}

/// Restricts touch to the present box. A recording ends, as it is of one cloud.
void ViewWindow::clipFelt()
{
  std::string message;
  if (!this->endRecording(message, "what is felt was clipped or hidden"))
  {
    this->tell(message);
  }
  scene_.clipFelt();
  style_->InvalidateModel();
  this->followProfile();
}

/// Shows the next of the choices to colour by.
void ViewWindow::showNextColors()
{
  const std::vector<std::string> choices = scene_.colorChoices();
  const auto shown = std::find(choices.begin(), choices.end(), scene_.colorBy());
  const std::size_t place = shown == choices.end() ? 0 : std::size_t(shown - choices.begin());
  const std::string& next = choices[(place + 1) % choices.size()];
  // Another file may have no colours: rgb is the default then.
  options_.colorBy = next == "rgb" ? std::string() : next;
  options_.picture.colorRange.clear(); // of other numbers
  scene_.setPicture(options_.picture);
  const bool waits = scene_.setColorBy(options_.colorBy);
  this->setSceneOptions();
  if (waits)
  {
    style_->InvalidateModel();
  }
  this->say("coloured by " + colorWord(next) + (waits ? kAsSoonAsComputed : ""));
  awaitedColors_ = waits ? news_ : std::string();
}

/// Clears the status when the awaited colours have come.
void ViewWindow::endAwaitingColors()
{
  if (awaitedColors_.empty() || scene_.awaitsColors())
  {
    return;
  }
  if (news_ == awaitedColors_)
  {
    this->say(news_.substr(0, news_.size() - std::string(kAsSoonAsComputed).size()));
  }
  awaitedColors_.clear();
}

void ViewWindow::toggleFelt()
{
  options_.felt = !options_.felt;
  scene_.setShowsFelt(options_.felt);
  say(options_.felt ? "shown: the voxel means that are felt" : "shown: the points of the file");
}

void ViewWindow::toggleAmbient()
{
  options_.ambient = !options_.ambient;
  scene_.showAmbient(options_.ambient);
  this->setSceneOptions();
}

/// Sets how scenes are made, and which arrays the picture needs.
void ViewWindow::setSceneOptions()
{
  SceneOptions options;
  options.useCovariance = options_.voxels.computeCovariance;
  options.refinesNearHand = !options_.hasVoxels() && voxelSize_ <= 0.0; // whoever chooses voxels feels these
  options.computeResiduals = scene_.wantsResiduals();
  options.computeNormals = options_.ambient;
  style_->GetScenes().setOptions(options);
}

/// Hides texts, chart, sliders and the handles of the clipping box; those that the user opens in the figure
/// are shown.
void ViewWindow::showFigure(bool figure)
{
  scene_.showFigure(figure);
  scene_.placeAxes(style_->GetModelTransform()->GetMatrix());
  overlay_->SetTextVisibility(!figure);
  if (figure)
  {
    overlay_->SetHelpVisibility(false);
    sliders_->SetVisibility(false);
    clipBoxBesideFigure_ = scene_.clipMark().isVisible();
  }
  scene_.clipMark().setVisible(!figure && clipBoxBesideFigure_);
  style_->GetDisplay().setFigure(figure);
}

bool ViewWindow::writeImage(const std::string& fileName, std::string& message)
{
  scene_.followMeasurement(true);
  const auto render = [this](vtkRenderWindow* window)
  {
    scene_.completeNextFrame();
    window->Render();
  };
  const PictureSettings& picture = options_.picture;
  if (picture.screenshotSize[0] > 0)
  {
    return writePictureOfSize(window_, scene_.renderer()->GetActiveCamera(), picture.screenshotSize, render,
      picture.transparent, fileName, message);
  }
  return writePicture(
    window_, [this, render] { render(window_); }, picture.transparent, fileName, message);
}

void ViewWindow::writeScreenshot()
{
  const std::string name = freeFileName("png", screenshots_);
  std::string message;
  const std::array<int, 2>& size = options_.picture.screenshotSize;
  const std::string words = size[0] > 0 ? fmt::format(" ({}x{})", size[0], size[1]) : "";
  say(this->writeImage(name, message) ? "screenshot: " + name + words : message);
}

} // namespace pointhaptics
