#include "Benchmark/Proxy/Strokes.h"

#include "Benchmark/Proxy/Course.h"

#include "Core/Base/PortableRandom.h"
#include "Core/Surface/SurfaceFit.h"

#include <chrono>
#include <cmath>
#include <memory>

namespace pointhaptics
{
namespace bench
{
namespace proxy
{
namespace
{

constexpr std::uint64_t kPlaceSeed = 60;
constexpr double kStart = 3e-3;
constexpr double kDepth = 1e-3;
constexpr double kSpeed = 0.010;
/// Part of the missing depth a following hand makes up for in a tick, and how slowly it turns.
constexpr double kDepthGain = 0.02;
constexpr double kTurnGain = 0.03;
/// Places tried for one that can be reached.
constexpr int kMostTries = 100;

/// Nothing but the place itself is near the way from outside.
bool isReachable(const HapticScene& scene, const Vec3& place, const Vec3& normal)
{
  double distance = 0.0;
  for (double height = 1.5e-3; height <= 4e-3; height += 0.5e-3)
  {
    if (scene.pyramid().nearest(0, place + height * normal, height - 0.8e-3, distance) >= 0)
    {
      return false;
    }
  }
  return true;
}

} // namespace

std::vector<Stroke> strokesOn(const HapticScene& scene, int count)
{
  const std::vector<Cell>& cells = scene.pyramid().level(0).cells;
  const Vec3 middle = 0.5 * (scene.bounds().minimum + scene.bounds().maximum);
  detail::PortableRandom random(kPlaceSeed);
  const auto memory = std::make_unique<FitCells>();
  std::vector<Stroke> strokes;
  for (int tries = 0; int(strokes.size()) < count && tries < kMostTries * count; ++tries)
  {
    Stroke stroke;
    stroke.place = cells[std::size_t(random.uniform() * double(cells.size()))].mean;
    const double angle = 6.283185307179586 * random.uniform();
    if (!principalNormal(
          scene.pyramid(), stroke.place, scene.fitRadius(stroke.place), *memory, stroke.normal))
    {
      continue;
    }
    stroke.normal = dot(stroke.normal, stroke.place - middle) < 0.0 ? -stroke.normal : stroke.normal;
    const Vec3 a = anyPerpendicular(stroke.normal);
    stroke.tangent = std::cos(angle) * a + std::sin(angle) * cross(stroke.normal, a);
    if (isReachable(scene, stroke.place, stroke.normal))
    {
      strokes.push_back(stroke);
    }
  }
  return strokes;
}

StrokeTrace feelStroke(const HapticScene& scene, const Stroke& stroke, bool following, InstructionSet wanted)
{
  Proxy proxy({}, wanted);
  proxy.setScene(&scene);
  StrokeTrace trace;
  Vec3 hip = stroke.place + kStart * stroke.normal;
  Vec3 up = stroke.normal;
  for (int tick = 0; tick < kStrokeTicks; ++tick)
  {
    if (tick < kPressTicks)
    {
      hip -= ((kStart + kDepth) / kPressTicks) * stroke.normal;
    }
    else
    {
      const Vec3 along = stroke.tangent - dot(stroke.tangent, up) * up;
      hip += (kSpeed * kTickSeconds) * (following ? normalized(along, stroke.tangent) : stroke.tangent);
      const ProxyState& last = trace.states.back();
      if (following && last.contact)
      {
        hip -= kDepthGain * (kDepth - norm(last.proxy - hip)) * up;
        up = normalized((1.0 - kTurnGain) * up + kTurnGain * last.normal, up);
      }
    }
    const auto before = std::chrono::steady_clock::now();
    trace.states.push_back(proxy.step(hip, kTickSeconds));
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - before;
    trace.microseconds.push_back(took.count());
  }
  return trace;
}

} // namespace proxy
} // namespace bench
} // namespace pointhaptics
