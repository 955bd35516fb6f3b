/// @file
/// The paper's proxy: a sphere pushed out of the points it covers, step by step.
#pragma once

#include "Haptics/HapticParameters.h"
#include "Haptics/Proxy.h"

namespace pointhaptics
{

/// v_n = sum over the points in the sphere of (r_p - d) times the unit vector from the point to the centre.
/// With no point inside the sphere follows the HIP; with |v_n| above zeta it backs off along v_n; in contact
/// it slides along v_t. The sphere has HapticScene::coveringRadius(), or it would fall through the gaps
/// between voxel means. One thread; no allocation; at most maximumStepsPerTick steps a call.
class GradientSteps
{
public:
  void reset() noexcept { *this = GradientSteps(); }
  void carry(const AffineTransform& from, const AffineTransform& to) noexcept;
  /// The scene is another of the same model. A sphere of another radius keeps its point nearest to the HIP.
  void changeCells() noexcept { adopts_ = true; }
  /// @pre hip finite. Fills all of the state but force.
  void step(const HapticScene& scene, const HapticParameters& parameters, const Vec3& hip, double dt,
    ProxyState& state) noexcept;

private:
  void oneStep(
    const HapticScene& scene, const HapticParameters& parameters, const Vec3& hip, double radius) noexcept;

  Vec3 center_;
  Vec3 normal_{ 0.0, 0.0, 1.0 };
  double radius_ = 0.0; ///< Radius in the last step, metres.
  bool placed_ = false;
  bool adopts_ = false;
  bool contact_ = false;
  bool sticking_ = false;
};

} // namespace pointhaptics
