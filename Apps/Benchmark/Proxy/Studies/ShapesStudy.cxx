/// How accurate is the default, on every shape, size and noise? And along other paths?
#include "Benchmark/Proxy/Studies/Studies.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace pointhaptics
{
namespace bench
{
namespace proxy
{
namespace
{

/// Percent of error no clean smooth shape may have, whatever the size; ten times what is measured.
constexpr double kSurelyWrong = 1.0;
constexpr int kCrossings = 21;
constexpr double kFastHand = 1.0;

double secondsNow()
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

ExactAnswer answerOf(Shape shape)
{
  return [shape](const Vec3& hip) { return exactContact(shape, hip, ContactParameters().stiffness); };
}

void judge(StudyContext& context, Shape shape, double noise, const TrialFigures& figures)
{
  if (noise == 0.0 && (figures.popThroughs > 0 || !(figures.rmsPercent < kSurelyWrong)))
  {
    context.wrong = fmt::format("surface-fit on the {}: {} pops, RMS error {:.3g} %", shapeName(shape),
      figures.popThroughs, figures.rmsPercent);
  }
}

/// Many crossings in one set of figures: the worst of each.
TrialFigures worstCrossing(const HapticScene& scene, Shape shape, int repetitions)
{
  TrialFigures worst;
  for (int start = 0; start < kCrossings; ++start)
  {
    const TrialFigures f =
      runTrial(scene, {}, crossCourse(shape, kFastHand, start), answerOf(shape), repetitions).figures;
    worst.rmsPercent = std::max(worst.rmsPercent, f.rmsPercent);
    worst.maximumPercent = std::max(worst.maximumPercent, f.maximumPercent);
    worst.directionRmsDegrees = std::max(worst.directionRmsDegrees, f.directionRmsDegrees);
    worst.directionMaximumDegrees = std::max(worst.directionMaximumDegrees, f.directionMaximumDegrees);
    worst.largestStep = std::max(worst.largestStep, f.largestStep);
    worst.popThroughs += f.popThroughs;
    worst.falseTicks += f.falseTicks;
    worst.contactTicks += f.contactTicks;
    worst.status |= f.status;
    worst.p50 = std::max(worst.p50, f.p50);
    worst.p99 = std::max(worst.p99, f.p99);
    worst.p999 = std::max(worst.p999, f.p999);
    worst.maximum = std::max(worst.maximum, f.maximum);
    worst.firstContact = std::max(worst.firstContact, f.firstContact);
  }
  return worst;
}

} // namespace

ReportPart studyShapes(StudyContext& context)
{
  ReportPart part;
  part.page = Page::Accuracy;
  part.title = "The default on every shape";
  part.text =
    "`surface-fit`, sliding along a closed way over the shape, 0.6 to 3 mm deep (0.1 to 0.7 mm in the sheet, "
    "which is 0.8 mm thick) at 47 mm/s.";
  setFigureHeader(part, { "shape", "points", "noise" });
  for (const Shape shape : context.options.shapes)
  {
    for (const std::int64_t points : context.options.points)
    {
      for (const double noise : context.options.noises)
      {
        context.progress(fmt::format("{}, {} points, {}", shapeName(shape), points, noiseName(noise)));
        const Scene scene = sceneOf(pointsOf(shape, points, noise));
        const TrialFigures figures =
          runTrial(*scene, {}, slideCourse(shape), answerOf(shape), context.options.repetitions).figures;
        judge(context, shape, noise, figures);
        addFigures(part, { shapeName(shape), grouped(points), noiseName(noise) },
          { { "shape", shapeName(shape) }, { "points", points }, { "noise_metres", noise } }, figures);
      }
    }
  }
  return part;
}

ReportPart studyPaths(StudyContext& context)
{
  ReportPart part;
  part.page = Page::Accuracy;
  part.title = "Pressing, circling, tapping, and crossing at 1 m/s";
  part.text = fmt::format(
    "`surface-fit` on clean clouds of {} points. Press: to 3 mm and out again at one place. Circle: "
    "radius 4 mm, 1 mm deep. Tap: ten times, 1.5 mm deep. Cross: {} times through the surface and back "
    "at 1 m/s, 1 mm a tick; the worst of each column, all pops and false ticks.",
    grouped(mostPoints(context)), kCrossings);
  setFigureHeader(part, { "shape", "path" });
  for (const Shape shape : context.options.shapes)
  {
    context.progress(fmt::format("paths on {}", shapeName(shape)));
    const Scene scene = sceneOf(pointsOf(shape, mostPoints(context), 0.0));
    const auto add = [&](const std::string& path, const TrialFigures& figures)
    {
      judge(context, shape, 0.0, figures);
      addFigures(
        part, { shapeName(shape), path }, { { "shape", shapeName(shape) }, { "path", path } }, figures);
    };
    for (const Course& course : { pressCourse(shape), circleCourse(shape), tapCourse(shape) })
    {
      add(course.name, runTrial(*scene, {}, course, answerOf(shape), context.options.repetitions).figures);
    }
    add("cross", worstCrossing(*scene, shape, context.options.repetitions));
  }
  return part;
}

ReportPart studySize(StudyContext& context)
{
  ReportPart part;
  part.title = "The update's time against the size of the cloud";
  part.text =
    "`surface-fit` on the clean sphere, the slide as above. Built: from points in memory to a scene that can "
    "be "
    "felt, resampling included, on one thread; the servo thread goes on with the old scene meanwhile. "
    "Finding: the longest "
    "update out of contact, the one that finds the surface among them.";
  part.table.header = { "points", "built s", "RMS %", "p50 us", "p99", "p99.9", "max us", "finding us" };
  for (const std::int64_t points : context.options.sizes)
  {
    context.progress(fmt::format("{} points", points));
    const std::vector<Vec3> cloud = pointsOf(Shape::Sphere, points, 0.0);
    const double before = secondsNow();
    const Scene scene = sceneOf(cloud);
    const double built = secondsNow() - before;
    const TrialFigures f =
      runTrial(*scene, {}, slideCourse(Shape::Sphere), answerOf(Shape::Sphere), context.options.repetitions)
        .figures;
    part.table.rows.push_back({ grouped(points), brief(built), fmt::format("{:.4f}", f.rmsPercent),
      brief(f.p50), brief(f.p99), brief(f.p999), brief(f.maximum), brief(f.firstContact) });
    part.rows.push_back({ { "points", points }, { "built_seconds", built }, { "rms_percent", f.rmsPercent },
      { "p50_us", f.p50 }, { "p99_us", f.p99 }, { "p999_us", f.p999 }, { "max_us", f.maximum },
      { "first_contact_us", f.firstContact } });
  }
  return part;
}

} // namespace proxy
} // namespace bench
} // namespace pointhaptics
