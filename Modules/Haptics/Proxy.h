/// @file
/// The proxy: stays on the surface while the HIP goes inside; the spring between them is the force.
#pragma once

#include "Core/Simd/InstructionSet.h"
#include "Haptics/HapticParameters.h"
#include "Haptics/HapticScene.h"

#include <cstdint>
#include <memory>

namespace pointhaptics
{

/// Bits of ProxyState::status: bounds that this step reached, with the parameter that cures them, and rare
/// mechanisms that acted.
enum ProxyStatus : std::uint32_t
{
  kProxyOk = 0,
  kProxyNonFiniteInput = 1u << 0, ///< The HIP was NaN or infinite: last state held, force faded out. Cure:
                                  ///< the device.
  kProxyRoundLimit = 1u << 1, ///< The foot point or the ball did not come to rest within a step's rounds; it
                              ///< goes on in the next. Cure: larger voxels (a noisy cloud), or a higher rate.
  kProxyStepLimit = 1u << 2,  ///< The HIP moved further than one step can follow; it is caught up over the
                              ///< next. Cure: a higher rate; with GradientSteps maximumStepsPerTick.
  kProxyBallContact = 1u << 3, ///< The fitted surface and the ball disagree, as at edges and folds: the
                               ///< ball's contact is felt, in part or alone. No cure needed.
  kProxyLetGo = 1u << 4,   ///< The hand went so far away from its contact that it was let go, and has touched
                           ///< nothing since. Cure: come back to the surface.
  kProxyNoScene = 1u << 5, ///< No scene is set. Cure: setScene().
  kProxyCellLimit = 1u << 6, ///< More cells in a fit than there is room for: coarser ones served. Cure:
                             ///< larger voxels.
  kProxySettling = 1u << 7,  ///< The force follows a surface that moved by itself at the limited rate.
                             ///< Cure: settleRate.
  kProxyLed = 1u << 9,       ///< The fit's foot leapt, as on a ridge, and the ball went there over the bumps
                             ///< between points. No cure needed.
  kProxyAround = 1u << 10,   ///< The HIP came out through another face, and the ball went around the edge
                             ///< between. No cure needed.
  kProxySeeking = 1u << 11,  ///< No fit agreed with the ball in the last step either; one is sought, a part
                             ///< of the work in a step. No cure needed.
  kProxyGliding = 1u << 12,  ///< Bumps between points held the ball, and it went over them. No cure needed.
  kProxyCrowded = 1u << 13,  ///< The ball began among points without room and is smaller for it. Cure: begin
                             ///< outside of the cloud.
  kProxyFallback = 1u << 14, ///< The hand left what a local scene covers, and feels its fallback. Cure: a
                             ///< slower hand.
  kProxyEnergyLimit = 1u << 15, ///< The contact moved by itself, and the force is kept at what the hand has
                                ///< put into it. No cure needed.
};

/// Result of one step. Frame: workspace; metres and newtons.
struct ProxyState
{
  Vec3 hip; ///< The HIP this state answers.
  Vec3
    proxy; ///< Contact point: of the proxy sphere, the point nearest the HIP; the HIP itself out of contact.
  Vec3 normal{ 0.0, 0.0, 1.0 }; ///< Outward unit surface normal; out of contact the last one.
  Vec3 force; ///< On the hand: K (proxy - HIP) + damping; 0 out of contact. Never above the force limit, and
              ///< fading where the contact is far away (ContactParameters::forceLimit). In contact it changes
              ///< by at most 2 K |dH| + settleRate dt a step with SurfaceFit and Sphere (3 K |dH| where
              ///< kProxyEnergyLimit is set, 1.5 times as much in the fade), damping aside; where contact ends
              ///< it is 0 at once, one step of any height. While a change of parameters settles it is less or
              ///< more than K (proxy - HIP).
  Vec3 sphereCenter;   ///< Centre of the sphere to draw: proxy + radius normal in contact, else the HIP (with
                       ///< GradientSteps the sphere itself, which follows the HIP).
  double radius = 0.0; ///< Proxy radius r_p.
  bool contact = false;
  std::uint32_t status = kProxyOk;
};

/// One proxy on one scene. step() is for the servo thread: no allocation, lock, I/O or exception; bounded
/// work; its result depends on the sequence of calls only. Not thread safe: one thread owns a Proxy.
class Proxy
{
public:
  /// Parameters whose check() is not Ok are replaced by the defaults. @param wanted the instructions to use,
  /// as far as this machine has them; the states are the same bits.
  explicit Proxy(const HapticParameters& parameters = {}, InstructionSet wanted = InstructionSet::Automatic);
  ~Proxy();
  Proxy(Proxy&&) noexcept;
  Proxy& operator=(Proxy&&) noexcept;

  /// Takes effect at the next step; a change of method starts without contact. Parameters whose check() is
  /// not Ok are ignored.
  void setParameters(const HapticParameters& parameters) noexcept;
  const HapticParameters& parameters() const noexcept;

  /// Sets the scene, which must outlive its use here (SceneExchange sees to it). Contact point, normal and
  /// the last HIP move with the model from the old scene's transform to the new one's. A surface that the
  /// model passes the hand with counts as met by the hand, so it never ends up on its wrong side. Null: no
  /// contact. The fallback of a local scene (HapticScene::fallback()) is felt from the first step on that
  /// leaves the covered box.
  void setScene(const HapticScene* scene) noexcept;

  /// Ends contact and forgets its side; the next HIP is taken as free space.
  void reset() noexcept;

  /// Restores a new proxy with the present parameters and no scene. Safe in the servo thread.
  void restart() noexcept;

  /// @param hip Position of the hand in the workspace frame, metres. @param dt Seconds since the last step, >
  /// 0.
  ProxyState step(const Vec3& hip, double dt) noexcept;

  /// Steps a copy to where the HIP will be if it moves on as in the last step, so that the next step finds
  /// code and data in the processor's caches. Changes no result of any later call, bit for bit. Costs more
  /// than a step, about 10 us after a sleep; the step after it then takes a third of its time. Safe in the
  /// servo thread, as step() is.
  void prefetch() noexcept;

private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

} // namespace pointhaptics
