#include "Haptics/Contact/ProxyBall.h"

#include "Haptics/Contact/BallRadius.h"
#include "Haptics/Proxy.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace
{

/// The radius is measured again after this many index cells of way.
constexpr double kMeasureEvery = 2.0;
constexpr double kHurriedGrowth = 1.3;
/// Over what it grows by, how high a ball rises for it.
constexpr double kHighestRise = 4.0;
/// Most pushes end so far above that, likewise: the points further away are looked at where they do not.
constexpr double kNearPushes = 2.0;
constexpr double kRises[] = { 0.0, 1.0, 2.0, kHighestRise };
/// Points within this many radii determine the radius.
constexpr double kSearch = 4.0;

/// Moves of one slide.
constexpr int kMostSlides = 24;
/// What a visit of the pyramid costs, in rounds: a large ball among dense points looks at thousands of them.
constexpr int kRoundsOfPass = 3;
constexpr std::uint64_t kPointsOfRound = 128;
/// Glides of one step.
constexpr int kMostGlides = 3;
constexpr int kMostPushes = 16;
/// Part of the radius that is free of points from which on a ball that begins is out of them.
constexpr double kNearlyOut = 0.8;
/// A point nearer than this many radii is touched.
constexpr double kTouch = 1.002;
constexpr int kMostTouched = 16;
/// A move of a slide goes as far as points are here, unless that is less than this; over the radius.
constexpr double kShortMove = 0.25;
/// Points nearer than so many radii pinch the ball where their normals are so far apart (a cosine).
constexpr double kPinch = 1.02;
constexpr double kOpposite = -0.9;
/// Least radius of a ball that begins where it has no room, over the one it should have.
constexpr double kSmallestRadius = 1e-3;
/// Places further away than this many times the cloud's extent are free whatever the way there.
constexpr double kFarAway = 1e6;
/// A shorter way is none, over the radius.
constexpr double kNoWay = 1e-4;
/// Reach of the points that decide whether the place is flat for the first touch beside an edge, over the
/// radius.
constexpr double kTouchReach = 1.2;
/// How far aside of the HIP, seen along the normal of a flat place, bumps may push the ball, over its radius.
constexpr double kMostAside = 0.25;
/// After a glide that did not help the HIP moves by this many radii before the next.
constexpr double kGlideAgain = 0.05;

/// The vector nearest to @p pull that leads into none of the @p count planes with the unit normals @p n.
Vec3 withinPlanes(const Vec3& pull, const Vec3* n, int count) noexcept
{
  const double slack = -1e-9 * norm(pull);
  const auto allowed = [&](const Vec3& d)
  { return std::all_of(n, n + count, [&](const Vec3& normal) { return dot(normal, d) >= slack; }); };
  if (allowed(pull))
  {
    return pull;
  }
  for (int i = 0; i < count; ++i)
  {
    const double into = dot(n[i], pull);
    const Vec3 along = pull - into * n[i];
    if (into < 0.0 && allowed(along))
    {
      return along;
    }
  }
  Vec3 best;
  for (int i = 0; i < count; ++i)
  {
    for (int j = i + 1; j < count; ++j)
    {
      const Vec3 edge = cross(n[i], n[j]);
      const double length2 = norm2(edge);
      const Vec3 along = length2 > 1e-12 ? (dot(pull, edge) / length2) * edge : Vec3();
      if (norm2(along) > norm2(best) && allowed(along))
      {
        best = along;
      }
    }
  }
  return best;
}

/// How far @p p is outside the box.
double distanceTo(const Bounds& box, const Vec3& p) noexcept
{
  Vec3 outside;
  for (int axis = 0; axis < 3; ++axis)
  {
    outside[axis] = std::max({ box.minimum[axis] - p[axis], p[axis] - box.maximum[axis], 0.0 });
  }
  return norm(outside);
}

/// True where the way to @p p need not be looked at.
bool isFarAway(const HapticScene& scene, const Vec3& p) noexcept
{
  const double far = kFarAway * (norm(scene.bounds().extent()) + scene.clearance());
  return !(std::max({ std::abs(p.x), std::abs(p.y), std::abs(p.z) }) < far + norm(scene.bounds().maximum));
}

}

void ProxyBall::carry(const AffineTransform& change, double scale) noexcept
{
  // Seen from the model it is the hand that moved: what it passes on that way it meets, whatever the
  // transform.
  center_ = change.apply(center_);
  hip_ = change.apply(hip_);
  radius_ *= scale;
  wanted_ *= scale;
  wantedAhead_ *= scale;
  isMeasured_ = false;
  isHeld_ = false;
  flat_.carry(change);
}

