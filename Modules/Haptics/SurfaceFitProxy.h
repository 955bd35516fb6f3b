/// @file
/// The accurate proxy: a point on the local surface fit, with a friction cone.
#pragma once

#include "Haptics/HapticParameters.h"
#include "Haptics/Proxy.h"
#include "Haptics/SurfaceTracker.h"

namespace pointhaptics
{

/// In free space it watches the segment the HIP moves along and meets the first surface there; in contact it
/// follows the foot point of the HIP on that sheet, and lets go where the HIP comes out, or where the surface
/// ends. Everything converges within the tick. One thread; no allocation; bounded work.
class SurfaceFitProxy
{
public:
  /// A contact moves with the model from one transform to another.
  void carry(const AffineTransform& from, const AffineTransform& to) noexcept;
  void reset() noexcept;
  /// @pre hip finite, scene not null. Fills all of the state but force.
  /// @param memory of the fits; the same one at every step.
  void step(const HapticScene& scene, FitCells& memory, const ContactParameters& parameters, const Vec3& hip,
    ProxyState& state) noexcept;

private:
  enum class Mode
  {
    Free,     ///< No surface near.
    Watching, ///< Above a known sheet.
    Contact,
  };

  enum class Rim
  {
    None,
    Turned, ///< The surface goes on around an edge; the tracker is there now.
    Ended,
  };

  void moveFree(const HapticScene& scene, const Vec3& from, const Vec3& to, std::uint32_t& status) noexcept;
  void watch(const HapticScene& scene, const Vec3& from, const Vec3& to, std::uint32_t& status) noexcept;
  bool seek(const HapticScene& scene, const Vec3& from, const Vec3& at, double reach) noexcept;
  bool meets(const HapticScene& scene, const Vec3& from, const Vec3& to, std::uint32_t& status) noexcept;
  void touch(const HapticScene& scene, const Vec3& to, std::uint32_t& status) noexcept;
  bool recover(const HapticScene& scene, const Vec3& to) noexcept;
  Rim meetRim(const HapticScene& scene, const Vec3& to, std::uint32_t& status) noexcept;
  void applyFriction(const ContactParameters& parameters, const Vec3& hip) noexcept;

  FitCells* memory_ = nullptr; ///< Of the step that runs.
  SurfaceTracker tracker_;
  Mode mode_ = Mode::Free;
  Vec3 lastHip_;
  Vec3 lastTouched_;
  Vec3 contactPoint_;
  Vec3 lastNormal_{ 0.0, 0.0, 1.0 };
  Vec3 lastInner_; ///< Where the surface was last seen to go on all around.
  Vec3 failedAt_;  ///< Where no sheet could be made out of the cells near the HIP.
  bool hasFailedAt_ = false;
  bool hasLastInner_ = false;
  bool hasLastHip_ = false;
  bool sticking_ = false;
  bool touchedLastTick_ = false;
  int heldTicks_ = 0;
  int acquisitions_ = 0;
};

} // namespace pointhaptics
