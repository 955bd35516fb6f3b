#include "Haptics/Proxy.h"

#include "Haptics/Contact/GradientSteps.h"
#include "Haptics/Contact/OffsetSettler.h"
#include "Haptics/Contact/SurfaceFitProxy.h"
#include "Haptics/Servo/PassivityLimit.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace
{
/// Time constant and end of the fade of a force whose HIP is not finite.
constexpr double kFadeSeconds = 0.010;
}

struct Proxy::Implementation
{
  HapticParameters parameters;
  const HapticScene* scene = nullptr;
  AffineTransform lastLattice; ///< modelToLattice of the last scene: the methods' state is in that frame.
  std::uint64_t lastCloud = 0;
  bool hadScene = false;
  SurfaceFitProxy surfaceFit;
  SurfaceFitProxy::Memory memory;
  SurfaceFitProxy::Memory prefetchMemory; ///< What a prefetch gathers must not serve a step: it is
                                          ///< gathered about another place.
  OffsetSettler settler;
  GradientSteps gradientSteps;
  ProxyState last;
  Vec3 lastHip;
  Vec3 lastMove; ///< Of the HIP in the last step.
  bool hasLastHip = false;
  double lastDt = 0.0; ///< Of the last step, seconds.
  double fadedSeconds = 0.0;
  ProxyState vanished; ///< The last state in a scene that is gone: its force fades.
  Vec3 carried;        ///< What a change of parameters did to the force, and has still to settle; newtons.
  bool parametersChanged = false;
  bool touched = false; ///< The method found contact in the last step.

  explicit Implementation(InstructionSet wanted)
    : memory(wanted)
    , prefetchMemory(wanted)
  {
  }

  void take(const HapticScene* newScene) noexcept
  {
    if (newScene && hadScene && !(newScene->modelToLattice() == lastLattice))
    {
      surfaceFit.carry(lastLattice, newScene->modelToLattice());
      gradientSteps.carry(lastLattice, newScene->modelToLattice());
    }
    if (!newScene)
    {
      vanished = scene ? last : vanished;
      reset();
    }
    const Bounds shared = newScene && scene ? newScene->sharedWith(*scene) : Bounds();
    if (!shared.empty())
    {
      memory.carryOver(*newScene, shared);
    }
    else if (!newScene || newScene->cloudNumber() != lastCloud)
    {
      // A new cloud may lie where an old one lay.
      memory.invalidate();
      surfaceFit.changeCells();
    }
    lastCloud = newScene ? newScene->cloudNumber() : 0;
    lastLattice = newScene ? newScene->modelToLattice() : AffineTransform();
    hadScene = newScene != nullptr;
    scene = newScene;
  }

  /// Whether the last step, seen from the model, lies in what a local scene covers: the next one begins
  /// there.
  bool isCoveredBy(const HapticScene& local) const noexcept
  {
    if (!scene || !hasLastHip)
    {
      return true;
    }
    const AffineTransform change = local.modelToLattice() * lastLattice.inverse();
    return local.covers(change.apply(scene->toLattice(lastHip))) &&
      local.covers(change.apply(scene->toLattice(last.proxy))) &&
      local.covers(change.apply(scene->toLattice(last.sphereCenter)));
  }

  /// Takes the fallback where a local scene is left: nothing where it has none yet.
  void enterFallback(const Vec3& place) noexcept
  {
    if (scene && !scene->covers(scene->toLattice(place)))
    {
      take(scene->fallback());
    }
  }

  void reset() noexcept
  {
    surfaceFit.reset();
    gradientSteps.reset();
    settler.reset();
    last = ProxyState();
    hasLastHip = false;
    lastMove = Vec3();
    fadedSeconds = 0.0;
    carried = Vec3();
    touched = false;
  }

  /// Without a scene: the force of the last one fades to zero.
  void fadeVanished(ProxyState& state, double dt) noexcept
  {
    fadedSeconds += dt;
    const double left = std::max(0.0, 1.0 - fadedSeconds / kFadeSeconds);
    state.status |= kProxyNoScene;
    state.contact = vanished.contact && left > 0.0;
    state.force = state.contact ? left * vanished.force : Vec3();
    state.proxy = state.contact ? state.hip + left * (vanished.proxy - vanished.hip) : state.hip;
    state.normal = vanished.normal;
    last = state;
    parametersChanged = true;
  }