void ProxyBall::gather(Work& work, double reach) noexcept
{
  const int passes = work.cells.passes();
  const std::uint64_t looked = work.cells.looked();
  const double likely = free_ ? 0.0 : kReachOfTick * radius_;
  const bool all =
    work.cells.gather(work.scene.contactPyramid(), center_, reach, radius_ / kBallRadiusInCells, likely);
  work.rounds -=
    kRoundsOfPass * (work.cells.passes() - passes) + int((work.cells.looked() - looked) / kPointsOfRound);
  work.status |= std::uint32_t(all ? kProxyOk : kProxyCellLimit);
}

/// Moves the ball out of the points it covers; false where they hold it from all sides.
bool ProxyBall::pushOut(const BallCells& cells) noexcept
{
  for (int push = 0; push < kMostPushes; ++push)
  {
    const int nearest = cells.nearestWithin(center_, (1.0 - kRounding) * radius_);
    if (nearest < 0)
    {
      return true;
    }
    const Vec3 point = cells.point(nearest);
    center_ = point + radius_ * normalized(center_ - point);
  }
  return false;
}

/// Whether points on two sides hold the ball.
bool ProxyBall::isPinched(const BallCells& cells) const noexcept
{
  Vec3 normals[kMostTouched];
  int touched = 0;
  bool result = false;
  cells.visitBall(center_, kPinch * radius_,
    [&](const Vec3& offset, double d2)
    {
      const Vec3 normal = offset / std::sqrt(std::max(d2, 1e-300));
      result = result ||
        std::any_of(normals, normals + touched, [&](const Vec3& n) { return dot(n, normal) < kOpposite; });
      if (touched < kMostTouched)
      {
        normals[touched++] = normal;
      }
    });
  return result;
}

/// Begins near @p hip, outside of all points; where the ball has no room, with a smaller one.
void ProxyBall::place(Work& work, const Vec3& hip) noexcept
{
  placed_ = true;
  center_ = hip;
  hip_ = hip;
  radius_ = kBallRadiusInSpacings * work.scene.contactCell();
  measure(work, hip);
  radius_ = wanted_;
  gather(work, 2.0 * radius_);
  double d2 = 0.0;
  if (!pushOut(work.cells))
  {
    // Nearly out is out, by a ball a little smaller; else there is no room here for one of this size.
    gather(work, radius_);
    const bool isNearlyOut = work.cells.nearest(center_, d2) >= 0 && std::sqrt(d2) >= kNearlyOut * radius_;
    center_ = isNearlyOut ? center_ : hip;
    work.cells.gather(work.scene.contactPyramid(), center_, 2.0 * radius_, radius_);
    if (work.cells.nearest(center_, d2) >= 0)
    {
      radius_ = std::max(kSmallestRadius * radius_, std::min(radius_, (1.0 - kRounding) * std::sqrt(d2)));
    }
  }
  free_ = center_ == hip;
  isConfined_ = radius_ < kTooSmall * wanted_;
}

/// Makes room for a ball that has grown: beside the points that held @p before, or above them, as in a gap of
/// the surface. A ball that grows by more than a little goes only where the smaller one could. False: there
/// is no room.
bool ProxyBall::makeRoom(Work& work, const ProxyBall& before) noexcept
{
  const Vec3 up = flat_.isNear(before.center_, kFlatNear * radius_)
    ? flat_.normal()
    : normalized(before.center_ - hip_, Vec3());
  const Vec3 start = center_;
  const double growth = radius_ - before.radius_;
  const bool isLittle = radius_ <= before.radius_ * kLargestGrowth;
  const double furthest = radius_ + kHighestRise * growth;
  for (const double part : kRises)
  {
    bool isOut = false;
    for (const double reach : { std::min((part + kNearPushes) * growth, furthest), furthest })
    {
      center_ = start;
      gather(work, radius_ + reach + growth);
      center_ += part * growth * up;
      isOut = pushOut(work.cells);
      if (norm2(center_ - start) <= reach * reach)
      {
        break;
      }
    }
    if (isOut && norm2(center_ - start) > furthest * furthest)
    {
      // Pushes led it to where the points that were gathered end.
      gather(work, 2.0 * radius_);
      isOut = isLittle && work.cells.nearestWithin(center_, (1.0 - kRounding) * radius_) < 0;
    }
    const Vec3 way = center_ - before.center_;
    const double length = norm(way);
    // No growth is worth a leap.
    if (isOut &&
      (isLittle ||
        (length <= kHighestRise * growth &&
          work.cells.sweep(before.center_, normalized(way), length, before.radius_) == length)))
    {
      return true;
    }
  }
  return false;
}

