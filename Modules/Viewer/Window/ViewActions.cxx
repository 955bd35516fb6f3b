// Actions of keys and sliders of the window on picture and touch.
#include "ScaleNote.h"
#include "ScreenMarks.h"
#include "ViewPicture.h"
#include "ViewWindow.h"

#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include <fmt/format.h>
#include <vtkCamera.h>
#include <vtkMatrix4x4.h>
#include <vtkPointSet.h>

#include <algorithm>
#include <array>

namespace pointhaptics
{
namespace
{

constexpr const char* kAsSoonAsComputed = ", as soon as it is computed";
constexpr auto kLateEscape = std::chrono::milliseconds(700);
/// A second Escape within this time quits while the touch is recorded.
constexpr auto kRepeatedEscape = std::chrono::seconds(5);

} // namespace

void ViewWindow::forgiveEscape()
{
  escapeIsLate_ = std::chrono::steady_clock::now() + kLateEscape;
}

/// Escape leaves the first thing that is on, and quits where nothing is.
void ViewWindow::leave()
{
  const auto now = std::chrono::steady_clock::now();
  const bool isWarned = now <= std::exchange(escapeQuits_, {});
  if (files_.cancel())
  {
    return;
  }
  if (overlay_->GetHelpVisibility())
  {
    overlay_->SetHelpVisibility(false);
    return;
  }
  if (now < escapeIsLate_ || profile_.end() || measuring_.end() || clipping_.hide() || controls_.endWalk() ||
    controls_.leaveFullScreen())
  {
    return;
  }
  if (style_->GetHand().followsMouse())
  {
    style_->GetCommands().run("hand-mode");
    return;
  }
  if (recording_.isOpen() && !isWarned)
  {
    escapeQuits_ = now + kRepeatedEscape;
    this->say("recording: " + style_->GetCommands().label("leave") + " once more ends it and quits");
    return;
  }
  style_->GetCommands().run("quit");
}

/// The options as they are now.
HapticViewerState ViewWindow::state()
{
  HapticViewerState state{ options_, {}, {} };
  const double* model = style_->GetModelTransform()->GetMatrix()->GetData();
  std::copy_n(model, state.modelToWorkspace.size(), state.modelToWorkspace.begin());
  state.workspace = scene_.workspaceBounds();
  // In a parallel projection the wheel changes only the scale.
  const CameraView view(scene_.renderer()->GetActiveCamera());
  const Vec3 position = view.focus - scene_.viewDistance() * view.forward;
  state.camera = { position.x, position.y, position.z, view.focus.x, view.focus.y, view.focus.z, view.up.x,
    view.up.y, view.up.z };
  state.pushPointer = style_->GetHand().pushesPointer();
  state.axes = scene_.showsAxes();
  state.figure = scene_.isFigure();
  state.fullScreen = controls_.fullScreen().isFull();
  state.up = files_.shown().empty() ? asked_.up : files_.upOf(files_.shown().front());
  if (scene_.unit().name == scene_.likelyUnit().name)
  {
    state.unit = scene_.unit().name;
    state.metresPerUnit = scene_.unit().metres;
    state.unitIsChosen = true;
  }
  state.width = window_->GetSize()[0];
  state.height = window_->GetSize()[1];
  return state;
}

void ViewWindow::writeSettings()
{
  if (!observer_.writeState)
  {
    return;
  }
  const std::string name = this->freeFileName("json");
  std::string message;
  const bool isWritten = observer_.writeState(this->state(), name, message);
  this->say(isWritten ? "settings: " + name : message, isWritten ? kNote : kError);
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
  this->endRecording("what is felt was clipped or hidden");
  scene_.clipFelt();
  style_->GetStatus().setEmptyCause(this->hiddenWords());
  style_->InvalidateModel();
  profile_.follow();
}

/// Says that all points are hidden, and what shows them; empty: they are not.
std::string ViewWindow::hiddenWords() const
{
  auto* felt = vtkPointSet::SafeDownCast(scene_.resampler()->GetInputDataObject(0, 0));
  const bool isAll = !options_.picture.hidden.empty() && felt && felt->GetNumberOfPoints() == 0;
  const std::string key = style_->GetCommands().label("hide-outside");
  return isAll ? "all points are hidden" + (key.empty() ? key : "; " + key + " shows all") : std::string();
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
  this->awaitColors("coloured by " + colorWord(next), scene_.setColorBy(options_.colorBy));
}

/// Says @p news. @param waits for means with the colours, which are made then.
void ViewWindow::awaitColors(const std::string& news, bool waits)
{
  this->setSceneOptions();
  if (waits)
  {
    style_->InvalidateModel();
  }
  this->say(news + (waits ? kAsSoonAsComputed : ""));
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
  this->awaitColors(options_.felt ? "shown: the voxel means that are felt" : "shown: the points of the file",
    scene_.setShowsFelt(options_.felt));
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
  options.refinesNearHand = !options_.hasVoxels(); // whoever chooses voxels feels these
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

void ViewWindow::showSliderValues()
{
  sliders_->SetValue(vtkHapticSliders::Stiffness, options_.haptics.contact.stiffness);
  sliders_->SetValue(vtkHapticSliders::Friction, options_.haptics.contact.dynamicFriction);
  sliders_->SetValue(vtkHapticSliders::RadiusScale, scene_.bandwidth()->GetRadiusScale());
  sliders_->SetValue(vtkHapticSliders::VoxelSize, 1e3 * scene_.voxelSize());
}

void ViewWindow::onSlider(int slider)
{
  const double value = sliders_->GetValue(slider);
  ContactParameters contact = options_.haptics.contact;
  switch (slider)
  {
    case vtkHapticSliders::Stiffness:
      contact.stiffness = value;
      this->setContact(contact);
      break;
    case vtkHapticSliders::Friction:
      contact.dynamicFriction = value;
      contact.staticFriction = std::max(value, asked_.haptics.contact.staticFriction);
      this->setContact(contact);
      break;
    case vtkHapticSliders::RadiusScale:
      options_.bandwidth.radiusScale = value;
      scene_.bandwidth()->SetRadiusScale(value);
      style_->InvalidateModel();
      break;
    default:
      options_.voxels.lattice.voxelSize = 1e-3 * value;
      scene_.resampler()->SetVoxelSize(1e-3 * value);
      this->setSceneOptions();
      style_->InvalidateModel();
  }
}

/// Sets the contact. A device may refuse what it cannot render: then everything stays as it was, and the
/// window says why.
void ViewWindow::setContact(const ContactParameters& contact)
{
  HapticParameters parameters = options_.haptics;
  parameters.contact = contact;
  std::string message;
  const Status status = device_ ? servo_.setParameters(parameters, &message) : parameters.check();
  if (status == Status::Ok)
  {
    options_.haptics = parameters;
    return;
  }
  this->showSliderValues();
  this->say(message.empty() ? pointhaptics::message(status) : message, kError);
}

/// Text of the present scale, and of the unit that could be taken.
std::string ViewWindow::scaleText()
{
  const LengthUnit& unit = scene_.unit();
  const LengthUnit& likely = scene_.likelyUnit();
  const std::string scale = describeScale(style_->GetModelTransform()->GetMatrix(), unit.name, unit.metres);
  const std::string key = style_->GetCommands().label("take-unit");
  const bool isOffered = !likely.name.empty() && likely.name != unit.name && !key.empty();
  return scale + (isOffered ? "    " + key + ": the file is in " + likely.name : std::string()) +
    (scene_.isUpGuessed() ? "    up is a guess: " + style_->GetCommands().label("turn-up") + " turns it"
                          : std::string());
}

/// Shows the scale and the last message.
void ViewWindow::showNote()
{
  const std::string scale = this->scaleText();
  style_->GetStatus().setNote(news_.empty() ? scale : scale + "\n" + news_);
}

/// Takes the unit that the file seems to have, or gives it back.
void ViewWindow::toggleUnit()
{
  const LengthUnit likely = scene_.likelyUnit();
  if (likely.name.empty())
  {
    this->say("the file is taken to be in " + scene_.unit().name + ", and nothing speaks for another unit");
    return;
  }
  const bool isTaken = scene_.unit().name == likely.name;
  if (!isTaken)
  {
    firstUnit_ = scene_.unit();
  }
  scene_.setUnit(isTaken ? firstUnit_ : likely);
  this->say("the file is taken to be in " + scene_.unit().name);
}

bool ViewWindow::writeImage(const std::string& fileName, std::string& message)
{
  scene_.followMeasurement(true);
  const auto render = [this](vtkRenderWindow* window)
  {
    scene_.detail().showFinestOnce();
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
  const std::string name = this->freeFileName("png");
  std::string message;
  const std::array<int, 2>& size = options_.picture.screenshotSize;
  const std::string words = size[0] > 0 ? fmt::format(" ({}x{})", size[0], size[1]) : "";
  const bool isWritten = this->writeImage(name, message);
  say(isWritten ? "screenshot: " + name + words : message, isWritten ? kNote : kError);
}

} // namespace pointhaptics
