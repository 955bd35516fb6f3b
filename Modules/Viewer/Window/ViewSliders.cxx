// Sliders of the window.
#include "ViewWindow.h"

#include "ViewScene.h"

#include "vtkHapticSliders.h"
#include "vtkInteractorStyleHaptic.h"
#include "vtkKernelBandwidthFilter.h"
#include "vtkVoxelMeanResampler.h"

#include <vtkCallbackCommand.h>
#include <vtkNew.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace pointhaptics
{

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
      contact.staticFriction = std::max(value, options_.haptics.contact.staticFriction);
      this->setContact(contact);
      break;
    case vtkHapticSliders::RadiusScale:
      scene_.bandwidth()->SetRadiusScale(value);
      style_->InvalidateModel();
      break;
    default:
      voxelSize_ = 1e-3 * value;
      scene_.resampler()->SetVoxelSize(voxelSize_);
      this->setSceneOptions();
      style_->InvalidateModel();
  }
}

/// Sets the contact. A device may refuse what it cannot render: then everything stays as it was, and the
/// window says why.
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
  this->tell(message.empty() ? pointhaptics::message(status) : message);
}

} // namespace pointhaptics
