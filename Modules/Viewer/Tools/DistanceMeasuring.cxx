#include "DistanceMeasuring.h"

#include "HapticViewerOptions.h"
#include "ViewScene.h"

#include "IO/Info/LengthUnit.h"

#include <cmath>
#include <utility>
#include <vector>

namespace pointhaptics
{
namespace
{

/// Priority below that of sliders and colour bar, which keep their events.
constexpr float kJustBeforeTheStyle = 0.1F;
/// A button that is let go farther away, pixels, was a drag.
constexpr double kClick = 3.0;
/// Coordinates of a measured distance: two points.
constexpr std::size_t kNumbersOfTwoEnds = 6;

} // namespace

DistanceMeasuring::DistanceMeasuring(ViewScene& scene, HapticViewerOptions& options,
  vtkRenderWindowInteractor* interactor, std::function<void(const std::string&)> say)
  : scene_(scene)
  , options_(options)
  , say_(std::move(say))
  , button_(interactor, kJustBeforeTheStyle,
      [this](const LeftButton::Event& event)
      {
        this->follow(event);
        return false;
      })
{
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

void DistanceMeasuring::follow(const LeftButton::Event& event)
{
  if (event.kind == LeftButton::Kind::Press)
  {
    isPressed_ = isOn_ && event.isPlain;
    pressedAt_ = { event.x, event.y };
  }
  else if (event.kind == LeftButton::Kind::Release && std::exchange(isPressed_, false) && isOn_ &&
    std::hypot(event.x - pressedAt_[0], event.y - pressedAt_[1]) <= kClick)
  {
    this->choose();
  }
}

/// Takes the point under the pointer as the next end.
void DistanceMeasuring::choose()
{
  Vec3 place;
  if (!scene_.placeAt(pressedAt_[0], pressedAt_[1], place))
  {
    say_("measuring: no point is there; click on one");
    return;
  }
  place = fromLocalFrame(scene_.cloud(), place);
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
  button_.render();
}

} // namespace pointhaptics
