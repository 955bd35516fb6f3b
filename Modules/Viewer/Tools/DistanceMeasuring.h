/// @file
/// Distances between points of a cloud under the mouse.
#pragma once

#include "LeftButton.h"

#include <array>
#include <functional>
#include <string>

class vtkRenderWindowInteractor;

namespace pointhaptics
{

class ViewScene;
struct HapticViewerOptions;

/// While it is on, clicks choose points: two are the ends of a distance, which stays until a third click
/// begins another. Drags turn the view as ever. GUI thread only.
class DistanceMeasuring
{
public:
  /// All must outlive this, the interactor aside. @p say shows the measured distance to the person.
  DistanceMeasuring(ViewScene& scene, HapticViewerOptions& options, vtkRenderWindowInteractor* interactor,
    std::function<void(const std::string&)> say);

  /// Turns measuring on, or off where no distance is in the picture. @p key is the command's, for the words.
  void toggle(const std::string& key);
  bool isOn() const { return isOn_; }
  /// Turns measuring off. False: it was off, and nothing was measured.
  bool end();

private:
  void follow(const LeftButton::Event& event);
  void choose();
  void show();

  ViewScene& scene_;
  HapticViewerOptions& options_;
  std::function<void(const std::string&)> say_;
  bool isOn_ = false;
  bool isPressed_ = false;
  std::array<int, 2> pressedAt_{};
  LeftButton button_; ///< Last member, as it calls this object.
};

} // namespace pointhaptics
