#include "Benchmark/Friction/FrictionBenchmark.h"

#include "Benchmark/Proxy/Course.h"
#include "Benchmark/Proxy/Scenes.h"

#include "Haptics/Proxy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pointhaptics
{
namespace bench
{
namespace friction
{
namespace
{

constexpr double kStatic = 0.4;
constexpr double kDynamic = 0.3;
constexpr double kTravel = 0.012;
/// Of the way: by then it slides.
constexpr double kSettled = 0.003;
/// Relative error of the ratio that no speed or shape may have.
constexpr double kSurelyWrong = 0.05;

constexpr const char* kMethod = "A hand slides 12 mm along a surface at a constant depth of 1 mm; mu_s = "
                                "0.4, mu_d = 0.3. The force is split along "
                                "and across the exact surface's normal at the contact point: the ratio while "
                                "sliding should be mu_d, its peak before "
                                "at most mu_s. Errors in percent of mu_d over the last 9 mm.";

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

} // namespace

void FrictionBenchmarkOptions::makeQuick()
{
  points = 20000;
  speeds = { 0.050 };
  shapes = { Shape::Plane, Shape::Sphere };
}

Report benchmarkFriction(
  const FrictionBenchmarkOptions& options, const Progress& progress, std::string& wrong)
{
  Report report;
  report.task = "friction";
  report.title = "Friction";
  report.accuracyMethod = kMethod;
  report.machine = thisMachine();
  ReportPart part;
  part.key = "ratio";
  part.page = Page::Accuracy;
  part.title = "Ratio of the force along the surface to that across it";
  part.text = fmt::format("Clean clouds of {} points, voxels of 1/3 mm.", grouped(options.points));
  part.table.header = { "method", "shape", "speed mm/s", "mean ratio", "RMS error %", "max error %", "peak" };
  for (const Shape shape : options.shapes)
  {
    progress(shapeName(shape));
    const proxy::Scene scene = proxy::sceneOf(proxy::pointsOf(shape, options.points, 0.0));
    for (const ProxyMethod method : { ProxyMethod::SurfaceFit, ProxyMethod::GradientSteps })
    {
      HapticParameters parameters;
      parameters.method = method;
      parameters.contact.staticFriction = kStatic;
      parameters.contact.dynamicFriction = kDynamic;
      const bool fits = method == ProxyMethod::SurfaceFit;
      const std::string name = fits ? "surface-fit" : "gradient-steps, tuned";
      for (const double speed : options.speeds)
      {
        const Ratios r = slide(*scene, parameters, shape, speed);
        part.table.rows.push_back({ name, shapeName(shape), fmt::format("{:.0f}", 1e3 * speed),
          fmt::format("{:.5f}", r.mean), fmt::format("{:.4f}", r.rmsPercent),
          fmt::format("{:.4f}", r.maximumPercent), fmt::format("{:.4f}", r.peak) });
        part.rows.push_back(
          { { "method", name }, { "shape", shapeName(shape) }, { "speed_metres_per_second", speed },
            { "mean_ratio", r.mean }, { "rms_error_percent", r.rmsPercent },
            { "max_error_percent", r.maximumPercent }, { "peak", r.peak } });
        if (fits && !(std::abs(r.mean / kDynamic - 1.0) < kSurelyWrong))
        {
          wrong =
            fmt::format("surface-fit on the {} at {} m/s: ratio {:.4f}", shapeName(shape), speed, r.mean);
        }
      }
    }
  }
  report.parts.push_back(std::move(part));
  return report;
}

} // namespace friction
} // namespace bench
} // namespace pointhaptics