  /// What changed parameters do to the force comes at the settle rate; where the hand lets go nothing is
  /// left.
  void settleParameters(ProxyState& state, double dt) noexcept
  {
    if (touched && !state.contact)
    {
      carried = Vec3();
    }
    else if (parametersChanged)
    {
      carried = last.force - state.force;
    }
    parametersChanged = false;
    touched = state.contact;
    const double length = norm(carried);
    const double shrink = parameters.contact.settleRate * dt;
    carried = length > shrink ? (1.0 - shrink / length) * carried : Vec3();
    state.force += carried;
    state.contact = state.contact || carried != Vec3();
    state.status |= std::uint32_t(carried != Vec3() ? kProxySettling : kProxyOk);
  }

  /// The last state, its force fading to zero.
  ProxyState hold(double dt) noexcept
  {
    fadedSeconds += dt;
    const double left = std::max(0.0, 1.0 - fadedSeconds / kFadeSeconds);
    ProxyState state = last;
    state.force = left * last.force;
    state.contact = last.contact && left > 0.0;
    state.status = kProxyNonFiniteInput;
    settler.resumeFrom(left * (last.proxy - last.hip));
    return state;
  }

  /// The servo loop's rule for a device of which the damping alone is known, answered in the same tick.
  double passiveStiffness(double dt, std::uint32_t& status) const noexcept
  {
    const ContactParameters& contact = parameters.contact;
    HandLimits device;
    device.damping = contact.deviceDamping;
    const double limit = largestPassiveStiffness(device, contact.damping, 1.0 / dt);
    const bool limited = contact.deviceDamping > 0.0 && contact.stiffness > limit;
    status |= std::uint32_t(limited ? kProxyStiffnessLimit : kProxyOk);
    return limited ? limit : contact.stiffness;
  }

  /// What a method found in the lattice frame.
  void toWorkspace(ProxyState& state) const noexcept
  {
    if (scene->isMoved())
    {
      state.proxy = state.contact ? scene->toWorkspace(state.proxy) : state.hip;
      state.sphereCenter = scene->toWorkspace(state.sphereCenter);
      state.normal = scene->directionToWorkspace(state.normal);
      state.radius *= scene->latticeScale();
    }
  }

  /// Lets the contact point follow the hand at once, and the surface at the settle rate. What ends is over at
  /// once: a force that went on in free space would be of nothing.
  void settle(ProxyState& state, double stiffness, double dt) noexcept
  {
    const double shrink = stiffness > 0.0 ? parameters.contact.settleRate * dt / stiffness : INFINITY;
    if (!state.contact)
    {
      settler.reset();
      return;
    }
    const double moved = hasLastHip ? norm(state.hip - lastHip) : 0.0;
    const Vec3 felt = settler.settle(state.proxy - state.hip, moved, shrink);
    if (settler.settling())
    {
      state.proxy = state.hip + felt;
      state.sphereCenter = state.proxy + state.radius * state.normal;
      state.status |= kProxySettling;
    }
  }

  Vec3 forceOf(const ProxyState& state, double stiffness, double dt) const noexcept
  {
    if (!state.contact)
    {
      return {};
    }
    const ContactParameters& contact = parameters.contact;
    Vec3 force = stiffness * (state.proxy - state.hip);
    if (contact.damping > 0.0 && hasLastHip && dt > 0.0)
    {
      const double speed = dot(state.hip - lastHip, state.normal) / dt;
      const double spring = dot(force, state.normal);
      // Damping never pulls the hand into the surface.
      force += std::max(-contact.damping * speed, -spring) * state.normal;
    }
    return force;
  }
};

Proxy::Proxy(const HapticParameters& parameters, InstructionSet wanted)
  : implementation_(std::make_unique<Implementation>(wanted))
{
  setParameters(parameters);
}
Proxy::~Proxy() = default;
Proxy::Proxy(Proxy&&) noexcept = default;
Proxy& Proxy::operator=(Proxy&&) noexcept = default;

