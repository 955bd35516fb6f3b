#include "Haptics/Proxy.h"

#include "Haptics/Contact/GradientSteps.h"
#include "Haptics/Contact/OffsetSettler.h"
#include "Haptics/Contact/SurfaceFitProxy.h"
#include "Haptics/ContactEnergy.h"
#include "Haptics/ContactSpring.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace
{
/// Time constant of the fade of a force whose HIP is not finite, seconds.
constexpr double kFadeSeconds = 0.010;
/// A hand that left its contact is released if no point is within this distance, metres. With less a hand
/// that crosses a crown of leaves would be released among them and meet the next leaf from inside.
constexpr double kFarFromCloud = 10e-3;
/// A hand that moves further than this in a tick, metres, did no work: it was put there. Without this the
/// contact that the ball finds some ticks later has no force.
constexpr double kLeap = 5e-3;
/// A contact belongs to the sheet that the hand came through if its height over that sheet's plane is at most
/// this part of its distance along the plane. With less a wave is met from behind; with more the far side of
/// a thick part is not met.
constexpr double kSameSheet = 0.5;
/// Distance along which the sheet is taken to go on, metres. Without it the underside of another part is not
/// felt.
constexpr double kSheetGoesOn = 50e-3;
}

struct Proxy::Implementation
{
  HapticParameters parameters;
  const HapticScene* scene = nullptr; ///< The state of the methods is in its lattice frame.
  bool isFallback = false;            ///< True after a local scene was left.
  SurfaceFitProxy surfaceFit;
  SurfaceFitProxy::Memory memory;
  SurfaceFitProxy::Memory prefetchMemory; ///< Separate, since a prefetch gathers about another place and must
                                          ///< not serve a step.
  OffsetSettler settler;
  GradientSteps gradientSteps;
  ProxyState last;
  Vec3 lastMove; ///< Motion of the HIP in the last step, metres.
  bool hasLastHip = false;
  double lastDt = 0.0; ///< Duration of the last step, seconds.
  double fadedSeconds = 0.0;
  Vec3 carried;            ///< Jump of the force by a change that has still to settle, newtons.
  bool hasChanged = false; ///< True if since the last step something changed that settling the offset does
                           ///< not cover.
  bool touched = false;    ///< The method found contact in the last step.
  ContactEnergy energy;
  bool isModelMoved = false; ///< True while work of the model, its cloud or the parameters still settles.
  bool isLetGo = false;      ///< True after the hand left its contact, until it touches anything.
  /// The hand was released behind a sheet that it touched here, from the side of this normal; workspace
  /// frame.
  bool isBehind = false;
  Vec3 behindPlace;
  Vec3 behindNormal;

  explicit Implementation(InstructionSet wanted)
    : memory(wanted)
    , prefetchMemory(wanted)
  {
  }

  void take(const HapticScene* newScene) noexcept
  {
    if (newScene && scene && !(newScene->modelToLattice() == scene->modelToLattice()))
    {
      surfaceFit.carry(scene->modelToLattice(), newScene->modelToLattice());
      gradientSteps.carry(scene->modelToLattice(), newScene->modelToLattice());
    }
    if (!newScene)
    {
      releaseContact();
    }
    const bool isInPlace = newScene && scene && newScene->modelToWorkspace() == scene->modelToWorkspace();
    isModelMoved = isModelMoved ||
      (newScene && hasLastHip && !(isInPlace && newScene->globalCloudNumber() == scene->globalCloudNumber()));
    isBehind = isBehind && isInPlace;
    const Bounds shared = newScene && scene ? newScene->sharedWith(*scene) : Bounds();
    if (!shared.empty())
    {
      memory.carryOver(*newScene, shared);
      surfaceFit.changeRadii();
    }
    else if (!newScene || !scene || newScene->cloudNumber() != scene->cloudNumber())
    {
      // A new cloud may have the address of an old one.
      memory.invalidate();
      surfaceFit.changeCells();
      gradientSteps.changeCells();
    }
    hasChanged = hasChanged || (!settlesOffset() && hasLastHip && newScene != scene);
    scene = newScene;
  }

