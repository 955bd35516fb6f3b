#include "Haptics/Contact/ProxyBall.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace pointhaptics
{
namespace
{

using namespace ball;

/// Least gain of a glide, over the radius. With a tenth of it a hand on noise of one spacing trembles.
constexpr double kLeastGain = 1e-3;
/// Lifts that take the ball off its points, over the radius: a deep gap needs the second.
constexpr double kLifts[] = { 0.0, 0.3, 0.6 };
/// Height of a riding ball above the surface, over the noise: the points of a noisy surface hold a lower one
/// back.
constexpr double kAboveNoise = 2.0;

}

/// Returns the normal of the plane through the points about the ball. Where they are not flat, as at an edge,
/// the last flat place near by gives it: the ball has not gone around yet.
Vec3 ProxyBall::surfaceNormal(const BallCells& cells) noexcept
{
  Vec3 away;
  if (!flat_.find(cells, center_, radius_, kPlaneReach * radius_, away) &&
    !(flat_.isNear(center_, kFlatNear * radius_) && dot(flat_.normal(), away) >= 0.0))
  {
    flat_.invalidate();
  }
  return flat_.isKnown() ? flat_.normal() : away;
}

/// True if the ball lies on a flat place and leans so little that it may wait.
bool ProxyBall::mayWait(const Vec3& hip, bool isPatient) const noexcept
{
  return !hasRidden_ && flat_.isNear(center_, kFlatNear * radius_) &&
    norm(flat_.along(hip - center_)) < (isPatient ? kStride : kFace) * radius_;
}

bool ProxyBall::glide(Work& work, const Vec3& hip) noexcept
{
  gather(work, kPlaneReach * radius_);
  const Vec3 up = surfaceNormal(work.cells);
  const Vec3 pull = hip - center_;
  const Vec3 lean = pull - dot(pull, up) * up;
  const double leaning = norm(lean);
  if (leaning < kLeastGain * radius_)
  {
    return false;
  }
  // Points that rise from the surface are a wall. Beside a wall a move counts as progress only if it brings
  // the ball nearer to the HIP.
  bool isWalled = !flat_.isKnown();
  const double highest = isWalled ? 0.0 : flat_.height(center_) - kFace * radius_;
  work.cells.visitBall(center_, kPlaneReach * radius_,
    [&](const Vec3& offset, double) { isWalled = isWalled || dot(offset, up) < highest; });
  const ProxyBall before = *this;
  const Vec3 direction = lean / leaning;
  for (const double lift : kLifts)
  {
    gather(work, (kStride + lift) * radius_);
    // A smaller ball passes bumps; a lift takes the ball out of deeper gaps.
    const double ball = lift > 0.0 ? scale_ : (1.0 - kBump) * scale_;
    center_ += work.cells.sweep(center_, up, lift * radius_, ball) * up;
    center_ += work.cells.sweep(center_, direction, std::min(leaning, kStride * radius_), ball) * direction;
    const bool isOut = pushOut(work.cells);
    if (lift > 0.0)
    {
      slide(work, hip);
    }
    const Vec3 left = hip - center_;
    const double stillLeaning = isWalled ? norm(left) : norm(left - dot(left, up) * up);
    // A glide follows the surface: a ball that sank by more than a stride has gone around a rim. Noise above
    // the bumps says nothing about where the surface is.
    const bool isAlong = dot(center_ - before.center_, up) >= -kStride * before.radius_ ||
      kAboveNoise * work.scene.noise(before.center_) > kBump * before.radius_;
    if (isOut && isAlong && stillLeaning <= (isWalled ? norm(pull) : leaning) - kLeastGain * radius_ &&
      norm(left) <= norm(pull) + kBump * radius_)
    {
      // Judged before this slide, or a ball that slides around a rim would count as nearer.
      if (lift == 0.0)
      {
        slide(work, hip);
      }
      return true;
    }
    *this = before;
  }
  return false;
}

bool ProxyBall::goTo(const HapticScene& scene, BallCells& cells, const Vec3& foot, const Vec3& up,
  std::uint32_t& status) noexcept
{
  // At an edge sharper than a right angle the HIP passes the other face before it is past the edge.
  if (dot(hip_ - foot, up) >= 0.0 && flat_.isNear(center_, kFlatNear * radius_) &&
    dot(hip_ - flat_.height(hip_) * flat_.normal() - foot, up) < -kLeastGain * radius_)
  {
    return false;
  }
  Work work{ scene, cells, status };
  const ProxyBall before = *this;
  const double furthest = norm(hip_ - center_) + kBump * radius_;
  const double beside = std::clamp(radius_ - dot(center_ - foot, up), 0.0, kFlatNear * radius_);
  for (std::size_t i = 1; i < std::size(kLifts); ++i)
  {
    const double lift = kLifts[i] * radius_;
    // Lift the ball off its points, in a gap only to the middle; move it past the edge, lower it.
    const Vec3 away = normalized(center_ - hip_);
    double gone = 0.0;
    center_ -= advance(work, away, lift, gone) ? Vec3() : 0.5 * gone * away;
    advance(work, up, beside + lift, gone);
    const Vec3 way = foot + (radius_ + lift) * up - center_;
    advance(work, normalized(way), norm(way), gone);
    slide(work, hip_);
    if (isFree() || (norm(hip_ - center_) < furthest && norm(center_ - foot) < kPlaneReach * radius_))
    {
      return true;
    }
    *this = before;
  }
  return false;
}

bool ProxyBall::hasPointsAround(
  const HapticScene& scene, BallCells& cells, const Vec3& foot, const Vec3& up) const noexcept
{
  cells.gather(scene.contactField(), foot, radius_, radius_);
  // The points seen so far lie between two directions less than half a turn apart.
  Vec3 right;
  Vec3 left;
  bool isAround = false;
  cells.visitBall(foot, radius_,
    [&](const Vec3& offset, double)
    {
      const double height = dot(offset, up);
      const Vec3 flat = offset - height * up;
      const bool isInFace = std::abs(height) < kFace * radius_ && norm(flat) > kNoWay * radius_;
      const Vec3 inFace = isInFace ? flat : Vec3();
      const double fromRight = dot(cross(right, inFace), up);
      const double fromLeft = dot(cross(left, inFace), up);
      isAround = isAround || (fromRight < 0.0 && fromLeft > 0.0);
      right = fromRight < 0.0 || right == Vec3() ? inFace : right;
      const bool isOpposite = fromRight == 0.0 && dot(right, inFace) < 0.0;
      left = fromLeft > 0.0 || left == Vec3() || isOpposite ? inFace : left;
    });
  return isAround;
}

bool ProxyBall::ride(const HapticScene& scene, BallCells& cells, const Vec3& hip, const Vec3& foot,
  const Vec3& up, double noise, std::uint32_t& status) noexcept
{
  if (isFree() || scale_ < 1.0 || isAmongOthers_)
  {
    return false;
  }
  Work work{ scene, cells, status };
  const ProxyBall before = *this;
  gather(work, norm(foot - center_) + (kPlaneReach - 1.0) * scene.contactField().largest());
  double largest = 0.0;
  cells.visitTouched(foot, kPlaneReach,
    [&](const Vec3& offset, double radius)
    { largest = std::max(largest, norm2(offset) < radius_ * radius_ ? radius / kPlaneReach : 0.0); });
  radius_ = largest > 0.0 ? largest : radius_;
  const double above = std::max(kBump * radius_, kAboveNoise * noise);
  const Vec3 way = foot + (radius_ + above) * up - center_;
  const double rise = std::max(0.0, dot(way, up));
  const Vec3 across = way - rise * up;
  const double length = norm(across);
  bool isOut = rise + length <= kStride * radius_;
  if (isOut)
  {
    gather(work, rise + length);
    cells.focus(center_, kAside * radius_);
    const auto goes = [&](const Vec3& direction, double distance)
    {
      const bool isClear = cells.sweep(center_, direction, distance, scale_) == distance;
      center_ += distance * direction;
      return isClear;
    };
    isOut = goes(up, rise) && goes(normalized(across), length) && this->isClear(cells);
  }
  if (!isOut)
  {
    *this = before;
    return false;
  }
  hip_ = hip;
  heldAt_ = { NAN, NAN, NAN };
  hasRidden_ = true;
  // A fit leans towards an edge before it ends there; a plane through the points does not.
  Vec3 ignored;
  if (!flat_.isNear(center_, kStride * radius_))
  {
    gather(work, kPlaneReach * radius_);
    if (!flat_.find(work.cells, center_, radius_, kPlaneReach * radius_, ignored) &&
      !flat_.isNear(center_, kFlatNear * radius_))
    {
      flat_.set(foot, up, center_);
    }
  }
  return true;
}

} // namespace pointhaptics
