/// @file
/// A ball with its memory, and what it may do among the points, told in long double by looking at all of
/// them.
#pragma once

#include "Haptics/Contact/ProxyBall.h"

#include "HapticFixtures.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace pointhaptics
{
namespace trial
{

using Real = long double;

struct LongVec
{
  LongVec() = default;
  LongVec(Real a, Real b, Real c)
    : x(a)
    , y(b)
    , z(c)
  {
  }
  LongVec(const Vec3& v) // NOLINT: a Vec3 is one, exactly
    : x(v.x)
    , y(v.y)
    , z(v.z)
  {
  }
  Real x = 0.0L;
  Real y = 0.0L;
  Real z = 0.0L;
};

inline LongVec operator+(const LongVec& a, const LongVec& b)
{
  return { a.x + b.x, a.y + b.y, a.z + b.z };
}
inline LongVec operator-(const LongVec& a, const LongVec& b)
{
  return { a.x - b.x, a.y - b.y, a.z - b.z };
}
inline LongVec operator*(Real s, const LongVec& a)
{
  return { s * a.x, s * a.y, s * a.z };
}
inline Real dot(const LongVec& a, const LongVec& b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Real norm(const LongVec& a)
{
  return std::sqrt(dot(a, a));
}

/// The least distance where it is below @p radius, else @p radius: looks at the points near by alone.
inline Real leastDistanceWithin(const HapticScene& scene, const Vec3& p, double radius)
{
  Real least = radius;
  scene.contactPyramid().visitBall(0, p, radius,
    [&](std::uint32_t, const Cell& cell, double)
    { least = std::min(least, norm(LongVec(cell.mean) - LongVec(p))); });
  return least;
}

/// How deep a ball that went straight covered a point on its way, over that point's radius by @p scale, told
/// in long double.
inline Real deepestOnWay(const HapticScene& scene, const Vec3& from, const Vec3& to, double scale)
{
  const LongVec way = LongVec(to) - LongVec(from);
  const Real length = norm(way);
  Real deepest = 0.0L;
  const ContactField& field = scene.contactField();
  field.pyramid().visitBall(0, 0.5 * (from + to), scale * field.largest() + 0.5 * norm(to - from),
    [&](std::uint32_t index, const Cell& cell, double)
    {
      const LongVec offset = LongVec(cell.mean) - LongVec(from);
      const Real along = length > 0.0L ? dot(offset, way) / length : 0.0L;
      const Real at = std::clamp(along, 0.0L, length);
      const Real apart = norm(offset - (length > 0.0L ? at / length : 0.0L) * way);
      const Real radius = Real(scale) * Real(field.radii(0)[index]);
      deepest = std::max(deepest, 1.0L - apart / radius);
    });
  return deepest;
}

/// A ball, its scene and the memory it works in.
class BallInScene
{
public:
  explicit BallInScene(Scene scene)
    : scene_(std::move(scene))
    , cells_(new BallCells)
  {
  }
  /// Another ball in the same scene, with memory of its own.
  BallInScene copy() const
  {
    BallInScene other(scene_);
    other.ball_ = ball_;
    other.hip_ = hip_;
    return other;
  }
  void step(const Vec3& hip)
  {
    hip_ = hip;
    tickStatus_ = 0;
    ball_.step(*scene_, *cells_, hip, false, tickStatus_);
    status_ |= tickStatus_;
  }
  /// Along a straight line at @p speed, metres per second; ends exactly at @p to.
  void go(const Vec3& to, double speed)
  {
    const Vec3 from = hip_;
    const int ticks = int(std::ceil(norm(to - from) / (speed * kTick)));
    for (int i = 1; i <= ticks; ++i)
    {
      step(i == ticks ? to : from + (double(i) / ticks) * (to - from));
    }
  }
  void rest(int ticks)
  {
    for (int i = 0; i < ticks; ++i)
    {
      step(hip_);
    }
  }
  void invalidate() { cells_->invalidate(); }
  /// A new scene, with the ball carried into it. What was gathered from the old one is dropped.
  void enter(Scene scene, const AffineTransform& change, double scale)
  {
    invalidate();
    scene_ = std::move(scene);
    ball_.carry(change, scale);
    hip_ = change.apply(hip_);
  }
  const Vec3& hip() const { return hip_; }
  const HapticScene& scene() const { return *scene_; }
  ProxyBall& ball() { return ball_; }
  const ProxyBall& ball() const { return ball_; }
  const BallCells& cells() const { return *cells_; }
  /// True if the ball glided in the last step.
  bool hasGlided() const { return (tickStatus_ & kProxyGliding) != 0u; }
  /// Status bits since the last call.
  std::uint32_t takeStatus()
  {
    const std::uint32_t bits = status_;
    status_ = 0;
    return bits;
  }

private:
  Scene scene_;
  std::unique_ptr<BallCells> cells_;
  ProxyBall ball_;
  Vec3 hip_;
  std::uint32_t status_ = 0;
  std::uint32_t tickStatus_ = 0;
};

inline bool isFinite(const ProxyBall& ball)
{
  using pointhaptics::isFinite;
  return isFinite(ball.center()) && std::isfinite(ball.radius());
}

inline bool isSame(const ProxyBall& a, const ProxyBall& b)
{
  return a.center() == b.center() && a.radius() == b.radius() && a.isFree() == b.isFree();
}

/// @p n x @p n points of a square about the origin at height @p z, each somewhere in its own cell.
inline std::vector<Vec3> jitteredPlane(int n, double side, double z, Random& random, double jitter = 0.7)
{
  std::vector<Vec3> points;
  const double cell = side / n;
  for (int i = 0; i < n; ++i)
  {
    for (int j = 0; j < n; ++j)
    {
      const double x = (i + 0.5 + 0.5 * jitter * random.uniform(-1, 1)) * cell;
      const double y = (j + 0.5 + 0.5 * jitter * random.uniform(-1, 1)) * cell;
      points.emplace_back(x - 0.5 * side, y - 0.5 * side, z);
    }
  }
  return points;
}

inline std::vector<Vec3> spherePoints(int n, double radius, Random& random)
{
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i)
  {
    points.push_back(radius * random.direction());
  }
  return points;
}

} // namespace trial
} // namespace pointhaptics
