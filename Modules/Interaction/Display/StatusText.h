/// @file
/// Texts of the interactor style: the status line and the panel of the servo loop.
#pragma once

#include "CommandRegistry.h"
#include "vtkHapticOverlay.h"

#include "PointHapticsInteractionModule.h" // For export macro

#include "vtkSmartPointer.h"

#include <string>

namespace pointhaptics
{

class DeviceClutch;
class MouseHand;
class ScenePipeline;
class ServoLoop;

/// Writes the texts, which name the present keys. GUI thread only.
class POINTHAPTICSINTERACTION_EXPORT StatusText
{
public:
  /// All must outlive this.
  StatusText(const CommandRegistry& commands, const ScenePipeline& scenes, const MouseHand& hand,
    const DeviceClutch& clutch)
    : commands_(commands)
    , scenes_(scenes)
    , hand_(hand)
    , clutch_(clutch)
  {
  }
  StatusText(const StatusText&) = delete;
  StatusText& operator=(const StatusText&) = delete;

  /// Sets the overlay that shows the texts; null: none does.
  void setOverlay(vtkHapticOverlay* overlay);
  vtkHapticOverlay* overlay() const { return overlay_; }

  /// Text at the end of the status line, such as the scale of the model.
  void setNote(const std::string& note) { this->set(note_, note); }
  /// Name and state of the device, for the panel. Empty: the device's own name.
  void setDeviceNote(const std::string& note) { this->set(deviceNote_, note); }
  /// Name of the device, until there is a note.
  void setDeviceName(const std::string& name) { this->set(deviceName_, name); }
  ///@{
  /// Show rate, latencies, missed deadlines, faults and the device. Default: off.
  void setPanelVisibility(bool visible) { this->set(showsPanel_, visible); }
  bool panelVisibility() const { return showsPanel_; }
  ///@}
  /// Why nothing is felt, and its cure; empty: the model is not in the workspace.
  void setEmptyCause(const std::string& cause) { this->set(emptyCause_, cause); }
  /// Text on the distance from the hand to the cloud; empty: none.
  void setDistance(const std::string& distance) { distance_ = distance; }
  /// Shows the help, its next page, or hides it after the last one.
  void turnHelp();
  /// Updates the help after a change of the commands.
  void updateHelp();

  /// Brings the texts up to date, four times a second, and every four seconds while nothing moves, as a line
  /// of text costs a frame. After a change of settings, of the hand's mode or of its hold it does so at once.
  /// @p servo may be null. @p touchMoved: the picture of the touch has changed. True: a text has changed.
  bool update(const ServoLoop* servo, bool touchMoved);
  /// Names the key that resets the model, as part of a sentence: ": key 0 resets the model"; empty where it
  /// has none.
  std::string resetHint() const;

private:
  /// Changes a text's part: the next update() shows it.
  template <typename Value>
  void set(Value& member, const Value& value)
  {
    member = value;
    lastUpdate_ = -1e9;
  }
  std::string statusLine(const ServoLoop* servo) const;
  std::string panel(const ServoLoop* servo) const;
  const char* handMode() const;
  std::string firstUse() const;

  const CommandRegistry& commands_;
  const ScenePipeline& scenes_;
  const MouseHand& hand_;
  const DeviceClutch& clutch_;
  vtkSmartPointer<vtkHapticOverlay> overlay_;
  std::string note_;
  std::string deviceNote_;
  std::string deviceName_;
  std::string emptyCause_;
  std::string distance_;
  bool hasTouched_ = false; ///< True once the hand has touched in hand mode: the person knows the keys then.
  bool showsPanel_ = false;
  const char* shownMode_ = nullptr;
  double lastUpdate_ = -1e9;
  double lastMotion_ = -1e9;
};

} // namespace pointhaptics
