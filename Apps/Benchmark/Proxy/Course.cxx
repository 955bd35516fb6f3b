#include "Benchmark/Proxy/Course.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

namespace pointhaptics::bench::proxy
{
namespace
{

constexpr double kHandSpeed = 0.047;
constexpr double kSheetTop = 0.0004;
/// Points at which a curve is measured before it is walked at constant speed.
constexpr int kCurveSamples = 4000;

using Curve = std::function<Vec3(double)>;

/// A place on the surface for each angle: closed, smooth, away from rims and edges.
Vec3 place(Shape shape, double angle)
{
  const double tilt = 0.9 + 0.4 * std::sin(2.0 * angle);
  const Vec3 direction{ std::sin(tilt) * std::cos(angle), std::sin(tilt) * std::sin(angle), std::cos(tilt) };
  switch (shape)
  {
    case Shape::Sphere:
    case Shape::Idol:
      return 0.025 * direction;
    case Shape::Ellipsoid:
      return { 0.040 * direction.x, 0.025 * direction.y, 0.018 * direction.z };
    case Shape::Torus:
    {
      const double tube = 0.8 + 1.5 * std::sin(angle);
      const double r = 0.025 + 0.010 * std::cos(tube);
      return { r * std::cos(angle), r * std::sin(angle), 0.010 * std::sin(tube) };
    }
    case Shape::Box:
      return { 0.012 * std::cos(angle), 0.010 * std::sin(angle), 0.025 };
    case Shape::Edge:
      return { -0.018 + 0.012 * std::cos(angle), 0.020 * std::sin(angle), 0.0 };
    case Shape::Hole:
      return { 0.026 * std::cos(angle), 0.024 * std::sin(angle), 0.0 };
    case Shape::Plane:
    case Shape::Saddle:
    case Shape::Sheet:
    case Shape::DensityStep:
      break;
  }
  const double x = 0.020 * std::cos(angle);
  const double y = 0.016 * std::sin(angle) + 0.004 * std::sin(2.0 * angle);
  return { x, y, shape == Shape::Saddle ? (x * x - y * y) / 0.1 : shape == Shape::Sheet ? kSheetTop : 0.0 };
}

/// The outward normal at a point of the surface.
Vec3 normalAt(Shape shape, const Vec3& onSurface)
{
  return closestPoint(shape, onSurface).normal;
}

/// @p depth below the place at @p angle.
Vec3 below(Shape shape, double angle, double depth)
{
  const Vec3 on = closestPoint(shape, place(shape, angle)).point;
  return on - depth * normalAt(shape, on);
}

double slideDepth(Shape shape, double angle)
{
  return shape == Shape::Sheet ? 4e-4 - 3e-4 * std::cos(3.0 * angle)
                               : 1.8e-3 - 1.2e-3 * std::cos(3.0 * angle);
}

void append(std::vector<Vec3>& path, const Vec3& from, const Vec3& to, double speed)
{
  const int ticks = std::max(1, int(std::ceil(norm(to - from) / (speed * kTickSeconds))));
  for (int i = 0; i < ticks; ++i)
  {
    path.push_back(from + (double(i) / ticks) * (to - from));
  }
}

/// The angles of equal steps along the closed curve at @p speed; the last tick joins the first.
std::vector<double> evenAngles(const Curve& curve, double speed)
{
  std::vector<double> length(kCurveSamples + 1, 0.0);
  for (int i = 1; i <= kCurveSamples; ++i)
  {
    length[std::size_t(i)] = length[std::size_t(i) - 1] +
      norm(curve(kTwoPi * i / kCurveSamples) - curve(kTwoPi * (i - 1) / kCurveSamples));
  }
  const int ticks = std::max(8, int(std::ceil(length.back() / (speed * kTickSeconds))));
  std::vector<double> angles;
  std::size_t at = 1;
  for (int i = 0; i < ticks; ++i)
  {
    const double wanted = length.back() * i / ticks;
    while (length[at] < wanted)
    {
      ++at;
    }
    const double part = (wanted - length[at - 1]) / (length[at] - length[at - 1]);
    angles.push_back(kTwoPi * (double(at - 1) + part) / kCurveSamples);
  }
  return angles;
}

} // namespace

ExactContact exactContact(Shape shape, const Vec3& hip, double stiffness)
{
  SurfacePoint foot = closestPoint(shape, hip);
  if (shape == Shape::Sheet)
  {
    // The hand came from the upper one of its two sides.
    foot.point = { hip.x, hip.y, kSheetTop };
    foot.normal = { 0.0, 0.0, 1.0 };
    foot.distance = hip.z - kSheetTop;
  }
  const double depth = -foot.distance;
  return { depth > 0.0 ? stiffness * (foot.point - hip) : Vec3(), foot.normal, depth };
}

Course slideCourse(Shape shape)
{
  const Curve curve = [shape](double angle) { return below(shape, angle, slideDepth(shape, angle)); };
  Course course;
  append(course.hip, below(shape, 0.0, -0.003), curve(0.0), kHandSpeed);
  const std::vector<double> angles = evenAngles(curve, kHandSpeed);
  for (int turn = 0; turn < 2; ++turn)
  {
    course.loopBegin = course.hip.size();
    std::transform(angles.begin(), angles.end(), std::back_inserter(course.hip), curve);
  }
  course.loopTicks = angles.size();
  course.hip.push_back(curve(0.0));
  return course;
}

Course frictionCourse(Shape shape, double speed, double travel)
{
  constexpr double kDepth = 1e-3;
  Course course;
  const Vec3 start = below(shape, 0.5, kDepth);
  append(course.hip, start + 0.004 * normalAt(shape, start), start, 0.025);
  Vec3 at = start;
  Vec3 heading = anyPerpendicular(normalAt(shape, closestPoint(shape, at).point));
  const int ticks = int(travel / (speed * kTickSeconds));
  for (int i = 0; i < ticks; ++i)
  {
    course.hip.push_back(at);
    const Vec3 n = closestPoint(shape, at).normal;
    heading = normalized(heading - dot(heading, n) * n);
    const SurfacePoint foot = closestPoint(shape, at + (speed * kTickSeconds) * heading);
    at = foot.point - kDepth * foot.normal;
  }
  return course;
}

} // namespace pointhaptics::bench::proxy
