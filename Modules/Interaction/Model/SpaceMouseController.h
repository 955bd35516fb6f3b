/// @file
/// Moves the model by a SpaceMouse of the project's own driver.
#pragma once

#include "CapMotion.h"

#include "Core/Base/Lifetime.h"
#include "Devices/SpaceMouse/SpaceMouse.h"

#include "PointHapticsInteractionModule.h" // For export macro

#include <cstdint>

namespace pointhaptics
{

/// Rotates and translates the model as the puck is turned and pushed on the screen. With the first button
/// held, pushing and pulling scales it; the second one resets it. GUI thread only.
class POINTHAPTICSINTERACTION_EXPORT SpaceMouseController
{
public:
  /// Both must outlive this.
  SpaceMouseController(ModelTransform& model, const ScreenView& screen)
    : cap_(model, screen)
  {
  }

  /// Sets the SpaceMouse, which is not owned and may be destroyed at any time.
  void setMouse(SpaceMouse* mouse) { mouse_ = mouse; }
  /// Moves the model. Call it some 30 times a second; @p timeSeconds of a steady clock.
  void update(double timeSeconds);

private:
  CapMotion cap_;
  WatchedPointer<SpaceMouse> mouse_;
  double lastTime_ = -1e9;
  std::uint32_t lastButtons_ = 0;
};

} // namespace pointhaptics