bool ProxyBall::isMeasureDue(const HapticScene& scene) const noexcept
{
  const double every = kMeasureEvery * scene.contactCell();
  return !isMeasured_ || norm2(center_ - measuredAt_) > every * every;
}

/// Finds the radius that the cloud asks for about the ball and ahead: what comes may be sparser, and the ball
/// is wide.
void ProxyBall::measure(Work& work, const Vec3& hip) noexcept
{
  if (!free_)
  {
    gather(work, 2.0 * radius_);
  }
  Vec3 ignored;
  const double search =
    kSearch * std::max(radius_, work.scene.fitScale(center_, work.fields, ignored).proxyRadius);
  const auto nearestTo = [&](const Vec3& place, Vec3& point)
  { return work.cells.nearestOf(work.scene.contactPyramid(), place, search, point); };
  Vec3 nearest;
  const bool isFound = nearestTo(center_, nearest);
  const auto wantedAt = [&](const Vec3& seed)
  { return ballRadius(work.scene, work.fields, work.cells, seed, center_); };
  wanted_ = wantedAhead_ = isFound ? wantedAt(nearest) : radius_;
  const Vec3 up = normalized(center_ - hip_);
  const Vec3 course = hip - hip_;
  const Vec3 ahead = normalized(course - dot(course, up) * up);
  Vec3 next;
  if (!free_ && nearestTo(center_ + kAhead * radius_ * ahead, next) && next != nearest)
  {
    wantedAhead_ = wantedAt(next);
    wanted_ = std::max(wanted_, wantedAhead_);
  }
  measuredAt_ = center_;
  isMeasured_ = true;
  if (free_ && wanted_ != radius_)
  {
    const double room = isFound ? (1.0 - kRounding) * norm(center_ - nearest) : wanted_;
    radius_ = std::min(wanted_, std::max(radius_, room));
  }
}

/// Whether it sits in a gap about as wide as itself, where it has room by chance and cannot go on.
bool ProxyBall::isWedged(Work& work) noexcept
{
  gather(work, kPinch * radius_);
  return isPinched(work.cells);
}

/// Takes the radius towards what the cloud asks for: at once where the ball is free, else little by little.
/// It grows only where there is room, and shrinks where it is pinched between points on two sides, or held
/// among points where it began without room: it was on no side of them.
void ProxyBall::updateRadius(Work& work, const Vec3& hip) noexcept
{
  if (isMeasureDue(work.scene))
  {
    measure(work, hip);
  }
  const ProxyBall before = *this;
  if (isHeld_ && (isConfined_ || isWedged(work)))
  {
    radius_ /= kLargestGrowth;
    return;
  }
  const double growth = radius_ < kTooSmall * wanted_ ? kHurriedGrowth : kLargestGrowth;
  const double most = adopts_ ? std::max(wanted_, radius_) : radius_ * growth;
  adopts_ = false;
  radius_ = std::clamp(wanted_, radius_ / kLargestGrowth, most);
  if (radius_ > before.radius_ * growth && !free_)
  {
    // Its point nearest to the HIP stays.
    center_ += (radius_ - before.radius_) * normalized(center_ - hip_, Vec3());
  }
  if (radius_ > before.radius_)
  {
    if (!makeRoom(work, before))
    {
      *this = before;
      adopts_ = false;
      radius_ = isPinched(work.cells) ? radius_ / kLargestGrowth : radius_;
    }
    free_ = free_ && center_ == before.center_;
  }
  isConfined_ = isConfined_ && (!free_ || radius_ < kTooSmall * wanted_);
}

/// A free ball goes with the HIP. @return how far it came before it touched a point, metres.
double ProxyBall::fly(Work& work, const Vec3& direction, double length) noexcept
{
  const Vec3 start = center_;
  double flown = 0.0;
  for (; flown < length && work.rounds > 0; --work.rounds)
  {
    double stride = distanceTo(work.scene.bounds(), center_) - radius_;
    if (!(stride > radius_))
    {
      stride = work.scene.isNear(center_) ? 0.0 : work.scene.clearance() - radius_;
    }
    double reached = std::min(length - flown, stride);
    if (!(stride > radius_))
    {
      const double wanted = std::min(length - flown, radius_);
      gather(work, radius_ + wanted);
      reached = work.cells.sweep(center_, direction, wanted, radius_);
      free_ = reached == wanted;
    }
    flown += reached;
    center_ = start + flown * direction;
    if (!free_)
    {
      pushOut(work.cells);
      touchDown(work);
      break;
    }
  }
  return flown;
}

