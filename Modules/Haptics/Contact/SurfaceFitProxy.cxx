#include "Haptics/Contact/SurfaceFitProxy.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pointhaptics
{
namespace
{

/// The contact point of a ball wanders by this part of the noise while the hand rests. Without it a hand on
/// teeth trembles.
constexpr double kWander = 0.2;
/// A lost fit is sought at once; later searches take three ticks, and one begins every kSeekEvery ticks.
/// Without the pause a tick among scattered points takes 1.6 times as long.
constexpr int kSeekEvery = 4;
/// A fit is sought where the present one decides less than this part of the contact. With 1 the bracket's p95
/// is 59 % in place of 45.
constexpr double kSeekBelow = 0.5;
/// RMS distance of the cells from the fit up to which the surface is smooth: over the ball's radius, or over
/// the noise of single points, which cells average. Without the second a noisy sphere is rough.
constexpr double kSmoothResidual = 0.03;
constexpr double kSmoothNoise = 0.5;
/// A face is an exit of the HIP if its residual is below kOutResidual, over the ball's radius, or kOutNoise,
/// over the noise. A fit across two faces of a wedge has a larger residual. Without the second the ball goes
/// around a noisy rim: of the ticks that press against it edge-on half have no force.
constexpr double kOutResidual = 0.01;
constexpr double kOutNoise = 1.5;

constexpr Vec3 kNowhere{ NAN, NAN, NAN };

/// Finds the point of the cloud nearest to @p p, at most @p search away. False: there is none.
bool findNearest(const HapticScene& scene, const Vec3& p, double search, Vec3& nearest) noexcept
{
  const CellPyramid& pyramid = scene.contactPyramid();
  double ignored = 0.0;
  const std::int64_t cell = pyramid.nearest(0, p, search, ignored);
  nearest = cell >= 0 ? pyramid.level(0).cells[std::size_t(cell)].mean : nearest;
  return cell >= 0;
}

double smoothStep(double t) noexcept
{
  const double s = std::clamp(t, 0.0, 1.0);
  return s * s * (3.0 - 2.0 * s);
}

}

void SurfaceFitProxy::carry(const AffineTransform& from, const AffineTransform& to) noexcept
{
  const AffineTransform change = to * from.inverse();
  ball_.carry(change, std::cbrt(std::abs(change.determinant())));
  tracker_.carry(from, to);
  search_.giveUp();
  friction_.carry(change);
  roughAt_ = kNowhere;
  normal_ = normalized(change.applyToNormal(normal_), normal_);
}

/// True if the ball lies above a smooth surface.
bool SurfaceFitProxy::isSmooth() const noexcept
{
  return tracker_.height(ball_.center()) > 0.0 &&
    tracker_.residual() < std::max(kSmoothResidual * ball_.radius(), kSmoothNoise * tracker_.noise());
}

/// Length by which noise lets the contact point wander, metres: a smooth fit averages it, a ball lies on
/// single points. 0 where the noise is too small to matter to the ball.
double SurfaceFitProxy::uncertainty(const HapticScene& scene) const noexcept
{
  const double noise = weight_ < 1.0 || !isSmooth() ? scene.noise(ball_.center()) : 0.0;
  return noise > kSmoothResidual * ball_.radius() ? kWander * noise : 0.0;
}

/// True if the surface continues on all sides of the foot: the ball sinks into a gap between points, not over
/// an edge. The fit's own centroid tells most such places; random samples lie aside of it by chance.
bool SurfaceFitProxy::hasSurfaceAround(const HapticScene& scene, Memory& memory) const noexcept
{
  return tracker_.continuesAround() ||
    ball_.hasPointsAround(scene, memory.ball, tracker_.point(), tracker_.normal());
}

/// True if the HIP came out through a smooth face beside the one that the ball lies on: it is in front of
/// that face, and the ball can go there. Without this, bumps between points would hold the ball back at the
/// edge. A HIP below the fit whose nearest point lies on that fit has come out nowhere.
bool SurfaceFitProxy::comesOut(
  const HapticScene& scene, Memory& memory, const Vec3& hip, std::uint32_t& status) noexcept
{
  const double near = ball::kStride * ball_.radius();
  const double again = 0.5 * ball::kBump * ball_.radius();
  Vec3 nearest;
  if (!findNearest(scene, hip, near, nearest) ||
    (weight_ > 0.0 && tracker_.height(hip) <= 0.0 &&
      std::abs(tracker_.heightAboveFit(nearest)) < ball::kBump * ball_.radius()) ||
    norm2(hip - roughAt_) < again * again)
  {
    return false;
  }
  SurfaceSearch search;
  search.begin(nearest);
  const SurfaceTracker& face = search.found();
  const bool isRough = !search.finish(scene, memory.fit, hip, hip) ||
    face.residual() >= std::max(kOutResidual * ball_.radius(), kOutNoise * face.noise());
  roughAt_ = isRough ? hip : kNowhere;
  const ProxyBall before = ball_;
  if (isRough || face.height(hip) < 0.0 ||
    !ball_.goTo(scene, memory.ball, face.point(), face.normal(), status) || face.height(ball_.center()) < 0.0)
  {
    ball_ = before;
    return false;
  }
  tracker_ = face;
  return true;
}

/// Does the next part of the search for a fit at the ball, or all of it in the first tick without a fit.
/// @return true if it has come to the foot of the HIP.
bool SurfaceFitProxy::seek(const HapticScene& scene, Memory& memory, const Vec3& hip) noexcept
{
  const int tick = searchTicks_++;
  Vec3 nearest;
  if ((tick == 0 || tick % kSeekEvery == 1) &&
    findNearest(scene, ball_.nearestPoint(hip), 2.0 * ball_.radius(), nearest))
  {
    search_.begin(nearest);
  }
  return tick == 0 ? search_.finish(scene, memory.fit, ball_.center(), hip)
                   : search_.advance(scene, memory.fit, ball_.center(), hip);
}

/// Moves the ball with the foot of the fit while the fit alone is felt and the surface continues smoothly: it
/// need not look for its way among the points. False: it stays, and must step.
bool SurfaceFitProxy::ride(
  const HapticScene& scene, Memory& memory, const Vec3& hip, std::uint32_t& status) noexcept
{
  return weight_ == 1.0 && isSmooth() && tracker_.height(hip) < 0.0 &&
    this->hasSurfaceAround(scene, memory) &&
    ball_.ride(scene, memory.ball, hip, tracker_.point(), tracker_.normal(), tracker_.noise(), status);
}

/// Updates ball, fit and search, and the fit's part of the contact. The fit is smoother, but the ball alone
/// decides about contact, so the fit counts only near the ball. @param followed result of
/// SurfaceTracker::follow() in this tick.
void SurfaceFitProxy::updateFit(const HapticScene& scene, Memory& memory, const Vec3& hip,
  TrackResult followed, std::uint32_t& status) noexcept
{
  const auto agreement = [&]
  {
    // The fit alone is felt up to this distance of its point from the ball's, as bumps between points hold
    // the ball back, and the ball alone from twice of it on.
    const double trust =
      std::max(ball::kFace * ball_.radius() + ball::kAside * std::max(0.0, ball_.depth(hip)),
        isSmooth() && tracker_.continuesAround() ? ball::kTrustPlain * ball_.radius() : 0.0);
    const double distance = norm(tracker_.point() - ball_.nearestPoint(hip));
    // A HIP in front of the fit but deep below the ball belongs to another sheet.
    const bool agrees =
      tracker_.height(ball_.center()) > 0.0 && !(tracker_.height(hip) > 0.0 && ball_.depth(hip) > trust);
    return agrees ? 1.0 - smoothStep((distance - trust) / trust) : 0.0;
  };
  double result = 0.0;
  if (weight_ > 0.0)
  {
    status |= std::uint32_t(followed != TrackResult::Converged ? kProxyRoundLimit : kProxyOk);
    // A foot may leap across a ridge in one tick. The ball follows it: bumps between points would hold it
    // back.
    const bool isLed = followed == TrackResult::Far &&
      ball_.goTo(scene, memory.ball, tracker_.point(), tracker_.normal(), status);
    status |= std::uint32_t(isLed ? kProxyLed : kProxyOk);
    result = followed <= TrackResult::RoundLimit || isLed ? agreement() : 0.0;
  }
  const bool seeks = result < kSeekBelow;
  status |= std::uint32_t(seeks && searchTicks_ > 0 ? kProxySeeking : kProxyOk);
  if (seeks && seek(scene, memory, hip))
  {
    const SurfaceTracker before = std::exchange(tracker_, search_.found());
    const double newWeight = agreement();
    tracker_ = newWeight > result ? tracker_ : before;
    result = std::max(result, newWeight);
  }
  if (result == 1.0)
  {
    searchTicks_ = 0;
    search_.giveUp();
  }
  weight_ = result;
  // Another face is looked for unless the fit is trusted, exact, and has surface on all sides.
  if ((result < 1.0 || followed == TrackResult::RoundLimit || !tracker_.continuesAround()) &&
    ball_.depth(hip) > 0.0 && comesOut(scene, memory, hip, status))
  {
    status |= kProxyAround; // the new face alone is felt; nothing where the ball became free
    weight_ = ball_.isFree() ? 0.0 : 1.0;
  }
}

void SurfaceFitProxy::forgetFit() noexcept
{
  weight_ = 0.0;
  roughAt_ = kNowhere;
  search_.giveUp();
  searchTicks_ = 0;
}

/// Blends the contacts of fit and ball: weight_ is the fit's part, the rest is the ball's. Each presses only
/// a HIP below it; else its part of the offset is zero.
SurfaceFitProxy::Contact SurfaceFitProxy::blended(
  const HapticScene& scene, Memory& memory, const Vec3& hip) const noexcept
{
  const double ballDepth = ball_.isFree() ? -ball_.radius() : ball_.depth(hip);
  Vec3 offset = (1.0 - weight_) * (ballDepth > 0.0 ? ball_.nearestPoint(hip) - hip : Vec3());
  Vec3 normal = (1.0 - weight_) * normalized(ball_.center() - hip, normal_);
  if (weight_ > 0.0)
  {
    // The ball sinks into gaps between points. There the fit alone decides that the HIP is below it.
    const bool isPressed =
      tracker_.height(hip) <= 0.0 && (ballDepth > 0.0 || this->hasSurfaceAround(scene, memory));
    offset += weight_ * (isPressed ? tracker_.point() - hip : Vec3());
    normal += weight_ * tracker_.normal();
  }
  return { hip + offset, normalized(normal, normal_), offset != Vec3() };
}

void SurfaceFitProxy::step(const HapticScene& scene, Memory& memory, const ContactParameters& parameters,
  const Vec3& hip, bool refines, ProxyState& state) noexcept
{
  memory.fit.clearOverflow();
  const bool isPatient = weight_ == 1.0 && isSmooth() && tracker_.continuesAround();
  const TrackResult followed = weight_ > 0.0 ? tracker_.follow(scene, memory.fit, hip) : TrackResult::Lost;
  if (followed != TrackResult::Converged || !ride(scene, memory, hip, state.status))
  {
    ball_.step(scene, memory.ball, hip, isPatient, state.status);
  }
  Contact contact;
  if (ball_.isFree() || !ball_.isThere(hip))
  {
    this->forgetFit();
  }
  else
  {
    if (refines)
    {
      updateFit(scene, memory, hip, followed, state.status);
    }
    contact = this->blended(scene, memory, hip);
    state.status |= std::uint32_t(refines && weight_ < 1.0 && contact.pressed ? kProxyBallContact : kProxyOk);
  }
  state.status |= std::uint32_t(memory.fit.overflowed() ? kProxyCellLimit : kProxyOk);
  state.contact = contact.pressed;
  if (contact.pressed)
  {
    normal_ = contact.normal;
    const auto along = [&](const Vec3& t, Vec3& point, Vec3& normal)
    {
      if (weight_ == 1.0)
      {
        tracker_.alongSurface(t, point, normal);
        return;
      }
      point = contact.point + t;
      normal = contact.normal;
    };
    state.proxy = friction_.contactPoint(parameters, contact.point, contact.normal, norm(contact.point - hip),
      parameters.staticFriction > 0.0 ? 0.0 : this->uncertainty(scene), hip, along);
  }
  else
  {
    friction_.reset();
    state.proxy = hip;
  }
  Vec3 ignored;
  state.normal = normal_;
  state.radius = !refines ? ball_.radius()
    : weight_ == 1.0      ? tracker_.proxyRadius()
                          : scene.fitScale(hip, memory.fit, ignored).proxyRadius;
  state.sphereCenter = state.contact ? state.proxy + state.radius * normal_ : hip;
}

} // namespace pointhaptics
