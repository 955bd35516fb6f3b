#include "Haptics/SurfaceFitProxy.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace
{

/// A stride of the HIP along its segment, over the fit radius: a surface changes little within it.
constexpr double kStrideRadii = 0.4;
/// Strides one tick may walk; the rest of a longer jump is caught up over the next ticks.
constexpr int kMaximumStrides = 128;
/// Times one tick may look for a new sheet.
constexpr int kMaximumAcquisitions = 2;
/// A sheet is watched when the HIP is nearer than this, over the fit radius.
constexpr double kWatchRadii = 1.0;
/// Another sheet is looked for when it is nearer than the watched one by this part of an index cell.
constexpr double kNearerCells = 0.5;
constexpr int kRoundsPerTick = 8;
constexpr int kRoundsWatching = 3;
constexpr int kHoldTicks = 20;
/// While held the sheet is sought again every so many ticks: what failed a moment ago mostly fails again.
constexpr int kRecoverEvery = 4;
/// The HIP comes out of a sheet by its own motion, and by no more than this part of the fit radius besides: a
/// larger jump is the fit's, at a ridge or in noise.
constexpr double kReleaseSlack = 0.05;
/// In contact the proxy travels in one stride at most this many times the HIP's motion, and this part of the
/// fit radius besides: where the nearest point jumps, at a ridge pressed from both sides, the proxy slides
/// there instead.
constexpr double kTravelPerMotion = 4.0;
constexpr double kTravelRadii = 0.1;
/// Where no sheet could be made out, it is tried again after this part of the reach.
constexpr double kSeekAgain = 0.05;
/// Part of the fit radius by which a foot point or a first depth may be off.
constexpr double kFootSlack = 0.1;
/// The surface is looked at for a rim each time the contact has gone this part of the counting radius.
constexpr double kRimStride = 0.1;
constexpr int kFrictionRounds = 4;

/// Of a spring's pull the part along a surface over that across it; infinite where nothing presses.
double pullRatio(const Vec3& pull, const Vec3& normal) noexcept
{
  const double across = dot(pull, normal);
  const double along = norm(pull - across * normal);
  return across > 0.0 ? along / across : along > 0.0 ? INFINITY : 0.0;
}

}

void SurfaceFitProxy::reset() noexcept
{
  *this = SurfaceFitProxy();
}

void SurfaceFitProxy::step(const HapticScene& scene, FitCells& memory, const ContactParameters& parameters,
  const Vec3& hip, ProxyState& state) noexcept
{
  memory_ = &memory;
  memory.forgetOverflow();
  if (!hasLastHip_)
  {
    lastHip_ = hip;
    hasLastHip_ = true;
  }
  const Vec3 path = hip - lastHip_;
  const double length = norm(path);
  double walked = 0.0;
  Vec3 from = lastHip_;
  int strides = 0;
  acquisitions_ = 0;
  do
  {
    Vec3 ignored;
    const double radius =
      mode_ == Mode::Free ? scene.fitScale(from, memory, ignored).radius : tracker_.fitRadius();
    double stride = kStrideRadii * radius;
    if (mode_ == Mode::Free && !scene.isNear(from))
    {
      stride = std::max(stride, scene.clearance());
    }
    walked = std::min(length, walked + stride);
    const Vec3 to = walked < length ? lastHip_ + (walked / length) * path : hip;
    if (mode_ == Mode::Contact)
    {
      touch(scene, to, state.status);
    }
    else
    {
      moveFree(scene, from, to, state.status);
    }
    from = to;
    if ((++strides >= kMaximumStrides || acquisitions_ >= kMaximumAcquisitions) && walked < length)
    {
      state.status |= kProxyStepLimit;
      break;
    }
  } while (walked < length);
  lastHip_ = from;

  if (mode_ == Mode::Contact)
  {
    lastNormal_ = tracker_.normal();
    applyFriction(parameters, hip);
  }
  else
  {
    touchedLastTick_ = false;
    contactPoint_ = hip;
  }
  state.contact = mode_ == Mode::Contact;
  state.proxy = contactPoint_;
  state.normal = lastNormal_;
  state.status |= std::uint32_t(memory.overflowed() ? kProxyCellLimit : kProxyOk);
  Vec3 ignored;
  state.radius = state.contact ? tracker_.proxyRadius() : scene.fitScale(hip, memory, ignored).proxyRadius;
  state.sphereCenter = state.contact ? contactPoint_ + state.radius * lastNormal_ : hip;
}

