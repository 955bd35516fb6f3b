#include "Messages.h"
#include "ViewSettings.h"
#include "ViewWindowInternals.h"

#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include <fmt/format.h>
#include <vtkCallbackCommand.h>
#include <vtkMatrix4x4.h>
#include <vtkRenderer.h>
#include <vtkStringArray.h>
#include <vtkTransform.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>

namespace pointhaptics
{
namespace app
{
namespace
{

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

} // namespace

void ViewWindow::onFilesDropped(void* callData)
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
bool ViewWindow::show(const std::vector<std::string>& files, bool keepsModel)
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
  scene_.placeAxes(style_->GetModelTransform()->GetMatrix());
  if (!keepsModel)
  {
    scene_.placeCamera();
  }
  window_->SetWindowName(("PointHaptics: " + scene_.title()).c_str());
  this->showSliderValues();
  this->findIdeal();
  return true;
}

/// The exact force for the chart, where the shown cloud is a shape that has one.
void ViewWindow::findIdeal()
{
  const std::shared_ptr<IdealForce> ideal = idealFor(scene_, options_);
  wholeIdeal_ = ideal ? std::make_shared<IdealForce>(*ideal) : nullptr;
  style_->SetIdealForce(ideal ? [this, ideal](const Vec3& hip)
      { return idealForce(*ideal, scene_, hip, parameters_.contact.stiffness); }
                              : std::function<double(const Vec3&)>());
}

void ViewWindow::showFile(std::size_t index)
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

void ViewWindow::onNextFile(void*)
{
  this->showFile((fileIndex_ + 1) % files_.size());
}

void ViewWindow::onPreviousFile(void*)
{
  this->showFile((fileIndex_ + files_.size() - 1) % files_.size());
}

/// All that --config needs to come back to what the window shows.
nlohmann::ordered_json ViewWindow::settings()
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
  setCamera(settings, scene_.renderer()->GetActiveCamera());
  settings["push-pointer"] = style_->GetPushPointer();
  settings["axes"] = scene_.showsAxes();
  settings["figure"] = scene_.isFigure();
  const int* size = window_->GetSize();
  settings["size"] = fmt::format("{}x{}", size[0], size[1]);
  return settings;
}

void ViewWindow::onWriteSettings(void*)
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

void ViewWindow::connectSliders()
{
  sliders_->SetInteractor(interactor_);
  this->showSliderValues();
  vtkNew<vtkCallbackCommand> moved;
  moved->SetClientData(this);
  moved->SetCallback([](vtkObject*, unsigned long, void* window, void* slider)
    { static_cast<ViewWindow*>(window)->onSlider(*static_cast<int*>(slider)); });
  sliders_->AddObserver(vtkHapticSliders::ValueChangedEvent, moved);
  style_->SetSliders(sliders_);
}

void ViewWindow::showSliderValues()
{
  double voxel[3];
  scene_.getVoxel(voxel);
  sliders_->SetValue(vtkHapticSliders::Stiffness, parameters_.contact.stiffness);
  sliders_->SetValue(vtkHapticSliders::Friction, parameters_.contact.dynamicFriction);
  sliders_->SetValue(vtkHapticSliders::RadiusScale, scene_.bandwidth()->GetRadiusScale());
  sliders_->SetValue(vtkHapticSliders::VoxelSize, 1e3 * std::cbrt(voxel[0] * voxel[1] * voxel[2]));
}

void ViewWindow::onSlider(int slider)
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
void ViewWindow::setContact(const ContactParameters& contact)
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

void ViewWindow::onAxes(void*)
{
  scene_.showAxes(!scene_.showsAxes());
  scene_.placeAxes(style_->GetModelTransform()->GetMatrix());
}

void ViewWindow::onFigure(void*)
{
  this->showFigure(!scene_.isFigure());
}

/// Texts, chart and sliders go; those that the user opens in the figure are shown.
void ViewWindow::showFigure(bool figure)
{
  scene_.showFigure(figure);
  scene_.placeAxes(style_->GetModelTransform()->GetMatrix());
  overlay_->RemoveFrom(scene_.renderer());
  if (figure)
  {
    sliders_->SetVisibility(false);
    chartBesideFigure_ = chart_->GetVisibility();
  }
  else
  {
    overlay_->AddTo(scene_.renderer());
  }
  style_->SetChartVisibility(!figure && chartBesideFigure_);
}

void ViewWindow::onScreenshot(void*)
{
  const std::string name = freeFileName("png", screenshots_);
  std::string message;
  scene_.detail().showAllOnce();
  window_->Render();
  say(writePicture(window_, name, message) ? "screenshot: " + name : message);
}

} // namespace app
} // namespace pointhaptics