void Proxy::setParameters(const HapticParameters& parameters) noexcept
{
  Implementation& self = *implementation_;
  if (parameters.check() != Status::Ok)
  {
    return;
  }
  if (parameters.method != self.parameters.method)
  {
    // Without contact; but the force does not know yet.
    const ProxyState last = self.last;
    const Vec3 hip = self.lastHip;
    const bool hadHip = self.hasLastHip;
    self.reset();
    self.last = last;
    self.lastHip = hip;
    self.hasLastHip = hadHip;
  }
  self.parameters = parameters;
  self.parametersChanged = self.hasLastHip;
}

const HapticParameters& Proxy::parameters() const noexcept
{
  return implementation_->parameters;
}

void Proxy::setScene(const HapticScene* scene) noexcept
{
  Implementation& self = *implementation_;
  const bool reaches = !scene || !scene->isLocal() || self.isCoveredBy(*scene);
  self.take(reaches ? scene : scene->fallback());
}

void Proxy::reset() noexcept
{
  implementation_->vanished = ProxyState();
  implementation_->reset();
}

void Proxy::restart() noexcept
{
  Implementation& self = *implementation_;
  self.reset();
  self.memory.invalidate();
  self.scene = nullptr;
  self.lastLattice = AffineTransform();
  self.lastCloud = 0;
  self.hadScene = false;
  self.lastDt = 0.0;
  self.vanished = ProxyState();
  self.parametersChanged = false;
}

ProxyState Proxy::step(const Vec3& hip, double dt) noexcept
{
  Implementation& self = *implementation_;
  if (!isFinite(hip) || !(dt > 0.0))
  {
    // The clock stands still: a tick counts as long as the last one.
    return self.hold(dt > 0.0 ? dt : self.lastDt > 0.0 ? self.lastDt : kFadeSeconds);
  }
  ProxyState state;
  state.hip = hip;
  state.proxy = hip;
  state.sphereCenter = hip;
  state.normal = self.last.normal;
  const double stiffness = self.passiveStiffness(dt, state.status);
  self.enterFallback(hip);
  if (!self.scene)
  {
    self.fadeVanished(state, dt);
    return state;
  }
  if (self.parameters.method != ProxyMethod::GradientSteps)
  {
    self.surfaceFit.step(*self.scene, self.memory, self.parameters.contact, self.scene->toLattice(hip),
      self.parameters.method == ProxyMethod::SurfaceFit, state);
    self.toWorkspace(state);
    self.settle(state, stiffness, dt);
  }
  else
  {
    self.gradientSteps.step(*self.scene, self.parameters, self.scene->toLattice(hip), dt, state);
    self.toWorkspace(state);
  }
  self.enterFallback(state.proxy);
  self.enterFallback(state.sphereCenter);
  state.force = self.forceOf(state, stiffness, dt);
  self.settleParameters(state, dt);
  self.last = state;
  self.lastMove = self.hasLastHip ? hip - self.lastHip : Vec3();
  self.lastHip = hip;
  self.hasLastHip = true;
  self.lastDt = dt;
  self.fadedSeconds = 0.0;
  return state;
}

void Proxy::prefetch() noexcept
{
  Implementation& self = *implementation_;
  if (!self.scene || !self.hasLastHip)
  {
    return;
  }
  const Vec3 hip = self.scene->toLattice(self.lastHip + self.lastMove);
  if (!isFinite(hip))
  {
    return;
  }
  ProxyState state = self.last;
  state.hip = hip;
  if (self.parameters.method != ProxyMethod::GradientSteps)
  {
    SurfaceFitProxy copy = self.surfaceFit;
    // Gathered anew each time: whether the step will have to gather is not known here.
    self.prefetchMemory.invalidate();
    copy.step(*self.scene, self.prefetchMemory, self.parameters.contact, hip,
      self.parameters.method == ProxyMethod::SurfaceFit, state);
  }
  else
  {
    GradientSteps copy = self.gradientSteps;
    copy.step(*self.scene, self.parameters, hip, self.lastDt, state);
  }
}

} // namespace pointhaptics
