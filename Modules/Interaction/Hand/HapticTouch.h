/// @file
/// The touch of a program that has none yet: device, servo loop and props for an interactor style.
#pragma once

#include "vtkHapticProps.h"
#include "vtkInteractorStyleHaptic.h"

#include "Devices/HapticDevice.h"
#include "Devices/SimulatedDevice.h"
#include "Haptics/ServoLoop.h"

#include "PointHapticsInteractionModule.h" // For export macro

#include "vtkNew.h"

#include <string>

namespace pointhaptics
{

/// Adds touch to a style that has a resampler and belongs to an interactor with a window:
/// @code
/// HapticTouch touch(style); // a simulated hand under the mouse
/// touch.run();
/// @endcode
/// GUI thread only. The style may end before or after this.
class POINTHAPTICSINTERACTION_EXPORT HapticTouch
{
public:
  /// Gives the style device, servo loop and props. @p device is not owned, is closed and must outlive this;
  /// null: a simulated hand with the settings @p hand.
  explicit HapticTouch(
    vtkInteractorStyleHaptic* style, HapticDevice* device = nullptr, const SimulatedHandSettings& hand = {});
  ~HapticTouch(); ///< Stops.
  HapticTouch(const HapticTouch&) = delete;
  HapticTouch& operator=(const HapticTouch&) = delete;

  /// Shows the window, makes the scene, opens the device, and starts the servo loop and the style's timer.
  /// False: message() says what failed, and the touch is stopped; or the touch was on already and stays so. A
  /// model without a mean in the hand's box is a failure, as nothing could be touched. In a window that shows
  /// nothing yet, the means are drawn.
  bool start(const HapticParameters& parameters = {}, const ServoSettings& settings = {});
  /// Stops the loop, closes the device.
  void stop();
  /// Runs start(), events until the user closes the window, and stop(). A failure is an error of the style
  /// too, which VTK shows.
  bool run();

  const std::string& message() const { return message_; }
  ServoLoop& servo() { return servo_; }
  vtkHapticProps* props() { return props_; }
  SimulatedDevice& hand() { return hand_; } ///< Used where no device was given.

private:
  bool fail(const std::string& message);
  std::string problemOfReach() const;
  void showMeans();

  vtkSmartPointer<vtkInteractorStyleHaptic> style_;
  SimulatedDevice hand_;
  HapticDevice& device_;
  vtkNew<vtkHapticProps> props_;
  std::string message_;
  ServoLoop servo_; ///< Last member: destroyed, and so stopped, first.
};

} // namespace pointhaptics
