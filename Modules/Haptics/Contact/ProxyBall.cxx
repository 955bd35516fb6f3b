#include "Haptics/Contact/ProxyBall.h"

#include "Haptics/Proxy.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace
{

using namespace ball;

/// Moves of one slide, pushes out of points, and touched points that bound a move. With eight times as many
/// more hands go around noisy rims.
constexpr int kMostMoves = 24;
/// A visit of the pyramid costs a round of the budget for each kPointsOfRound points that it examines: a
/// large ball among dense points examines thousands.
constexpr std::uint64_t kPointsOfRound = 128;
/// Glides of one step: without a bound they use up the budget.
constexpr int kMostGlides = 3;
/// A point nearer than this many radii is touched: with 1 rounding would lose the points that hold the ball.
constexpr double kTouch = 1.002;
/// Reach of the points that decide whether the place is flat for the first touch beside an edge, over the
/// radius. With kPlaneReach a hand falls off a sharp wedge.
constexpr double kTouchReach = 1.2;
/// Places further away than this many times the cloud's extent are free without a look at the way there.
constexpr double kFarAway = 1e6;

/// The vector nearest to @p pull that points into none of the @p count planes with unit normals @p n.
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

/// Distance of @p p from the box; 0 inside.
double distanceTo(const Bounds& box, const Vec3& p) noexcept
{
  Vec3 outside;
  for (int axis = 0; axis < 3; ++axis)
  {
    outside[axis] = std::max({ box.minimum[axis] - p[axis], p[axis] - box.maximum[axis], 0.0 });
  }
  return norm(outside);
}

/// True where the ball may jump to @p p without a look at the way.
bool isFarAway(const HapticScene& scene, const Vec3& p) noexcept
{
  const double far = kFarAway * (norm(scene.bounds().extent()) + scene.clearance());
  return !(std::max({ std::abs(p.x), std::abs(p.y), std::abs(p.z) }) < far + norm(scene.bounds().maximum));
}

}

void ProxyBall::carry(const AffineTransform& change, double scale) noexcept
{
  // In the model's frame the hand has moved: the ball meets all that lies on that way, whatever the
  // transform.
  center_ = change.apply(center_);
  hip_ = change.apply(hip_);
  radius_ *= scale;
  heldAt_ = { NAN, NAN, NAN };
  flat_.carry(change);
}

void ProxyBall::gather(Work& work, double way) noexcept
{
  const std::uint64_t looked = work.cells.pointsExamined();
  const bool all = work.cells.gather(work.scene.contactField(), center_, way, radius_);
  work.rounds -= int((work.cells.pointsExamined() - looked) / kPointsOfRound);
  work.status |= std::uint32_t(all ? kProxyOk : kProxyCellLimit);
}

/// Moves the ball out of the points that it covers. False: they enclose it.
bool ProxyBall::pushOut(const BallCells& cells) noexcept
{
  for (int push = 0; push < kMostMoves; ++push)
  {
    const int deepest = cells.deepest(center_, kClear * scale_);
    if (deepest < 0)
    {
      return true;
    }
    const Vec3 point = cells.point(deepest);
    center_ = point + scale_ * cells.radius(deepest) * normalized(center_ - point);
  }
  return false;
}

/// Moves a ball whose full radius is @p full out of the points that it covers, by a diameter at most; where
/// that is not enough, it stays and becomes as small as there is room.
void ProxyBall::makeRoom(Work& work, double full) noexcept
{
  gather(work, 2.0 * radius_);
  const Vec3 before = center_;
  if (!pushOut(work.cells) || norm(center_ - before) > 2.0 * radius_)
  {
    center_ = before;
    scale_ = std::max(kNoWay, std::min(scale_, work.cells.roomAt(center_)));
    radius_ = scale_ * full;
  }
}

