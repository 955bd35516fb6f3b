/// @file
/// Distances between points of a cloud under the mouse.
#pragma once

#include "HeightProfile.h"
#include "LeftButton.h"

#include <array>

namespace pointhaptics
{

/// While it is on, clicks choose points: two are the ends of a distance, which stays until a third click
/// begins another. Drags turn the view as ever. GUI thread only.
class DistanceMeasuring
{
public:
  /// Both must outlive this. The profile follows the measured line.
  DistanceMeasuring(const ToolContext& context, HeightProfile& profile);

  /// Turns measuring on, or off where no distance is in the picture.
  void toggle();
  bool isOn() const { return isOn_; }
  /// Turns measuring off. False: it was off, and nothing was measured.
  bool end();

private:
  void follow(const LeftButton::Event& event);
  void choose();
  void show();

  const ToolContext& context_;
  HeightProfile& profile_;
  bool isOn_ = false;
  bool isPressed_ = false;
  std::array<int, 2> pressedAt_{};
  LeftButton button_; ///< Last member, as it calls this object.
};

} // namespace pointhaptics