void SurfaceFitProxy::carry(const AffineTransform& from, const AffineTransform& to) noexcept
{
  const AffineTransform change = to * from.inverse();
  // Seen from the model it is the hand that moved: what it passes on that way it meets, whatever the
  // transform.
  lastHip_ = change.apply(lastHip_);
  lastTouched_ = change.apply(lastTouched_);
  hasLastInner_ = false;
  hasFailedAt_ = false;
  if (mode_ == Mode::Contact)
  {
    tracker_.carry(from, to);
    contactPoint_ = change.apply(contactPoint_);
  }
  else
  {
    mode_ = Mode::Free;
  }
}

/// One stride in free space.
void SurfaceFitProxy::moveFree(
  const HapticScene& scene, const Vec3& from, const Vec3& to, std::uint32_t& status) noexcept
{
  if (mode_ == Mode::Watching)
  {
    watch(scene, from, to, status);
    return;
  }
  Vec3 ignored;
  const double reach = kWatchRadii * scene.fitScale(to, *memory_, ignored).radius;
  if (seek(scene, from, to, reach))
  {
    watch(scene, from, to, status);
  }
}

/// Looks for the nearest cell about @p at and starts to watch its sheet, seen from @p from.
bool SurfaceFitProxy::seek(const HapticScene& scene, const Vec3& from, const Vec3& at, double reach) noexcept
{
  const double again = kSeekAgain * reach;
  if (hasFailedAt_ && norm2(at - failedAt_) < again * again)
  {
    return false;
  }
  hasFailedAt_ = false;
  double distance = 0.0;
  const std::int64_t cell = scene.pyramid().nearest(0, at, reach, distance);
  if (cell < 0)
  {
    return false;
  }
  SurfaceTracker found;
  ++acquisitions_;
  const Vec3 nearest = scene.pyramid().level(0).cells[std::size_t(cell)].mean;
  // The foot of a point is no further from it than any cell: else the tracker slid off to somewhere else.
  hasFailedAt_ = !found.acquire(scene, *memory_, nearest, from) ||
    norm(from - found.point()) > norm(from - nearest) + kFootSlack * found.fitRadius();
  if (hasFailedAt_)
  {
    failedAt_ = at;
    return false;
  }
  tracker_ = found;
  mode_ = Mode::Watching;
  return true;
}

/// True, and contact begins, where the HIP went through the watched sheet by its own motion.
bool SurfaceFitProxy::meets(
  const HapticScene& scene, const Vec3& from, const Vec3& to, std::uint32_t& status) noexcept
{
  const double depth = -tracker_.height(to);
  if (depth <= 0.0 || depth > 2.0 * norm(to - from) + kFootSlack * tracker_.fitRadius())
  {
    return false;
  }
  mode_ = Mode::Contact;
  hasLastInner_ = false;
  heldTicks_ = 0;
  lastTouched_ = to;
  touch(scene, to, status);
  return true;
}

/// Follows the watched sheet from @p from to @p to; contact begins where the HIP goes through it.
void SurfaceFitProxy::watch(
  const HapticScene& scene, const Vec3& from, const Vec3& to, std::uint32_t& status) noexcept
{
  const double before = tracker_.height(from);
  if (tracker_.follow(scene, *memory_, to, kRoundsWatching) == TrackResult::Lost)
  {
    mode_ = Mode::Free;
    return;
  }
  const double height = tracker_.height(to);
  const double apart = norm(to - tracker_.point());
  if (before >= 0.0 && meets(scene, from, to, status))
  {
    return;
  }
  if (apart > 1.5 * kWatchRadii * tracker_.fitRadius() || height < 0.0)
  {
    mode_ = Mode::Free;
    return;
  }
  // Another sheet may have come nearer than this one.
  double distance = 0.0;
  const double nearer = apart - kNearerCells * scene.cellSize();
  if (nearer > 0.0 && scene.pyramid().nearest(0, to, nearer, distance) >= 0)
  {
    const SurfaceTracker watched = tracker_;
    if (!seek(scene, from, to, nearer) ||
      tracker_.follow(scene, *memory_, to, kRoundsWatching) == TrackResult::Lost)
    {
      tracker_ = watched;
      return;
    }
    static_cast<void>(meets(scene, from, to, status));
  }
}