/// Places the ball near @p hip, outside of all points, or a smaller ball where it has no room.
void ProxyBall::place(Work& work, const Vec3& hip) noexcept
{
  isPlaced_ = true;
  center_ = hip_ = hip;
  scale_ = 1.0;
  radius_ = work.scene.contactField().typical();
  gather(work, 2.0 * radius_);
  const int nearest = work.cells.deepest(center_, 1.0);
  radius_ = nearest >= 0 ? work.cells.radius(nearest) : radius_;
  makeRoom(work, radius_);
}

/// Keeps the contact point of a ball in a scene with other points of the same place.
void ProxyBall::placeAmongOthers(Work& work) noexcept
{
  isAmongOthers_ = false;
  heldAt_ = { NAN, NAN, NAN };
  if (isFree())
  {
    return;
  }
  const Vec3 up = normalized(center_ - hip_, Vec3());
  const Vec3 contact = center_ - radius_ * up;
  gather(work, radius_);
  double wanted = radius_ / scale_;
  work.cells.visitTouched(
    contact, 1.0, [&](const Vec3&, double radius) { wanted = std::max(wanted, radius); });
  // A larger ball stands above the contact point; a smaller one goes down by itself.
  center_ = contact + scale_ * wanted * up;
  radius_ = scale_ * wanted;
  makeRoom(work, wanted);
}

/// Lets a free ball that began too small grow as far as there is room.
void ProxyBall::grow(Work& work) noexcept
{
  if (scale_ < 1.0 && isFree())
  {
    gather(work, 0.0);
    const double before = scale_;
    scale_ = std::max(scale_, work.cells.roomAt(center_));
    radius_ *= scale_ / before;
  }
}

/// Moves the ball along the unit vector @p direction by up to @p length metres. @param gone receives how far.
/// @return false if it touched a point.
bool ProxyBall::advance(Work& work, const Vec3& direction, double length, double& gone) noexcept
{
  const Vec3 start = center_;
  const double largest = work.scene.contactField().largest();
  bool isClear = true;
  for (gone = 0.0; gone < length && isClear && work.rounds > 0; --work.rounds)
  {
    double stride = distanceTo(work.scene.bounds(), center_) - largest;
    if (!(stride > radius_))
    {
      stride = work.scene.isNear(center_) ? 0.0 : work.scene.clearance() - largest;
    }
    double reached = std::min(length - gone, stride);
    if (!(stride > radius_))
    {
      const double wanted = std::min(length - gone, radius_);
      gather(work, wanted);
      reached = work.cells.sweep(center_, direction, wanted, scale_);
      isClear = reached == wanted;
    }
    gone += reached;
    center_ = start + gone * direction;
  }
  return isClear;
}

/// Takes the radius of the touched point and looks for the flat place there, also beside an edge: the ball
/// lies on the point that it meets first.
void ProxyBall::touchDown(Work& work) noexcept
{
  gather(work, kTouch * radius_);
  work.cells.visitTouched(
    center_, kTouch * scale_, [this](const Vec3&, double radius) { radius_ = radius / kTouch; });
  gather(work, kPlaneReach * radius_);
  Vec3 ignored;
  flat_.invalidate();
  if (!flat_.find(work.cells, center_, radius_, kTouchReach * radius_, ignored))
  {
    flat_.find(work.cells, center_, radius_, kPlaneReach * radius_, ignored);
  }
}

