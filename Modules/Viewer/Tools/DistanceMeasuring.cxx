#include "DistanceMeasuring.h"

#include "CommandRegistry.h"
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

DistanceMeasuring::DistanceMeasuring(const ToolContext& context, HeightProfile& profile)
  : context_(context)
  , profile_(profile)
  , button_(context.interactor, kJustBeforeTheStyle,
      [this](const LeftButton::Event& event)
      {
        this->follow(event);
        return false;
      })
{
}

void DistanceMeasuring::toggle()
{
  const std::string key = context_.commands.label("measure");
  if (isOn_)
  {
    this->end();
    return;
  }
  isOn_ = true;
  context_.say("measuring: click on two points" + (key.empty() ? "" : "; " + key + " ends it"));
}

bool DistanceMeasuring::end()
{
  const bool wasOn = std::exchange(isOn_, false);
  if (!wasOn && context_.options.picture.measure.empty())
  {
    return false;
  }
  context_.options.picture.measure.clear();
  this->show();
  context_.say("measuring: ended");
  profile_.follow();
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
  if (!context_.scene.placeAt(pressedAt_[0], pressedAt_[1], place))
  {
    context_.say("measuring: no point is there; click on one");
    return;
  }
  place = fromLocalFrame(context_.scene.cloud(), place);
  std::vector<double>& ends = context_.options.picture.measure;
  if (ends.size() >= kNumbersOfTwoEnds)
  {
    ends.clear();
  }
  ends.insert(ends.end(), { place.x, place.y, place.z });
  this->show();
  const std::vector<std::string> words = context_.scene.measuredText();
  context_.say(words.empty() ? "measuring: click on the second point"
                             : "distance: " + words.front() + "; " + words.back());
  profile_.follow();
}

void DistanceMeasuring::show()
{
  context_.scene.setPicture(context_.options.picture);
  button_.render();
}

} // namespace pointhaptics
