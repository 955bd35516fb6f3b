#include "vtkHapticSliders.h"

#include "EventLink.h"

#include "vtkCoordinate.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkProperty2D.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkSliderRepresentation2D.h"
#include "vtkSliderWidget.h"
#include "vtkTextActor.h"
#include "vtkTextProperty.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

vtkStandardNewMacro(vtkHapticSliders);

namespace
{

struct Kind
{
  const char* title;
  double minimum;
  double maximum;
  double value;
  bool logarithmic;
};

constexpr Kind kKinds[vtkHapticSliders::NumberOfSliders] = {
  { "stiffness (N/m)", 50.0, 5000.0, 800.0, true },
  { "friction", 0.0, 1.0, 0.0, false },
  { "beta", 1.0, 16.0, 4.0, true },
  { "voxel (mm)", 0.1, 10.0, 1.0, true },
};

/// Normalized to the window: the lowest slider, and the step to the one above it.
constexpr double kLeft = 0.83;
constexpr double kRight = 0.98;
constexpr double kLowest = 0.30;
constexpr double kRow = 0.1;
constexpr double kTextAbove = 0.022;
constexpr double kPlate = 0.6; // opacity behind a text
/// Pixels of a column that is laid out, and the height of a slider with its text over that of the text.
constexpr double kLeastWidth = 96.0;
constexpr double kHalfKnob = 0.06; // over the length of the way
constexpr double kSliderPerText = 2.4;
/// Height of a slider within the room below the text, as a fraction.
constexpr double kSliderAt = 0.5;

struct One
{
  Kind kind;
  vtkNew<vtkSliderRepresentation2D> picture;
  vtkNew<vtkSliderWidget> widget;
  vtkNew<vtkTextActor> text;
  vtkHapticSliders* owner = nullptr;
  int index = 0;
  pointhaptics::EventLink moved{ [this] { this->owner->MoveTo(this->index, this->picture->GetValue()); } };

  double toPart(double value) const
  {
    return this->kind.logarithmic
      ? std::log(value / this->kind.minimum) / std::log(this->kind.maximum / this->kind.minimum)
      : (value - this->kind.minimum) / (this->kind.maximum - this->kind.minimum);
  }
  double toValue(double part) const
  {
    return this->kind.logarithmic
      ? this->kind.minimum * std::pow(this->kind.maximum / this->kind.minimum, part)
      : this->kind.minimum + part * (this->kind.maximum - this->kind.minimum);
  }
  void take(double value)
  {
    this->kind.value = value;
    char words[80];
    std::snprintf(words, sizeof(words), "%s  %.3g", this->kind.title, value);
    this->text->SetInput(words);
    this->picture->SetValue(this->toPart(value));
  }
};

void place(One& one)
{
  const double row = kLowest + kRow * (vtkHapticSliders::NumberOfSliders - 1 - one.index);
  vtkSliderRepresentation2D* picture = one.picture;
  picture->SetMinimumValue(0.0);
  picture->SetMaximumValue(1.0);
  picture->ShowSliderLabelOff();
  picture->SetTitleText("");
  picture->GetPoint1Coordinate()->SetCoordinateSystemToNormalizedViewport();
  picture->GetPoint2Coordinate()->SetCoordinateSystemToNormalizedViewport();
  picture->GetPoint1Coordinate()->SetValue(kLeft, row);
  picture->GetPoint2Coordinate()->SetValue(kRight, row);
  picture->SetTubeWidth(0.004);
  picture->SetSliderLength(0.010);
  picture->SetSliderWidth(0.024);
  picture->SetEndCapLength(0.002);
  picture->SetEndCapWidth(0.012);
  picture->GetTubeProperty()->SetColor(0.45, 0.46, 0.50);
  picture->GetCapProperty()->SetColor(0.45, 0.46, 0.50);
  picture->GetSliderProperty()->SetColor(0.10, 0.35, 0.65);
  picture->GetSelectedProperty()->SetColor(0.80, 0.33, 0.0);
  one.text->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  one.text->SetPosition(kRight, row + kTextAbove);
  vtkTextProperty* text = one.text->GetTextProperty();
  text->SetFontSize(15);
  text->SetJustificationToRight(); // in a small window it grows over the picture, not out of it
  text->SetColor(0.08, 0.08, 0.10);
  text->SetBackgroundColor(1.0, 1.0, 1.0);
  text->SetBackgroundOpacity(kPlate);
}

} // namespace

struct vtkHapticSliders::Internals
{
  std::array<One, NumberOfSliders> sliders;
  /// Over the whole window: VTK's sliders are drawn and caught at different places in a part of one.
  vtkNew<vtkRenderer> renderer;
  /// VTK's sliders look for the part that is pressed in what they have drawn, and crash where that is
  /// nothing.
  pointhaptics::EventLink drawn{ [this]
    {
      for (One& one : this->sliders)
      {
        one.widget->ProcessEventsOn();
      }
    } };
  vtkRenderWindowInteractor* interactor = nullptr;
  bool visible = false;
  bool covered = false;
};

vtkHapticSliders::vtkHapticSliders()
  : Parts(new Internals)
{
  this->Parts->renderer->SetLayer(1);
  this->Parts->renderer->InteractiveOff();
  this->Parts->renderer->DrawOff();
  this->Parts->drawn.follow(this->Parts->renderer, vtkCommand::EndEvent);
  for (int i = 0; i < NumberOfSliders; ++i)
  {
    One& one = this->Parts->sliders[i];
    one.kind = kKinds[i];
    one.owner = this;
    one.index = i;
    place(one);
    this->Parts->renderer->AddActor2D(one.text);
    one.take(one.kind.value);
    one.widget->SetRepresentation(one.picture);
    one.widget->SetAnimationModeToJump();
    one.widget->KeyPressActivationOff(); // its key is one of the style's
    one.moved.follow(one.widget, vtkCommand::InteractionEvent);
  }
}

