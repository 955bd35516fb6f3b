/// @file
/// A SpaceMouse read by our own driver moves the model.
#pragma once

#include "CapMotion.h"

#include "Core/Base/Lifetime.h"
#include "Devices/SpaceMouse/SpaceMouse.h"

#include "PointHapticsInteractionModule.h" // For export macro

#include <cstdint>

namespace pointhaptics
{

/// The model is rotated and translated as the puck is turned and pushed on the screen. With the first button
/// held, pushing and pulling scales it; the second one resets it. GUI thread only.
class POINTHAPTICSINTERACTION_EXPORT SpaceMouseController
{
public:
  /// Both must outlive this.
  SpaceMouseController(ModelTransform& model, const ScreenView& screen)
    : cap_(model, screen)
  {
  }

  /// Not owned, and may be destroyed at any time.
  void setMouse(SpaceMouse* mouse) { mouse_ = mouse; }
  /// To be called some 30 times a second; @p timeSeconds of a steady clock.
  void update(double timeSeconds);

private:
  CapMotion cap_;
  WatchedPointer<SpaceMouse> mouse_;
  double lastTime_ = -1e9;
  std::uint32_t lastButtons_ = 0;
};

} // namespace pointhaptics