/// Moves a touching ball towards the HIP in at most kMostMoves moves. Each takes the parts of the pull that
/// lead into touched points away, goes up to the next point, and leaves what rounding made it cover. Sets
/// kProxyRoundLimit where moves or rounds run out.
void ProxyBall::slide(Work& work, const Vec3& hip) noexcept
{
  const bool isOnFlat =
    flat_.isNear(center_, kFlatNear * radius_) && dot(hip - center_, flat_.normal()) < 0.0;
  const auto aside = [&] { return norm(flat_.along(hip - center_)); };
  // Bumps may not push the ball further aside than kAside, or than it was at the start.
  const double mostAside = isOnFlat ? std::max(kAside * radius_, aside()) : 0.0;
  for (int i = 0; i < kMostMoves && work.rounds > 0; ++i, --work.rounds)
  {
    const Vec3 pull = hip - center_;
    // A move ends where the gathered points end; where that is too short, points are gathered for a radius.
    // The margin of kTouch keeps the points that are touched after the move.
    const double gathered = work.cells.reachAbout(center_) - (kTouch - 1.0 + kNoWay) * radius_;
    const double longest =
      std::min({ norm(pull), radius_, gathered > kAside * radius_ ? gathered : radius_ });
    gather(work, (kTouch - 1.0) * work.scene.contactField().largest() + longest);
    work.cells.focus(center_, kAside * radius_);
    Vec3 normals[kMostMoves];
    int touched = 0;
    double mostOpposed = 0.0; // the ball takes the radius of the touched point that opposes the pull most
    work.cells.visitTouched(center_, kTouch * scale_,
      [&](const Vec3& offset, double radius)
      {
        const Vec3 normal = normalized(offset);
        const double against = dot(normal, pull);
        radius_ = against < mostOpposed ? radius / kTouch : radius_;
        mostOpposed = std::min(mostOpposed, against);
        if (touched < kMostMoves)
        {
          normals[touched++] = normal;
        }
      });
    const Vec3 way = withinPlanes(pull, normals, touched);
    const double length = norm(way);
    const bool isUnobstructed = way == pull;
    // A way too short to matter ends the slide; but an unobstructed ball within kNoWay cells of the HIP goes
    // onto it and is free.
    if (length < kNoWay * radius_ && !(isUnobstructed && length < kNoWay * work.scene.contactCell()))
    {
      return;
    }
    const Vec3 direction = normalized(way);
    const double wanted = std::min(length, longest);
    const double reached = work.cells.sweep(center_, direction, wanted, scale_);
    if (isUnobstructed && reached == length)
    {
      center_ = hip;
      return;
    }
    const Vec3 before = center_;
    center_ += reached * direction;
    pushOut(work.cells);
    // Where the flat place continues under the HIP, bumps would push the ball around an edge that the hand
    // has not passed: the move ends at mostAside.
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
    bool flies = isFree();
    if (flies)
    {
      double flown = 0.0;
      flies = advance(work, direction, length - walked, flown);
      walked += flown;
      if (!flies)
      {
        pushOut(work.cells);
        touchDown(work);
      }
    }
    walked = flies ? walked : std::min(length, walked + radius_);
    hip_ = walked < length ? start + walked * direction : hip;
    if (flies)
    {
      center_ = hip_;
    }
    else
    {
      hasSlid_ = true;
      slide(work, hip_);
    }
  } while (walked < length && --work.rounds > 0);
}

void ProxyBall::step(
  const HapticScene& scene, BallCells& cells, const Vec3& hip, bool isPatient, std::uint32_t& status) noexcept
{
  Work work{ scene, cells, status };
  hasSlid_ = false;
  if (isFarAway(scene, hip) || (isPlaced_ && isFarAway(scene, hip_)))
  {
    reset();
    center_ = hip_ = hip;
    radius_ = scene.contactField().typical();
  }
  if (isFarAway(scene, hip))
  {
    return;
  }
  if (!isPlaced_)
  {
    place(work, hip);
  }
  if (isAmongOthers_)
  {
    placeAmongOthers(work);
  }
  grow(work);

  walk(work, hip);
  status |= std::uint32_t(isThere(hip) ? kProxyOk : kProxyStepLimit);
  status |= std::uint32_t(scale_ < 1.0 && !isFree() ? kProxyCrowded : kProxyOk);
  const double again = 0.5 * kBump * radius_;
  const bool waits = isFree() || norm2(hip - heldAt_) < again * again || mayWait(hip, isPatient);
  hasRidden_ = false;
  heldAt_ = waits ? heldAt_ : Vec3{ NAN, NAN, NAN };
  const int glides = waits || !isThere(hip) ? 0 : isPatient ? 1 : kMostGlides;
  for (int i = 0; i < glides && !isFree() && work.rounds > 0; ++i)
  {
    if (!glide(work, hip))
    {
      heldAt_ = hip;
      break;
    }
    status |= kProxyGliding;
  }
}

} // namespace pointhaptics
