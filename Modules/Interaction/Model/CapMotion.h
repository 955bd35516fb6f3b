/// @file
/// Moves the model by the puck of a 3D mouse.
#pragma once

#include "Core/Base/Vector3.h"

#include "PointHapticsInteractionModule.h" // For export macro

namespace pointhaptics
{

class ModelTransform;
class ScreenView;

/// Moves the model by the puck of a 3D mouse, for all drivers. The puck's axes are those of the screen: x
/// right, y up, z towards the person. GUI thread only.
class POINTHAPTICSINTERACTION_EXPORT CapMotion
{
public:
  /// Both must outlive this.
  CapMotion(ModelTransform& model, const ScreenView& screen)
    : model_(model)
    , screen_(screen)
  {
  }
  ~CapMotion() { this->rest(); }
  CapMotion(const CapMotion&) = delete;
  CapMotion& operator=(const CapMotion&) = delete;

  /// Moves the model: for @p seconds the puck was pushed by @p shift and turned by @p turn, each axis from -1
  /// to 1; longer than 0.2 s counts as that. With @p scales, pulling it enlarges the model and pushing makes
  /// it smaller; nothing else moves then. All moves up to rest() are one to ModelTransform::undo().
  void move(const Vec3& shift, const Vec3& turn, bool scales, double seconds);
  /// The cap is let go of.
  void rest();
  void reset();

private:
  ModelTransform& model_;
  const ScreenView& screen_;
  bool isMoving_ = false;
};

} // namespace pointhaptics
