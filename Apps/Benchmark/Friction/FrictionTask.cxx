/// Is the pull along the surface mu times the push across it, at every speed?
#include "Benchmark/Proxy/Course.h"
#include "Benchmark/Proxy/Scenes.h"
#include "Benchmark/Tasks.h"

#include "Haptics/Proxy.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pointhaptics::bench::friction
{
namespace
{

constexpr double kStatic = 0.4;
constexpr double kDynamic = 0.3;
constexpr double kTravel = 0.012;  ///< Metres of a slide.
constexpr double kSettled = 0.003; ///< Metres after which the hand slides.
/// Relative error of the ratio that no speed or shape may have.
constexpr double kSurelyWrong = 0.05;

struct Ratios
{
  double mean = 0.0;
  double rmsPercent = 0.0;
  double maximumPercent = 0.0;
  double peak = 0.0;
};

Ratios slide(const HapticScene& scene, const HapticParameters& parameters, Shape shape, double speed)
{
  Proxy felt(parameters);
  felt.setScene(&scene);
  const proxy::Course course = proxy::frictionCourse(shape, speed, kTravel);
  const std::size_t first = course.hip.size() - std::size_t(kTravel / (speed * proxy::kTickSeconds));
  const std::size_t settled = first + std::size_t(kSettled / (speed * proxy::kTickSeconds));
  Ratios ratios;
  double squares = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < course.hip.size(); ++i)
  {
    const ProxyState state = felt.step(course.hip[i], proxy::kTickSeconds);
    if (i < first)
    {
      continue;
    }
    const Vec3 normal = closestPoint(shape, state.proxy).normal;
    const double across = dot(state.force, normal);
    const double ratio = across > 0.0 ? norm(state.force - across * normal) / across : 0.0;
    ratios.peak = std::max(ratios.peak, ratio);
    if (i < settled)
    {
      continue;
    }
    const double error = ratio / kDynamic - 1.0;
    squares += error * error;
    ratios.mean += ratio;
    ratios.maximumPercent = std::max(ratios.maximumPercent, 100.0 * std::abs(error));
    ++count;
  }
  ratios.mean /= double(std::max<std::size_t>(1, count));
  ratios.rmsPercent = 100.0 * std::sqrt(squares / double(std::max<std::size_t>(1, count)));
  return ratios;
}

void measure(Run& run)
{
  const std::vector<Shape> all{ Shape::Plane, Shape::Sphere, Shape::Torus, Shape::Ellipsoid, Shape::Saddle };
  const std::vector<Shape> shapes(all.begin(), run.quick ? all.begin() + 2 : all.end());
  const std::vector<double> speeds =
    run.quick ? std::vector<double>{ 0.05 } : std::vector<double>{ 0.01, 0.05, 0.1 };
  for (const Shape shape : shapes)
  {
    run.say(shapeName(shape));
    const proxy::Scene scene = proxy::sceneOf(proxy::pointsOf(shape, run.quick ? 20000 : 543652, 0.0));
    for (const ProxyMethod method : { ProxyMethod::SurfaceFit, ProxyMethod::GradientSteps })
    {
      HapticParameters parameters;
      parameters.method = method;
      parameters.contact.staticFriction = kStatic;
      parameters.contact.dynamicFriction = kDynamic;
      const bool fits = method == ProxyMethod::SurfaceFit;
      for (const double speed : speeds)
      {
        const Ratios r = slide(*scene, parameters, shape, speed);
        run.add("ratio",
          { { "method", fits ? "surface-fit" : "gradient-steps, tuned" }, { "shape", shapeName(shape) },
            { "speed_metres_per_second", speed }, { "mean_ratio", r.mean },
            { "rms_error_percent", r.rmsPercent }, { "max_error_percent", r.maximumPercent },
            { "peak", r.peak } });
        if (fits && !(std::abs(r.mean / kDynamic - 1.0) < kSurelyWrong))
        {
          run.fault(
            fmt::format("surface-fit on the {} at {} m/s: ratio {:.4f}", shapeName(shape), speed, r.mean));
        }
      }
    }
  }
}

} // namespace
} // namespace pointhaptics::bench::friction

namespace pointhaptics::bench
{

Task frictionTask()
{
  return { "friction", "Compare the felt friction with mu at several speeds", 0, 0, false, { "ratio" }, {},
    [](CLI::App&) { return friction::measure; } };
}

} // namespace pointhaptics::bench