  /// True if the last step lies, in the model's frame, in the covered box of a local scene: the next step
  /// begins there.
  bool isCoveredBy(const HapticScene& local) const noexcept
  {
    if (!scene || !hasLastHip)
    {
      return true;
    }
    const AffineTransform change = local.modelToLattice() * scene->modelToLattice().inverse();
    return local.covers(change.apply(scene->toLattice(last.hip))) &&
      local.covers(change.apply(scene->toLattice(last.proxy))) &&
      local.covers(change.apply(scene->toLattice(last.sphereCenter)));
  }

  /// Changes to the fallback where a local scene is left.
  void enterFallback(const Vec3& place) noexcept
  {
    if (scene && !scene->covers(scene->toLattice(place)))
    {
      take(scene->fallback());
      isFallback = true;
    }
  }

  /// Restarts the methods without contact. The force settles later.
  void releaseContact() noexcept
  {
    surfaceFit.reset();
    gradientSteps.reset();
    settler.reset();
    fadedSeconds = 0.0;
    carried = Vec3();
    touched = false;
    energy.reset();
    hasChanged = hasLastHip;
  }

  void reset() noexcept
  {
    hasLastHip = false;
    isLetGo = false;
    isBehind = false;
    isModelMoved = false;
    releaseContact();
    last = ProxyState();
    lastMove = Vec3();
  }

  /// GradientSteps trembles by itself, so its offset is not settled.
  bool settlesOffset() const noexcept { return parameters.method != ProxyMethod::GradientSteps; }

  void remember(const Vec3& hip, double dt) noexcept
  {
    lastMove = hasLastHip ? hip - last.hip : Vec3();
    hasLastHip = true;
    lastDt = dt;
  }

  /// Lets the jump of a change shrink by at most @p shrink newtons. Where the hand lets go nothing is left of
  /// it.
  void settleChanges(ProxyState& state, double shrink) noexcept
  {
    if (touched && !state.contact)
    {
      carried = Vec3();
    }
    else if (hasChanged)
    {
      carried = last.force - state.force;
    }
    hasChanged = false;
    touched = state.contact;
    carried = withoutReversal(last.force, state.force + carried, state.force) - state.force;
    const double length = norm(carried);
    carried = length > shrink ? (1.0 - shrink / length) * carried : Vec3();
    state.force += carried;
    state.contact = state.contact || carried != Vec3();
    state.status |= std::uint32_t(carried != Vec3() ? kProxySettling : kProxyOk);
  }

  /// Returns the last state for a hand at @p hip, its force fading to zero.
  ProxyState fade(const Vec3& hip, std::uint32_t status, double dt) noexcept
  {
    const double before = std::max(0.0, 1.0 - fadedSeconds / kFadeSeconds);
    fadedSeconds += dt;
    const double left = std::max(0.0, 1.0 - fadedSeconds / kFadeSeconds);
    const double part = left > 0.0 ? left / before : 0.0;
    // The spring is as long as the remaining force: it was limited.
    const double spring = parameters.contact.stiffness * norm(last.proxy - last.hip);
    const double limited = spring > parameters.contact.forceLimit ? norm(last.force) / spring : 1.0;
    const Vec3 offset = (part * limited) * (last.proxy - last.hip);
    last.hip = hip;
    last.contact = last.contact && left > 0.0;
    last.proxy = last.contact ? hip + offset : hip;
    last.radius = status & kProxyNoScene ? 0.0 : last.radius;
    last.sphereCenter = last.contact ? last.proxy + last.radius * last.normal : hip;
    last.force = last.contact ? part * last.force : Vec3();
    last.status = status;
    carried = part * carried;
    settler.resumeFrom(last.proxy - last.hip);
    hasChanged = hasChanged || !settlesOffset();
    return last;
  }

  /// Takes a method's result from the lattice frame to the workspace.
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