vtkHapticSliders::~vtkHapticSliders()
{
  this->SetVisibility(false);
}

void vtkHapticSliders::SetInteractor(vtkRenderWindowInteractor* interactor)
{
  Internals& parts = *this->Parts;
  this->SetVisibility(false);
  if (parts.interactor && parts.interactor->GetRenderWindow())
  {
    parts.interactor->GetRenderWindow()->RemoveRenderer(parts.renderer);
  }
  parts.interactor = interactor;
  if (interactor && interactor->GetRenderWindow())
  {
    interactor->GetRenderWindow()->SetNumberOfLayers(2);
    interactor->GetRenderWindow()->AddRenderer(parts.renderer);
  }
  for (One& one : parts.sliders)
  {
    one.widget->SetInteractor(interactor);
    one.widget->SetCurrentRenderer(interactor ? parts.renderer.Get() : nullptr);
  }
}

void vtkHapticSliders::SetValue(int slider, double value)
{
  if (slider < 0 || slider >= NumberOfSliders || !std::isfinite(value))
  {
    return;
  }
  One& one = this->Parts->sliders[slider];
  if (one.kind.logarithmic && !(value > 0.0))
  {
    return;
  }
  one.kind.minimum = std::min(one.kind.minimum, value);
  one.kind.maximum = std::max(one.kind.maximum, value);
  one.take(value);
}

double vtkHapticSliders::GetValue(int slider) const
{
  return slider >= 0 && slider < NumberOfSliders ? this->Parts->sliders[slider].kind.value : 0.0;
}

void vtkHapticSliders::MoveTo(int slider, double part)
{
  if (slider >= 0 && slider < NumberOfSliders && std::isfinite(part))
  {
    One& one = this->Parts->sliders[slider];
    one.take(one.toValue(std::min(std::max(part, 0.0), 1.0)));
    this->InvokeEvent(ValueChangedEvent, &slider);
  }
}

void vtkHapticSliders::SetVisibility(bool visible)
{
  if (!this->Parts->interactor)
  {
    return;
  }
  this->Parts->visible = visible;
  this->ShowOrHide();
}

void vtkHapticSliders::SetCovered(bool covered)
{
  if (covered != this->Parts->covered && this->Parts->interactor)
  {
    this->Parts->covered = covered;
    this->ShowOrHide();
  }
}

void vtkHapticSliders::SetOpaque(bool opaque)
{
  for (One& one : this->Parts->sliders)
  {
    one.text->GetTextProperty()->SetBackgroundOpacity(opaque ? 1.0 : kPlate);
  }
}

void vtkHapticSliders::ShowOrHide()
{
  const bool isSeen = this->Parts->visible && !this->Parts->covered;
  this->Parts->renderer->SetDraw(isSeen);
  for (One& one : this->Parts->sliders)
  {
    one.widget->SetEnabled(isSeen);
    one.widget->ProcessEventsOff(); // until it is drawn
  }
}

double vtkHapticSliders::WayLength() const
{
  return std::max(kLeastWidth, (kRight - kLeft) * this->Parts->renderer->GetSize()[0]);
}

void vtkHapticSliders::Measure(int font, double size[2])
{
  size[0] = (1.0 + 2.0 * kHalfKnob) * this->WayLength();
  size[1] = 0.0;
  for (One& one : this->Parts->sliders)
  {
    one.text->GetTextProperty()->SetFontSize(font);
    double text[2] = { 0.0, 0.0 };
    one.text->GetSize(this->Parts->renderer, text);
    size[0] = std::max(size[0], text[0]);
    size[1] += kSliderPerText * text[1];
  }
}

void vtkHapticSliders::PreferredPlace(const double size[2], double box[4]) const
{
  const int* window = this->Parts->renderer->GetSize();
  const double text = size[1] / (NumberOfSliders * kSliderPerText);
  const double step = kRow * window[1];
  box[2] = kRight * window[0] + kHalfKnob * this->WayLength();
  box[0] = box[2] - size[0];
  box[1] = kLowest * window[1] - kSliderAt * (step - text);
  box[3] = box[1] + NumberOfSliders * step;
}

void vtkHapticSliders::Place(double left, double bottom, double right, double top)
{
  const int* window = this->Parts->renderer->GetSize();
  // As long as without a layout, where there is room.
  const double length = std::min((right - left) / (1.0 + 2.0 * kHalfKnob), this->WayLength());
  const double knob = kHalfKnob * length;
  const double step = (top - bottom) / NumberOfSliders;
  for (One& one : this->Parts->sliders)
  {
    double text[2] = { 0.0, 0.0 };
    one.text->GetSize(this->Parts->renderer, text);
    const double row = top - (one.index + 1) * step;
    const double way = row + kSliderAt * (step - text[1]);
    one.picture->GetPoint1Coordinate()->SetValue((right - knob - length) / window[0], way / window[1]);
    one.picture->GetPoint2Coordinate()->SetValue((right - knob) / window[0], way / window[1]);
    one.text->SetPosition(right / window[0], (row + step - text[1]) / window[1]);
    one.text->GetTextProperty()->SetVerticalJustificationToBottom();
    // Else the knob follows with the next picture that is drawn anew, and its words are there at once.
    one.picture->Modified();
    one.picture->BuildRepresentation();
  }
}

bool vtkHapticSliders::GetVisibility() const
{
  return this->Parts->visible;
}
