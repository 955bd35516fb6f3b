#include "DistanceMeasuring.h"

#include "HapticViewerOptions.h"
#include "ViewScene.h"

#include <vtkCommand.h>
#include <vtkRenderWindowInteractor.h>

#include <cmath>
#include <utility>
#include <vector>

namespace pointhaptics
{
namespace
{

/// Sliders and the colour bar come first, and keep what is theirs.
constexpr float kJustBeforeTheStyle = 0.1F;
/// A button that is let go farther away, pixels, was a drag.
constexpr double kClick = 3.0;
/// Of a measured distance.
constexpr std::size_t kNumbersOfTwoEnds = 6;

} // namespace

DistanceMeasuring::DistanceMeasuring(ViewScene& scene, HapticViewerOptions& options,
  vtkRenderWindowInteractor* interactor, std::function<void(const std::string&)> say)
  : scene_(scene)
  , options_(options)
  , interactor_(interactor)
  , say_(std::move(say))
{
  command_->SetClientData(this);
  command_->SetCallback([](vtkObject*, unsigned long event, void* self, void*)
    { static_cast<DistanceMeasuring*>(self)->follow(event); });
  for (const auto event : { vtkCommand::LeftButtonPressEvent, vtkCommand::LeftButtonReleaseEvent })
  {
    interactor->AddObserver(event, command_, kJustBeforeTheStyle);
  }
}

DistanceMeasuring::~DistanceMeasuring()
{
  if (interactor_)
  {
    interactor_->RemoveObserver(command_);
  }
}

void DistanceMeasuring::toggle(const std::string& key)
{
  if (isOn_)
  {
    this->end();
    return;
  }
  isOn_ = true;
  say_("measuring: click on two points" + (key.empty() ? "" : "; " + key + " ends it"));
}

bool DistanceMeasuring::end()
{
  const bool wasOn = std::exchange(isOn_, false);
  if (!wasOn && options_.picture.measure.empty())
  {
    return false;
  }
  options_.picture.measure.clear();
  this->show();
  say_("measuring: ended");
  return true;
}

void DistanceMeasuring::follow(unsigned long event)
{
  const int* position = interactor_->GetEventPosition();
  if (event == vtkCommand::LeftButtonPressEvent)
  {
    // With a key held the button is the model's or the hand's.
    isPressed_ = isOn_ && !interactor_->GetShiftKey() && !interactor_->GetControlKey();
    pressedAt_ = { position[0], position[1] };
  }
  else if (std::exchange(isPressed_, false) && isOn_ &&
    std::hypot(position[0] - pressedAt_[0], position[1] - pressedAt_[1]) <= kClick)
  {
    this->choose();
  }
}

/// The point under the pointer is the next end.
void DistanceMeasuring::choose()
{
  Vec3 place;
  if (!scene_.placeAt(pressedAt_[0], pressedAt_[1], place))
  {
    say_("measuring: no point is there; click on one");
    return;
  }
  std::vector<double>& ends = options_.picture.measure;
  if (ends.size() >= kNumbersOfTwoEnds)
  {
    ends.clear();
  }
  ends.insert(ends.end(), { place.x, place.y, place.z });
  this->show();
  const std::vector<std::string> words = scene_.measuredText();
  say_(words.empty() ? "measuring: click on the second point"
                     : "distance: " + words.front() + "; " + words.back());
}

void DistanceMeasuring::show()
{
  scene_.setPicture(options_.picture);
  if (interactor_)
  {
    interactor_->Render();
  }
}

} // namespace pointhaptics