  /// Lets the contact point follow the hand at once, and the surface at the settle rate. A contact that ends
  /// is over at once: a force that went on in free space would belong to no surface. @return true if anything
  /// settles.
  bool settle(ProxyState& state, double dt) noexcept
  {
    const double stiffness = parameters.contact.stiffness;
    const double shrink = stiffness > 0.0 ? parameters.contact.settleRate * dt / stiffness : INFINITY;
    if (!state.contact)
    {
      settler.reset();
      return false;
    }
    const bool wasSettling = settler.settling();
    const double moved = hasLastHip ? norm(state.hip - last.hip) : 0.0;
    const Vec3 felt = settler.settle(state.proxy - state.hip, moved, shrink);
    if (settler.settling())
    {
      state.proxy = state.hip + felt;
      state.sphereCenter = state.proxy + state.radius * state.normal;
      state.status |= kProxySettling;
    }
    return wasSettling || settler.settling();
  }

  ContactSpring spring() const noexcept
  {
    return { parameters.contact.stiffness, parameters.contact.forceLimit };
  }

  /// Ends the contact; nothing remembers its side.
  void endContact(ProxyState& state) noexcept
  {
    surfaceFit.reset();
    gradientSteps.reset();
    state.contact = false;
    state.proxy = state.sphereCenter = state.hip;
  }

  /// Lets a hand that was released behind a sheet meet it again only from the side that it came from.
  void keepSide(ProxyState& state) noexcept
  {
    if (!isBehind || !state.contact)
    {
      return;
    }
    const Vec3 from = state.proxy - behindPlace;
    const double height = dot(from, behindNormal);
    const double aside = norm(from - height * behindNormal);
    const bool isSame = aside < kSheetGoesOn && std::abs(height) < state.radius + kSameSheet * aside;
    isBehind = isSame && dot(state.normal, behindNormal) < 0.0;
    if (isBehind)
    {
      endContact(state);
    }
  }

  /// Ends a contact that the hand has left. A local scene has only points near the contact, so the global one
  /// decides.
  void letGo(ProxyState& state) noexcept
  {
    const HapticScene& whole = scene->fallback() ? *scene->fallback() : *scene;
    const double end = this->spring().end();
    if (state.contact && norm(state.proxy - state.hip) >= end &&
      !whole.hasPointsWithin(whole.toLattice(state.hip), kFarFromCloud / whole.latticeScale()))
    {
      isBehind = isLetGo = true;
      behindPlace = state.proxy;
      behindNormal = state.normal;
      endContact(state);
    }
    keepSide(state);
    isLetGo = isLetGo && !state.contact;
    state.status |= std::uint32_t(isLetGo ? kProxyLetGo : kProxyOk);
  }

  /// Force of the spring, within its limit and the energy that the hand has put in.
  Vec3 springForce(ProxyState& state) noexcept
  {
    const double stiffness = parameters.contact.stiffness;
    if (!state.contact)
    {
      energy.reset();
      return {};
    }
    const Vec3 offset = state.proxy - state.hip;
    const double limited = this->spring().part(norm(offset));
    const Vec3 plain = stiffness * offset;
    const Vec3 force = limited < 1.0 ? limited * plain : plain;
    if (isModelMoved || hasChanged || carried != Vec3())
    {
      energy.allow(force, stiffness);
      return force;
    }
    const double part = energy.part(last.force, force, this->moved(state), stiffness);
    if (part < 1.0)
    {
      state.status |= kProxyEnergyLimit;
    }
    if (part < 1.0 && limited == 1.0)
    {
      state.proxy = state.hip + part * offset;
      state.sphereCenter = settlesOffset() ? state.proxy + state.radius * state.normal : state.sphereCenter;
    }
    if (part < 1.0 && limited == 1.0 && settlesOffset())
    {
      settler.hold(part * offset);
    }
    return part < 1.0 ? part * force : force;
  }

  Vec3 moved(const ProxyState& state) const noexcept { return hasLastHip ? state.hip - last.hip : Vec3(); }

