/// @file
/// Moves the model by a SpaceMouse of the project's own driver.
#pragma once

#include "Core/Base/Lifetime.h"
#include "Devices/SpaceMouse/SpaceMouse.h"

#include "PointHapticsInteractionModule.h" // For export macro

#include <cstdint>

namespace pointhaptics
{

class ModelTransform;
class ScreenView;

/// Rotates and translates the model as the puck is turned and pushed on the screen. With the first button
/// held, pushing and pulling scales it and nothing else moves; the second one resets it. All moves until the
/// puck rests are one to ModelTransform::undo(). GUI thread only.
class POINTHAPTICSINTERACTION_EXPORT SpaceMouseController
{
public:
  /// Both must outlive this.
  SpaceMouseController(ModelTransform& model, const ScreenView& screen)
    : model_(model)
    , screen_(screen)
  {
  }

  /// Sets the SpaceMouse, which is not owned and may be destroyed at any time.
  void setMouse(SpaceMouse* mouse) { mouse_ = mouse; }
  /// Moves the model. Call it some 30 times a second; @p timeSeconds of a steady clock.
  void update(double timeSeconds);

private:
  void move(const SpaceMouseMotion& motion, double seconds);

  ModelTransform& model_;
  const ScreenView& screen_;
  bool isMoving_ = false;
  WatchedPointer<SpaceMouse> mouse_;
  double lastTime_ = -1e9;
  std::uint32_t lastButtons_ = 0;
};

} // namespace pointhaptics
