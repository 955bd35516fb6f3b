#include "Haptics/Contact/SurfaceTracker.h"

#include "Haptics/Contact/BallLengths.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace
{

/// Largest number of fits in a call: a tick must be bounded.
constexpr int kRounds = 8;
/// The point has converged when one more round would move it by less than this part of the fit radius.
constexpr double kConverged = 1e-5;
/// Part of the noise below which moving on is pointless. Without it a tick on noise takes 1.4 times as long.
constexpr double kConvergedNoise = 3e-3;
/// Rounds lead away where they end farther from the target by more than this, over the fit radius. With 0 a
/// hand deep inside of stairs is let go for some ticks.
constexpr double kAwaySlack = 1e-3;
/// A call moves the point by at most so many fit radii: without it a hand at rest on noise trembles.
constexpr double kFurthestRadii = 2.0;
/// Slopes of a fit may differ from those that the last one predicted by this much; at edges they differ by
/// 0.07 and more.
constexpr double kForeseen = 0.03;
/// The surface continues on all sides if the weighted centroid of the cells is nearer than this, over the fit
/// radius; a straight rim has 0.235.
constexpr double kInner = 0.1;
/// Traced slopes amplify noise: they fade out up to this ratio of fit radius to counted radius.
constexpr double kTracedNoMore = 1.3;

double tracedStrength(const LocalScale& scale)
{
  const double growth = scale.radius / scale.countRadius;
  const double t = std::clamp((growth - 1.0) / (kTracedNoMore - 1.0), 0.0, 1.0);
  return 1.0 - t * t * (3.0 - 2.0 * t);
}

}

void SurfaceTracker::adopt(const Vec3& foot, const Vec3& normal) noexcept
{
  frame_.origin = foot;
  frame_.turnTo(normal);
  for (int i = 0; i < 3; ++i)
  {
    curvature_[i] = fit_.k[3 + i] / fit_.radius;
  }
}

void SurfaceTracker::start(const SurfaceFrame& frame, const double (&curvature)[3]) noexcept
{
  *this = SurfaceTracker();
  frame_ = frame;
  std::copy(curvature, curvature + 3, curvature_);
}

void SurfaceTracker::lookFrom(const Vec3& side) noexcept
{
  if (this->height(side) < 0.0)
  {
    frame_.turnTo(-frame_.normal);
    std::transform(curvature_, curvature_ + 3, curvature_, [](double c) { return -c; });
  }
}

bool SurfaceTracker::refit(const HapticScene& scene, FitCells& memory) noexcept
{
  FitSettings settings;
  TracedSlopes slopes;
  const LocalScale scale = scene.fitScale(frame_.origin, memory, slopes.radiusGradient);
  slopes.strength = scene.hasExactMoments() ? tracedStrength(scale) : 0.0;
  slopes.cubic = scale.cubic;
  settings.radius = scale.radius;
  settings.gate = scale.gate;
  std::copy(curvature_, curvature_ + 3, settings.curvature);
  SurfaceFit fit = fitSurface(scene.pyramid(), frame_, settings, memory, &slopes);
  for (int i = 0; i < kWidenings && fit.quality != FitQuality::Quadric; ++i)
  {
    settings.radius *= kWidening;
    slopes.radiusGradient *= kWidening;
    fit = fitSurface(scene.pyramid(), frame_, settings, memory, &slopes);
  }
  if (fit.quality == FitQuality::None)
  {
    return false;
  }
  fit_ = fit;
  fitFrame_ = frame_;
  scale_ = scale;
  return true;
}