/// What the ball meets first is what it lies on, also beside an edge.
void ProxyBall::touchDown(Work& work) noexcept
{
  gather(work, kPlaneReach * radius_);
  Vec3 ignored;
  flat_.invalidate();
  if (!flat_.find(work.cells, center_, radius_, kTouchReach * radius_, ignored))
  {
    flat_.find(work.cells, center_, radius_, kPlaneReach * radius_, ignored);
  }
}

void ProxyBall::slide(Work& work, const Vec3& hip) noexcept
{
  const bool isOnFlat =
    flat_.isNear(center_, kFlatNear * radius_) && dot(hip - center_, flat_.normal()) < 0.0;
  const auto aside = [&] { return norm(flat_.along(hip - center_)); };
  const double mostAside = isOnFlat ? std::max(kMostAside * radius_, aside()) : 0.0;
  for (int i = 0; i < kMostSlides && work.rounds > 0; ++i, --work.rounds)
  {
    const Vec3 pull = hip - center_;
    const double here = work.cells.reachAbout(center_) - (kTouch + kNoWay) * radius_;
    const double longest = std::min({ norm(pull), radius_, here > kShortMove * radius_ ? here : radius_ });
    gather(work, kTouch * radius_ + longest);
    work.cells.focus(center_, kFocus * radius_);
    Vec3 normals[kMostTouched];
    int touched = 0;
    work.cells.visitBall(center_, kTouch * radius_,
      [&](const Vec3& offset, double d2)
      {
        if (touched < kMostTouched)
        {
          normals[touched++] = offset / std::sqrt(d2);
        }
      });
    const Vec3 way = withinPlanes(pull, normals, touched);
    const double length = norm(way);
    const bool isOpen = way == pull;
    if (length < kNoWay * radius_ && !(isOpen && length < kNoWay * work.scene.contactCell()))
    {
      return;
    }
    const Vec3 direction = normalized(way);
    const double wanted = std::min(length, longest);
    const double reached = work.cells.sweep(center_, direction, wanted, radius_);
    if (isOpen && reached == length)
    {
      center_ = hip;
      free_ = true;
      return;
    }
    const Vec3 before = center_;
    center_ += reached * direction;
    pushOut(work.cells);
    // Bumps would lead the ball around an edge that the hand has not passed.
    if (isOnFlat && aside() > mostAside && flat_.continuesUnder(work.scene, hip, center_, radius_))
    {
      center_ = before + std::min(reached, flat_.wayAside(before, hip, direction, mostAside)) * direction;
      return;
    }
  }
  work.status |= kProxyRoundLimit;
}

/// Follows the HIP along its way: free, or in strides of a radius where points are touched.
void ProxyBall::walk(Work& work, const Vec3& hip) noexcept
{
  const Vec3 start = hip_;
  const double length = norm(hip - start);
  const Vec3 direction = length > 0.0 ? (hip - start) / length : Vec3();
  double walked = 0.0;
  do
  {
    if (free_)
    {
      walked += fly(work, direction, length - walked);
    }
    if (!free_)
    {
      walked = std::min(length, walked + radius_);
    }
    hip_ = walked < length ? start + walked * direction : hip;
    if (free_)
    {
      center_ = hip_;
    }
    else
    {
      slid_ = true;
      slide(work, hip_);
    }
  } while (walked < length && work.rounds > 0);
}

void ProxyBall::step(const HapticScene& scene, FitCells& fields, BallCells& cells, const Vec3& hip,
  std::uint32_t& status) noexcept
{
  Work work{ scene, fields, cells, kMostRounds, status };
  slid_ = glided_ = false;
  if (isFarAway(scene, hip) || (placed_ && isFarAway(scene, hip_)))
  {
    reset();
    center_ = hip_ = hip;
    radius_ = kBallRadiusInSpacings * scene.contactCell();
  }
  if (isFarAway(scene, hip))
  {
    return;
  }
  if (!placed_)
  {
    place(work, hip);
  }
  else if (!free_ || scene.isNear(center_))
  {
    updateRadius(work, hip);
  }

  walk(work, hip);
  there_ = hip_ == hip;
  status |= std::uint32_t(there_ ? kProxyOk : kProxyStepLimit);
  status |= std::uint32_t(isConfined_ && !free_ ? kProxyCrowded : kProxyOk);
  const double again = kGlideAgain * radius_;
  if (free_ || (isHeld_ && norm2(hip - heldAt_) < again * again) || mayWait(hip))
  {
    return;
  }
  isHeld_ = false;
  const int glides = isPatient_ ? 1 : kMostGlides;
  for (int i = 0; i < glides && !free_ && there_ && work.rounds > 0; ++i)
  {
    if (!glide(work, hip))
    {
      isHeld_ = true;
      heldAt_ = hip;
      break;
    }
    glided_ = true;
    status |= kProxyGliding;
  }
}

} // namespace pointhaptics