/// One stride in contact.
void SurfaceFitProxy::touch(const HapticScene& scene, const Vec3& to, std::uint32_t& status) noexcept
{
  const SurfaceTracker before = tracker_;
  const double moved = norm(to - lastTouched_);
  TrackResult result = tracker_.follow(
    scene, *memory_, to, kRoundsPerTick, kTravelPerMotion * moved + kTravelRadii * before.fitRadius());
  const double slack = moved + kReleaseSlack * before.fitRadius();
  const bool leaps = tracker_.height(to) > 0.0 && before.height(to) < -slack;
  const bool recedes =
    norm(to - tracker_.point()) > norm(to - before.point()) + kReleaseSlack * before.fitRadius();
  if (leaps || recedes)
  {
    result = TrackResult::Lost;
  }
  lastTouched_ = to;
  if (result == TrackResult::Lost)
  {
    tracker_ = before;
    hasLastInner_ = false;
    if (meetRim(scene, to, status) != Rim::None)
    {
      heldTicks_ = 0;
      return;
    }
    status |= kProxyLostSurface;
    if (heldTicks_ % kRecoverEvery == 0 && recover(scene, to))
    {
      heldTicks_ = 0;
    }
    else if (++heldTicks_ > kHoldTicks)
    {
      mode_ = Mode::Free;
    }
    return;
  }
  heldTicks_ = 0;
  if (result == TrackResult::RoundLimit)
  {
    status |= kProxyRoundLimit;
  }
  if (tracker_.height(to) > 0.0)
  {
    mode_ = Mode::Watching;
    return;
  }
  static_cast<void>(meetRim(scene, to, status));
}

/// Finds the sheet again where it was last good, from its free side.
bool SurfaceFitProxy::recover(const HapticScene& scene, const Vec3& to) noexcept
{
  const double radius = scene.fitRadius(tracker_.point());
  double distance = 0.0;
  const std::int64_t cell = scene.pyramid().nearest(0, tracker_.point(), radius, distance);
  if (cell < 0)
  {
    return false;
  }
  const Vec3 freeSide = tracker_.point() + 0.5 * radius * tracker_.normal();
  SurfaceTracker found;
  if (!found.acquire(scene, *memory_, scene.pyramid().level(0).cells[std::size_t(cell)].mean, freeSide) ||
    dot(found.normal(), tracker_.normal()) < 0.0 ||
    found.follow(scene, *memory_, to, kRoundsPerTick) == TrackResult::Lost || found.height(to) > 0.0)
  {
    return false;
  }
  tracker_ = found;
  return true;
}

/// At a rim goes around a sharp edge where the surface goes on behind it.
SurfaceFitProxy::Rim SurfaceFitProxy::meetRim(
  const HapticScene& scene, const Vec3& to, std::uint32_t& status) noexcept
{
  // A rim is not met without a way to it.
  const double near = kRimStride * tracker_.countRadius();
  if (hasLastInner_ && norm2(tracker_.point() - lastInner_) < near * near)
  {
    return Rim::None;
  }
  Vec3 outward;
  hasLastInner_ = !tracker_.isAtRim(scene, *memory_, outward);
  if (hasLastInner_)
  {
    lastInner_ = tracker_.point();
    return Rim::None;
  }
  if (tracker_.turnAroundEdge(scene, *memory_, outward, to) && tracker_.height(to) <= 0.0)
  {
    return Rim::Turned;
  }
  status |= kProxyReleasedAtRim;
  mode_ = Mode::Free;
  return Rim::Ended;
}

/// Coulomb friction as a cone about the normal at the contact point, wherever that is on a curved surface:
/// sticks while the spring's pull along the surface is within mu_s of that across it, else slides to where it
/// is mu_d of it.
void SurfaceFitProxy::applyFriction(const ContactParameters& parameters, const Vec3& hip) noexcept
{
  const Vec3 foot = tracker_.point();
  if (!touchedLastTick_)
  {
    touchedLastTick_ = true;
    // The first foot point: friction has nothing to hold yet.
    contactPoint_ = foot;
    sticking_ = true;
    return;
  }
  if (!(parameters.staticFriction > 0.0))
  {
    contactPoint_ = foot;
    return;
  }
  const Vec3 offset = contactPoint_ - foot;
  const Vec3 tangential = offset - dot(offset, tracker_.normal()) * tracker_.normal();
  const double length = norm(tangential);
  Vec3 normal;
  tracker_.alongSurface(tangential, contactPoint_, normal);
  const double hold = sticking_ ? parameters.staticFriction : parameters.dynamicFriction;
  sticking_ = pullRatio(contactPoint_ - hip, normal) <= hold;
  if (sticking_ || !(length > 0.0))
  {
    return;
  }
  // The ratio is nearly proportional to the way from the foot.
  double slide = std::min(length, parameters.dynamicFriction * std::max(0.0, -tracker_.height(hip)));
  for (int round = 0; round < kFrictionRounds; ++round)
  {
    tracker_.alongSurface((slide / length) * tangential, contactPoint_, normal);
    const double ratio = pullRatio(contactPoint_ - hip, normal);
    if (!(ratio > 0.0))
    {
      break;
    }
    slide = std::clamp(slide * parameters.dynamicFriction / ratio, 0.0, length);
  }
  tracker_.alongSurface((slide / length) * tangential, contactPoint_, normal);
}

} // namespace pointhaptics