  Vec3 forceOf(ProxyState& state, double dt) noexcept
  {
    const ContactParameters& contact = parameters.contact;
    Vec3 force = springForce(state);
    if (state.contact && contact.damping > 0.0 && hasLastHip && dt > 0.0)
    {
      const double speed = dot(state.hip - last.hip, state.normal) / dt;
      const double spring = dot(force, state.normal);
      // Damping never pulls the hand into the surface.
      force += std::max(-contact.damping * speed, -spring) * state.normal;
    }
    return force;
  }

  /// Keeps the limit while a change settles, and counts the work of the tick.
  void finishForce(ProxyState& state) noexcept
  {
    const double length = norm(state.force);
    if (length > parameters.contact.forceLimit)
    {
      state.force *= parameters.contact.forceLimit / length;
    }
    if (!isModelMoved && state.contact)
    {
      energy.add(last.force, state.force, this->moved(state));
    }
    isModelMoved = isModelMoved &&
      ((state.status & kProxyStepLimit) != 0u || !state.contact || settler.settling() || carried != Vec3());
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
    self.releaseContact();
  }
  self.parameters = parameters;
  self.hasChanged = self.hasChanged || self.hasLastHip;
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
  self.isFallback = !reaches;
}

void Proxy::reset() noexcept
{
  implementation_->reset();
}

void Proxy::restart() noexcept
{
  Implementation& self = *implementation_;
  self.reset();
  self.memory.invalidate();
  self.scene = nullptr;
  self.isFallback = false;
  self.lastDt = 0.0;
}

ProxyState Proxy::step(const Vec3& hip, double dt) noexcept
{
  Implementation& self = *implementation_;
  if (!isFinite(hip) || !(dt > 0.0))
  {
    // If the clock stands still, a tick counts as long as the last one.
    const double seconds = dt > 0.0 ? dt : self.lastDt > 0.0 ? self.lastDt : kFadeSeconds;
    return self.fade(self.last.hip, kProxyNonFiniteInput, seconds);
  }
  ProxyState state;
  state.hip = hip;
  state.proxy = hip;
  state.sphereCenter = hip;
  state.normal = self.last.normal;
  self.enterFallback(hip);
  if (!self.scene)
  {
    self.remember(hip, dt);
    return self.fade(hip, state.status | kProxyNoScene, dt);
  }
  state.status |= std::uint32_t(self.isFallback ? kProxyFallback : kProxyOk);
  self.isModelMoved = self.isModelMoved || norm(self.moved(state)) > kLeap;
  bool settles = false;
  if (self.settlesOffset())
  {
    self.surfaceFit.step(*self.scene, self.memory, self.parameters.contact, self.scene->toLattice(hip),
      self.parameters.method == ProxyMethod::SurfaceFit, state);
    self.toWorkspace(state);
    self.letGo(state);
    settles = self.settle(state, dt);
  }
  else
  {
    self.gradientSteps.step(*self.scene, self.parameters, self.scene->toLattice(hip), dt, state);
    self.toWorkspace(state);
    self.letGo(state);
  }
  state.force = self.forceOf(state, dt);
  // Only one of them settles at a time: both together would be twice the rate.
  self.settleChanges(state, settles ? 0.0 : self.parameters.contact.settleRate * dt);
  self.finishForce(state);
  self.remember(hip, dt);
  self.last = state;
  self.fadedSeconds = 0.0;
  self.enterFallback(state.proxy);
  self.enterFallback(state.sphereCenter);
  return state;
}

void Proxy::prefetch() noexcept
{
  Implementation& self = *implementation_;
  if (!self.scene || !self.hasLastHip)
  {
    return;
  }
  const Vec3 hip = self.scene->toLattice(self.last.hip + self.lastMove);
  if (!isFinite(hip))
  {
    return;
  }
  ProxyState state = self.last;
  state.hip = hip;
  if (self.settlesOffset())
  {
    SurfaceFitProxy copy = self.surfaceFit;
    // The memory is always gathered anew, as it is not known here if the step will have to gather.
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
