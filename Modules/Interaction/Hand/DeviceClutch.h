/// @file
/// The buttons of the haptic device: while one is held the hand holds the model instead of feeling it.
#pragma once

#include "CommandRegistry.h"

#include "Core/Base/Lifetime.h"
#include "Haptics/ServoLoop.h"

#include "PointHapticsInteractionModule.h" // For export macro

#include <cstdint>
#include <string>
#include <vector>

namespace pointhaptics
{

class ModelTransform;
class ScreenView;

/// Runs the commands that are bound to the device's buttons, as the servo loop reads them. The model follows
/// each tick in which the button of a GripAction was down, and no other, however late this is seen. Once the
/// button is seen the force goes to zero (ServoLoop::setClutched()); it comes back slowly once the scene of
/// the new place is felt. Other commands run when their button is pressed. GUI thread only.
class POINTHAPTICSINTERACTION_EXPORT DeviceClutch
{
public:
  /// All must outlive this.
  DeviceClutch(const CommandRegistry& commands, const ScreenView& screen, ModelTransform& model)
    : commands_(commands)
    , screen_(screen)
    , model_(model)
  {
  }
  ~DeviceClutch() { this->setServo(nullptr); }
  DeviceClutch(const DeviceClutch&) = delete;
  DeviceClutch& operator=(const DeviceClutch&) = delete;

  /// Sets the servo loop, which is not owned and may be destroyed at any time. The former loop is released
  /// from the clutch.
  void setServo(ServoLoop* servo);
  /// Name of the command that holds the model at this moment; empty: none does.
  const std::string& hold() const { return hold_; }
  bool isHolding() const { return !hold_.empty(); }
  /// Takes all ticks since the last call. True: a command was run.
  bool take(const std::vector<ServoSample>& samples);
  /// Ends the clutch: the scene of the model's new place is published, and the hand may feel it unless it
  /// holds the model.
  void letGo();

private:
  bool take(const ServoSample& sample);
  void begin(const Command* command, const Vec3& hip);
  void end();
  void moveModel();

  const CommandRegistry& commands_;
  const ScreenView& screen_;
  ModelTransform& model_;
  WatchedPointer<ServoLoop> servo_;
  std::string hold_;
  GripAction grip_; ///< Action of that command.
  std::uint32_t buttons_ = 0;
  Vec3 from_; ///< Position of the hand when it last moved the model.
  Vec3 to_;
  bool isClutched_ = false; ///< True if the servo loop was told to clutch.
};

} // namespace pointhaptics
