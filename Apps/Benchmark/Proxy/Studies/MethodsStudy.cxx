/// What does each method and setting cost, and how far off is it? And the paper's own figures again.
#include "Benchmark/Proxy/Studies/Studies.h"

#include <fmt/format.h>

#include <algorithm>

namespace pointhaptics
{
namespace bench
{
namespace proxy
{
namespace
{

struct Contestant
{
  std::string name;
  HapticParameters parameters;
  SceneSettings scene;
};

std::vector<Contestant> contestants()
{
  std::vector<Contestant> all;
  all.push_back({ "surface-fit (default)", {}, {} });
  all.push_back({ "surface-fit, plain means", {}, {} });
  all.back().scene.covariances = false;
  all.push_back({ "surface-fit, raw points", {}, {} });
  all.back().scene.raw = true;
  all.push_back({ "surface-fit, 2/3 mm voxels", {}, {} });
  all.back().scene.voxelSize = 2e-3 / 3.0;
  GradientStepsParameters few = GradientStepsParameters::tuned();
  few.maximumStepsPerTick = 4;
  all.push_back({ "gradient-steps, tuned", gradientSteps(GradientStepsParameters::tuned()), {} });
  all.push_back({ "gradient-steps, tuned, 4 steps", gradientSteps(few), {} });
  all.push_back({ "gradient-steps, paper", gradientSteps(GradientStepsParameters::paper()), {} });
  return all;
}

} // namespace

HapticParameters gradientSteps(const GradientStepsParameters& gains)
{
  HapticParameters parameters;
  parameters.method = ProxyMethod::GradientSteps;
  parameters.gradientSteps = gains;
  return parameters;
}

ExactAnswer scaledSphere(double scale)
{
  return [scale](const Vec3& hip)
  {
    ExactContact contact = exactContact(Shape::Sphere, hip / scale, ContactParameters().stiffness);
    contact.force *= scale;
    contact.depth *= scale;
    return contact;
  };
}

ReportPart studyMethods(StudyContext& context)
{
  ReportPart part;
  part.page = Page::Accuracy;
  part.title = "Every method and setting";
  part.text =
    "The slide on the torus. `gradient-steps` is the paper's method: `tuned` with gains that follow a hand, "
    "`paper` with the printed ones, whose tangential gain is a time constant of 4 s.";
  setFigureHeader(part, { "method", "points", "noise" });
  for (const double noise : context.options.noises)
  {
    Chart chart;
    chart.fileName = fmt::format("proxy-time-error-{:.0f}um", 1e6 * noise);
    chart.title = fmt::format("Torus, {} points, {}", grouped(mostPoints(context)), noiseName(noise));
    chart.x = { "median update (us)" };
    chart.y = { "RMS force error (%)" };
    for (const Contestant& contestant : contestants())
    {
      for (const std::int64_t points : context.options.points)
      {
        context.progress(fmt::format("{}, {} points, {}", contestant.name, points, noiseName(noise)));
        const Scene scene = sceneOf(pointsOf(Shape::Torus, points, noise), contestant.scene);
        const auto exact = [](const Vec3& hip)
        { return exactContact(Shape::Torus, hip, ContactParameters().stiffness); };
        const TrialFigures figures = runTrial(
          *scene, contestant.parameters, slideCourse(Shape::Torus), exact, context.options.repetitions)
                                       .figures;
        addFigures(part, { contestant.name, grouped(points), noiseName(noise) },
          { { "method", contestant.name }, { "points", points }, { "noise_metres", noise } }, figures);
        if (points == mostPoints(context))
        {
          addPoint(chart.series, contestant.name, figures.p50, figures.rmsPercent);
        }
      }
    }
    part.charts.push_back(std::move(chart));
  }
  return part;
}

ReportPart studyValidation(StudyContext& context)
{
  ReportPart part;
  part.page = Page::Accuracy;
  part.title = "The paper's validation, redrawn";
  part.text = fmt::format(
    "A sphere of radius 0.025 m, and the same scaled to 0.04 m, {} points; force and proxy radius over "
    "time beside the ideal force. The paper reports 0.4 % of the ideal.",
    grouped(mostPoints(context)));
  setFigureHeader(part, { "radius", "method" });
  const std::vector<Vec3> points = pointsOf(Shape::Sphere, mostPoints(context), 0.0);
  Chart radii{ "proxy-validation-radius", "Proxy radius over time", { "time (s)", false },
    { "proxy radius (mm)", false }, {} };
  for (const double scale : { 1.0, 1.6 })
  {
    const std::string size = fmt::format("{:.3f} m", 0.025 * scale);
    context.progress("validation on the sphere of " + size);
    SceneSettings settings;
    settings.transform = AffineTransform::scaling({ scale, scale, scale });
    const Scene scene = sceneOf(points, settings);
    const Course course = slideCourse(Shape::Sphere, scale);
    Chart forces{ fmt::format("proxy-validation-force-{:.0f}mm", 25 * scale),
      "Force over time, sphere of radius " + size, { "time (s)", false }, { "force (N)", false }, {} };
    Chart errors{ fmt::format("proxy-validation-error-{:.0f}mm", 25 * scale),
      "Length of the force's error over time, sphere of radius " + size, { "time (s)", false },
      { "error (N)" }, {} };
    for (const bool paper : { true, false })
    {
      const HapticParameters parameters =
        paper ? gradientSteps(GradientStepsParameters::tuned()) : HapticParameters();
      const std::string name = paper ? "gradient-steps, tuned" : "surface-fit";
      const Trial trial =
        runTrial(*scene, parameters, course, scaledSphere(scale), context.options.repetitions);
      addFigures(
        part, { size, name }, { { "radius_metres", 0.025 * scale }, { "method", name } }, trial.figures);
      // A curve of a few hundred points shows all that a picture can.
      const std::size_t stride = std::max<std::size_t>(1, course.hip.size() / 400);
      for (std::size_t i = 0; i < course.hip.size(); i += stride)
      {
        const double time = double(i) * kTickSeconds;
        const Vec3 ideal = scaledSphere(scale)(course.hip[i]).force;
        addPoint(forces.series, name, time, norm(trial.states[i].force));
        addPoint(errors.series, name, time, norm(trial.states[i].force - ideal));
        if (paper)
        {
          addPoint(forces.series, "ideal", time, norm(ideal));
        }
        else
        {
          addPoint(radii.series, "sphere of " + size, time, 1e3 * trial.states[i].radius);
        }
      }
    }
    part.charts.push_back(std::move(forces));
    part.charts.push_back(std::move(errors));
  }
  part.charts.push_back(std::move(radii));
  return part;
}

} // namespace proxy
} // namespace bench
} // namespace pointhaptics
