/// @file
/// The simulated hand under mouse and keys.
#pragma once

#include "Core/Base/Lifetime.h"
#include "Core/Base/Vector3.h"
#include "Devices/SimulatedDevice.h"

#include "PointHapticsInteractionModule.h" // For export macro

#include <cstdint>
#include <functional>
#include <optional>

namespace pointhaptics
{

class ModelTransform;
class ScreenView;
struct ProxyState;

/// Moves the simulated hand by mouse and keys. Without a device every call has no effect. GUI thread only.
class POINTHAPTICSINTERACTION_EXPORT MouseHand
{
public:
  /// Where the line of sight through a display position meets the cloud, workspace; nothing: it misses.
  using SurfaceAt = std::function<std::optional<Vec3>(int x, int y)>;

  /// Both must outlive this. The model's workspace bounds the hand.
  MouseHand(const ScreenView& screen, const ModelTransform& model)
    : screen_(screen)
    , model_(model)
  {
  }

  /// Sets the device, which is not owned and may be destroyed at any time.
  void setDevice(SimulatedDevice* device) { device_ = device; }
  bool hasDevice() const { return bool(device_); }

  ///@{
  /// Hand mode: the hand follows the mouse pointer in the view plane at its depth. Default: off.
  void setFollowsMouse(bool on)
  {
    followsMouse_ = on;
    hoverIsDue_ = hoverIsDue_ && on;
  }
  bool followsMouse() const { return followsMouse_; }
  ///@}
  ///@{
  /// Pushes the mouse pointer, in hand mode, out of the touched surface: the pointer goes to where the
  /// surface has pushed the hand, and the person has to push against it. Default: off.
  void setPushesPointer(bool on) { pushesPointer_ = on; }
  bool pushesPointer() const { return pushesPointer_; }
  ///@}

  /// Whether the pointer is on the hand, as one sees it.
  bool isUnderPointer() const;
  ///@{
  /// Moves the hand, metres in the workspace; clamped to it. Depth: away from the person (positive) or back,
  /// along the view direction.
  void move(const Vec3& offset);
  void moveInDepth(double metres);
  /// Moves the hand in the view plane, as arrow keys do.
  void moveOnScreen(double right, double up);
  /// Puts the hand to @p place without a way there: nothing in between is touched.
  void placeAt(const Vec3& place);
  ///@}
  ///@{
  /// Puts the hand above the surface under the pointer, where there is one: asked for at any time, done by
  /// the first hoverIfDue(), which needs a scene that is that of the picture.
  void requestHover() { hoverIsDue_ = true; }
  void hoverIfDue(const SurfaceAt& surfaceAt);
  ///@}
  /// Moves the hand in the view plane as far as the mouse has moved.
  void drag();
  /// Between true and false the mouse holds the hand.
  void setDragged(bool on) { isDragged_ = on; }
  bool isDragged() const { return isDragged_; }
  /// Moves the hand in the view plane to the pointer.
  void follow();
  void setPointerInside(bool isInside) { isPointerInside_ = isInside; }
  /// To be called from a timer with the newest tick. In contact hand mode or a drag holds how deep the hand
  /// presses below the plane that is touched, so the hand neither leaves a surface that falls away nor digs
  /// into one that rises; a move in depth changes it. Where contact is lost, @p surfaceAt says where the
  /// surface goes on.
  void followTouch(const ProxyState& latest, const SurfaceAt& surfaceAt);
  /// Moves the pointer to the hand, where the surface has pushed the hand away from it.
  void pushPointer(const ProxyState& latest);
  /// Moves the pointer to the hand, in hand mode.
  void putPointerOnHand();

  /// Presses or releases button @p index, 0 to 3, of the device by a key. A key that repeats is released and
  /// pressed again at once; update() decides if it stays up.
  void holdButton(int index, bool isDown);
  /// To be called from a timer.
  void update();

private:
  Vec3 inWorkspace(Vec3 place) const;
  Vec3 pressed(const Vec3& place) const;
  void placePointer(const Vec3& point);

  const ScreenView& screen_;
  const ModelTransform& model_;
  WatchedPointer<SimulatedDevice> device_;
  bool followsMouse_ = false;
  bool isDragged_ = false;
  bool pushesPointer_ = false;
  bool isPointerInside_ = false;
  bool hoverIsDue_ = false;
  Vec3 contact_;       ///< Where the surface was touched last,
  Vec3 normal_;        ///< and its outward normal there.
  double press_ = 0.0; ///< Metres that the target is kept below the plane of the contact; 0: it is free.
  std::uint32_t heldButtons_ = 0;
  std::uint32_t releasedButtons_ = 0; ///< Buttons that are released unless the key repeats.
  double releaseTime_ = -1e9;
};

} // namespace pointhaptics