/// Finds the next place of frame_ after the round @p now. @param before null in the first round.
void SurfaceTracker::nextPlace(const Round& now, const Round* before, Vec3& place, Vec3& normal) noexcept
{
  const auto inPlane = [&](const Vec3& v) { return Vec3(dot(v, fitFrame_.a), dot(v, fitFrame_.b), 0.0); };
  if (before)
  {
    // A fit changes with its origin, so the foot that it shows is not where the rounds end. Aitken's rule
    // learns from the last step how far to go; a gain that no relaxation converges with is none.
    const Vec3 nearer = inPlane(before->step - now.step);
    const double learned = dot(inPlane(now.origin - before->origin), nearer) / norm2(nearer);
    gain_ = learned > 0.0 && learned < 2.0 ? learned : 1.0;
  }
  // Rounds that lead away swing about the answer.
  const bool swings = before && now.distance > before->distance + kAwaySlack * fit_.radius;
  gain_ = swings ? 1.0 : gain_;
  const Vec3 goal = inPlane(now.origin - fitFrame_.origin) + (swings ? 0.5 : gain_) * inPlane(now.step);
  pointAt(fit_, fitFrame_, goal.x / fit_.radius, goal.y / fit_.radius, place, normal);
}

TrackResult SurfaceTracker::follow(const HapticScene& scene, FitCells& memory, const Vec3& target) noexcept
{
  const Vec3 start = frame_.origin;
  bool isForeseen = true;
  Round last;
  for (int round = 0; round < kRounds; ++round)
  {
    // The first round takes the fit of the last call, whose origin is a negligible step away.
    if (!fresh_ && !refit(scene, memory))
    {
      return TrackResult::Lost;
    }
    fresh_ = false;
    Vec3 place;
    Vec3 normal;
    footPoint(fit_, fitFrame_, target, place, normal);
    const Round now{ frame_.origin, place - frame_.origin, norm(target - frame_.origin) };
    nextPlace(now, round > 0 ? &last : nullptr, place, normal);
    isForeseen = isForeseen && isFinite(place) && std::hypot(fit_.k[1], fit_.k[2]) < kForeseen;
    // The test is negated, so that a place that is not finite is rejected too.
    if (!(norm(place - start) <= kFurthestRadii * fit_.radius))
    {
      return isForeseen ? TrackResult::Far : TrackResult::Lost;
    }
    adopt(place, normal);
    // The steps shrink geometrically: estimate the next one from the last two.
    const double length = norm(now.step);
    const double next = round > 0 ? length * std::min(1.0, length / norm(last.step)) : length;
    if (!(next > std::max(kConverged * fit_.radius, kConvergedNoise * fit_.residual)))
    {
      fresh_ = true;
      return TrackResult::Converged;
    }
    last = now;
  }
  return TrackResult::RoundLimit;
}

void SurfaceTracker::carry(const AffineTransform& from, const AffineTransform& to) noexcept
{
  const AffineTransform change = to * from.inverse();
  frame_.origin = change.apply(frame_.origin);
  frame_.turnTo(normalized(change.applyToNormal(frame_.normal), frame_.normal));
  std::fill(curvature_, curvature_ + 3, 0.0);
  gain_ = 1.0;
  fresh_ = false;
}

double SurfaceTracker::heightAboveFit(const Vec3& p) const noexcept
{
  const Vec3 local = (1.0 / fit_.radius) * fitFrame_.toLocal(p);
  return fit_.radius * (local.z - fit_.height(local.x, local.y));
}

bool SurfaceTracker::continuesAround() const noexcept
{
  return fit_.quality == FitQuality::Quadric && std::hypot(fit_.centroidU, fit_.centroidV) < kInner;
}

void SurfaceTracker::alongSurface(const Vec3& t, Vec3& point, Vec3& normal) const noexcept
{
  const Vec3 local = (1.0 / fit_.radius) * fitFrame_.toLocal(frame_.origin + t);
  const double length = std::hypot(local.x, local.y);
  const double scale = length > ball::kStride ? ball::kStride / length : 1.0;
  pointAt(fit_, fitFrame_, scale * local.x, scale * local.y, point, normal);
  // Beyond its reach the curvature of the fit means nothing.
  const Vec3 rest = (1.0 - scale) * fit_.radius * (local.x * fitFrame_.a + local.y * fitFrame_.b);
  point += rest - dot(rest, normal) * normal;
}

} // namespace pointhaptics
