#include "Haptics/Contact/GradientSteps.h"

#include "Haptics/Contact/BallLengths.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace
{

struct Penetration
{
  Vec3 sum; ///< v_n, metres
  double points = 0.0;
};

Penetration penetration(const HapticScene& scene, const Vec3& center, double radius)
{
  Penetration result;
  scene.pyramid().visitBall(0, center, radius,
    [&](std::uint32_t, const Cell& cell, double d2)
    {
      const double d = std::sqrt(d2);
      if (d > 0.0)
      {
        result.sum += ((radius - d) / d) * (center - cell.mean);
      }
      result.points += 1.0;
    });
  return result;
}

Vec3 bounded(const Vec3& step, double longest)
{
  const double length = norm(step);
  return length > longest ? (longest / length) * step : step;
}

}

GradientStepsParameters GradientStepsParameters::tuned()
{
  GradientStepsParameters parameters;
  parameters.freeGain = 0.5;
  parameters.normalGain = 1.0;
  parameters.tangentGain = 0.3;
  parameters.sinkTolerance = 0.1;
  parameters.largestStep = 0.02;
  parameters.normalizedByDensity = true;
  return parameters;
}

void GradientSteps::carry(const AffineTransform& from, const AffineTransform& to) noexcept
{
  const AffineTransform change = to * from.inverse();
  center_ = change.apply(center_);
  radius_ *= std::cbrt(std::abs(change.determinant()));
  normal_ = normalized(change.applyToNormal(normal_), normal_);
}

void GradientSteps::oneStep(
  const HapticScene& scene, const HapticParameters& parameters, const Vec3& hip, double radius) noexcept
{
  const GradientStepsParameters& gains = parameters.gradientSteps;
  const double longest = ball::kStride * radius; // a longer step could jump over a surface
  const Penetration inside = penetration(scene, center_, radius);
  const Vec3 toHip = hip - center_;
  const double sunk = norm(inside.sum);
  if (inside.points == 0.0 || sunk == 0.0)
  {
    contact_ = false;
    center_ += bounded(gains.freeGain * toHip, gains.largestStep * radius);
    return;
  }
  const double zeta = gains.sinkTolerance * radius;
  Vec3 push = gains.normalGain * inside.sum;
  if (gains.normalizedByDensity)
  {
    push = (gains.normalGain / inside.points * std::max(0.0, sunk - zeta) / sunk) * inside.sum;
  }
  if (dot(inside.sum, toHip) >= 0.0)
  {
    // The HIP is outside: leave the surface with it.
    contact_ = false;
    const Vec3 sinking = sunk > zeta ? push : Vec3();
    center_ += bounded(gains.freeGain * toHip, gains.largestStep * radius) + bounded(sinking, longest);
    return;
  }
  contact_ = true;
  normal_ = inside.sum / sunk;
  const Vec3 tangential = toHip - dot(normal_, toHip) * normal_;
  double part = gains.tangentGain;
  if (parameters.contact.staticFriction > 0.0)
  {
    const double along = norm(tangential);
    const double across = std::abs(dot(normal_, toHip));
    const double hold =
      (sticking_ ? parameters.contact.staticFriction : parameters.contact.dynamicFriction) * across;
    sticking_ = along <= hold;
    part *= sticking_ ? 0.0 : std::max(0.0, 1.0 - parameters.contact.dynamicFriction * across / along);
  }
  center_ += bounded(part * tangential, gains.largestStep * radius) + bounded(push, longest);
}

void GradientSteps::step(const HapticScene& scene, const HapticParameters& parameters, const Vec3& hip,
  double dt, ProxyState& state) noexcept
{
  if (!placed_)
  {
    center_ = hip;
    placed_ = true;
  }
  const GradientStepsParameters& gains = parameters.gradientSteps;
  const double wanted = std::round(dt / gains.stepPeriodSeconds);
  const int steps = int(std::clamp(wanted, 1.0, double(std::max(1, gains.maximumStepsPerTick))));
  if (wanted > double(gains.maximumStepsPerTick))
  {
    state.status |= kProxyStepLimit;
  }
  const double radius = scene.coveringRadius(center_);
  if (adopts_ && contact_)
  {
    center_ += (radius - radius_) * normalized(center_ - hip, Vec3());
  }
  adopts_ = false;
  radius_ = radius;
  for (int i = 0; i < steps; ++i)
  {
    oneStep(scene, parameters, hip, radius);
  }
  const Vec3 toHip = hip - center_;
  const double distance = norm(toHip);
  state.radius = radius;
  state.sphereCenter = center_;
  state.normal = normal_;
  state.contact = contact_ && distance > radius;
  state.proxy = state.contact ? center_ + (radius / distance) * toHip : hip;
}

} // namespace pointhaptics
