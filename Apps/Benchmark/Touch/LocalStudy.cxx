/// What do the finer scenes near the hand cost, and how much of its way does a hand feel without them?
#include "Benchmark/Touch/Methods/LateScenes.h"
#include "Benchmark/Touch/Studies.h"

#include "Benchmark/Harness/Statistics.h"

#include "SmpExecutor.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

namespace pointhaptics
{
namespace bench
{
namespace touch
{
namespace
{

/// Scenes of a mesh that are timed, spread over all.
constexpr std::size_t kMostTimed = 100;
/// The hand is as fast as the stroke says, and so many times faster.
constexpr std::array<int, 3> kFaster = { 1, 4, 10 };

struct LocalFigures
{
  std::vector<Bounds> hands; ///< Where scenes were made for the hand as fast as the stroke says.
  std::vector<double> cells; ///< How many each has.
  double finestCell = INFINITY;
  std::array<std::int64_t, kFaster.size()> ticks{};  ///< In contact, where a finer scene is of use.
  std::array<std::int64_t, kFaster.size()> coarse{}; ///< Those of them that felt none.
};

Bounds handAt(const Vec3& hip, const Vec3& touched)
{
  Bounds hand;
  hand.include(hip);
  hand.include(touched);
  return hand;
}

/// Where scenes are made on the way of a hand for which each is there in the tick that it is due.
void findHands(const TouchScene& scene, const TouchStroke& stroke, LocalFigures& figures)
{
  LocalSceneFollower follower(*scene.local, scene.scene);
  Proxy proxy;
  std::shared_ptr<const HapticScene> felt;
  ProxyState last;
  std::int64_t made = 0;
  for (const Vec3& hip : stroke.hip)
  {
    const Bounds hand = handAt(hip, last.contact ? last.proxy : hip);
    const bool changes = follower.update(hand, kTickSeconds);
    if (follower.numberOfScenes() > made)
    {
      made = follower.numberOfScenes();
      figures.hands.push_back(hand);
      figures.cells.push_back(double(follower.scene()->numberOfPoints()));
      figures.finestCell = std::min(figures.finestCell, follower.finestCell());
    }
    if (changes || !felt)
    {
      proxy.setScene(follower.scene().get());
      felt = follower.scene();
    }
    last = proxy.step(hip, kTickSeconds);
  }
}

/// The same hand, so many times as fast, for which scenes come late: how often it feels none that would be of
/// use. Left is a local scene where any of it is outside, until the next one comes (Proxy).
void countCoarse(const TouchScene& scene, const TouchStroke& stroke, std::size_t speed, LocalFigures& figures)
{
  LateScenes scenes(*scene.local, scene.scene, scene.lateTicks);
  Proxy proxy;
  const HapticScene* felt = nullptr;
  bool isFine = false;
  ProxyState last;
  for (std::size_t i = 0; i < stroke.hip.size(); i += std::size_t(kFaster[speed]))
  {
    const Vec3& hip = stroke.hip[i];
    const Vec3 touched = last.contact ? last.proxy : hip;
    const HapticScene* const next = scenes.at(hip, touched);
    if (next != felt)
    {
      isFine = next->isLocal() && (!felt || next->covers(last.hip));
      proxy.setScene(felt = next);
    }
    last = proxy.step(hip, kTickSeconds);
    isFine = isFine && felt->covers(hip) && felt->covers(last.proxy) && felt->covers(last.sphereCenter);
    if (last.contact && (isFine || scene.local->isUseful(handAt(hip, touched), *scene.scene)))
    {
      ++figures.ticks[speed];
      figures.coarse[speed] += !isFine;
    }
  }
}

/// Sorted milliseconds of the scenes, of each the fastest.
std::vector<double> timesOf(
  const TouchScene& scene, const std::vector<Bounds>& hands, int repetitions, const Executor& executor)
{
  std::vector<double> times;
  const std::size_t every = hands.size() / kMostTimed + 1;
  for (std::size_t i = 0; i < hands.size(); i += every)
  {
    double fastest = INFINITY;
    for (int repetition = 0; repetition < std::max(1, repetitions); ++repetition)
    {
      const auto before = std::chrono::steady_clock::now();
      static_cast<void>(scene.local->build(hands[i], scene.scene, executor));
      const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - before;
      fastest = std::min(fastest, took.count());
    }
    times.push_back(fastest);
  }
  std::sort(times.begin(), times.end());
  return times;
}

/// "12.3", or "-" where there is none.
std::string quantileText(const std::vector<double>& sorted, double p)
{
  return sorted.empty() ? "-" : fmt::format("{:.1f}", quantile(sorted, p));
}

double quantileOrZero(const std::vector<double>& sorted, double p)
{
  return sorted.empty() ? 0.0 : quantile(sorted, p);
}

void addRow(ReportPart& part, const std::string& mesh, const TouchBenchmarkOptions& options,
  LocalFigures figures, const std::vector<double>& alone, const std::vector<double>& together)
{
  std::sort(figures.cells.begin(), figures.cells.end());
  const double cells = quantileOrZero(figures.cells, 0.5);
  const double edge = figures.hands.empty() ? 0.0 : figures.finestCell;
  std::vector<std::string> texts = { mesh, grouped(options.points), fmt::format("{}", figures.hands.size()),
    grouped(std::int64_t(cells)), fmt::format("{:.0f}", 1e6 * edge), quantileText(alone, 0.5),
    quantileText(alone, 0.95), quantileText(alone, 1.0), quantileText(together, 0.5),
    quantileText(together, 0.95), quantileText(together, 1.0) };
  nlohmann::ordered_json row = { { "mesh", mesh }, { "points", options.points },
    { "scenes", figures.hands.size() }, { "cells_median", cells }, { "finest_cell_metres", edge },
    { "one_thread_p50_ms", quantileOrZero(alone, 0.5) }, { "one_thread_p95_ms", quantileOrZero(alone, 0.95) },
    { "one_thread_max_ms", quantileOrZero(alone, 1.0) }, { "p50_ms", quantileOrZero(together, 0.5) },
    { "p95_ms", quantileOrZero(together, 0.95) }, { "max_ms", quantileOrZero(together, 1.0) },
    { "late_ms", options.lateTicks } };
  for (std::size_t i = 0; i < kFaster.size(); ++i)
  {
    const double percent =
      figures.ticks[i] > 0 ? 100.0 * double(figures.coarse[i]) / double(figures.ticks[i]) : 0.0;
    texts.push_back(figures.ticks[i] > 0 ? brief(percent) : "-");
    row[fmt::format("coarse_percent_{}_times", kFaster[i])] = percent;
  }
  part.table.rows.push_back(std::move(texts));
  part.rows.push_back(std::move(row));
}

} // namespace

ReportPart studyLocal(StudyContext& context)
{
  const TouchBenchmarkOptions& options = context.options;
  ReportPart part;
  part.title = "Scenes near the hand";
  part.text = fmt::format(
    "What LocalSceneBuilder takes for a scene, on one thread and on all, milliseconds, of each scene the "
    "fastest of {} builds: where one is due on {} strokes on {} samples of each mesh (pressed to 1 mm, slid "
    "10 mm at 20 and 50 mm/s, lifted). Cells: median. Coarse: percent of the ticks in contact, of those "
    "where a finer scene is of use, that feel none, when each scene is felt {} ms after the look at the hand "
    "that it was made for; the hand as fast as said, and faster.",
    std::max(1, options.repetitions), options.strokes, grouped(options.points), options.lateTicks);
  part.table.header = { "mesh", "points", "scenes", "cells", "finest um", "one thread p50 ms", "p95", "max",
    "p50 ms", "p95", "max", "coarse % at 20-50 mm/s", "80-200", "200-500" };
  for (const TouchMesh& mesh : meshesOf(options))
  {
    const TriangleTree tree(mesh);
    const TouchScene scene = makeTouchScene(samplesToTouch(mesh, options.points), sceneSettings(options));
    if (tree.facets().empty() || !scene.scene || !scene.local)
    {
      part.remarks.push_back("Left out: " + mesh.name + " has no finer scenes");
      continue;
    }
    context.progress("scenes near the hand on " + mesh.name);
    LocalFigures figures;
    for (const TouchStroke& stroke : strokesOn(tree, options.strokes, options.strokeSet))
    {
      findHands(scene, stroke, figures);
      for (std::size_t speed = 0; speed < kFaster.size(); ++speed)
      {
        countCoarse(scene, stroke, speed, figures);
      }
    }
    const std::vector<double> alone = timesOf(scene, figures.hands, options.repetitions, Executor());
    const std::vector<double> together = timesOf(scene, figures.hands, options.repetitions, SmpExecutor());
    addRow(part, mesh.name, options, std::move(figures), alone, together);
  }
  return part;
}

} // namespace touch
} // namespace bench
} // namespace pointhaptics
