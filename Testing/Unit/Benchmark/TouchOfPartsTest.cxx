/// What a hand feels that slides over machined parts, beside the god object on their meshes.
#include "Benchmark/Touch/Studies.h"

#include <gtest/gtest.h>

namespace
{

using namespace pointhaptics;
using namespace pointhaptics::bench::touch;

TouchFigures figuresOf(const char* name, StrokeSet set, std::int64_t points)
{
  constexpr int kStrokes = 60;
  constexpr std::uint64_t kSeed = 28;
  TouchBenchmarkOptions options;
  options.repetitions = 1;
  const bench::Progress progress = [](const std::string&) {};
  StudyContext context{ options, progress, {} };
  const TouchMesh mesh = generatedMesh(name);
  const TriangleTree tree(mesh);
  const std::vector<TouchTask> tasks = tasksOn(tree, strokesOn(tree, kStrokes, set));
  const TouchScene scene = makeTouchScene(samplesOf(mesh, points, kSeed), {});
  return judge(context, contestantsNamed({ "surface-fit" }).front(), scene, tasks);
}

} // namespace

TEST(TouchOfParts, EndsInTheTickInWhichTheHandComesOutThroughAnotherFace)
{
  // Bumps between the points hold the ball back at an edge: 0.79, 0.80 and 0.72 N without looking for the
  // other face.
  const TouchFigures sparse = figuresOf("stairs", StrokeSet::A, 100000);
  EXPECT_LE(sparse.phantomNewton, 0.1);
  EXPECT_EQ(sparse.held, 0);
  EXPECT_LE(figuresOf("gear", StrokeSet::A, 543652).phantomNewton, 0.1);
  EXPECT_LE(figuresOf("stairs", StrokeSet::B, 100000).phantomNewton, 0.1);
}

TEST(TouchOfParts, DoesNotLetGoDeepInsideForATick)
{
  // A fit of another sheet, with the HIP in front of it, let go of 6 N: 5 ticks, 23 % RMS.
  const TouchFigures figures = figuresOf("stairs", StrokeSet::B, 543652);
  EXPECT_EQ(figures.lostPercent, 0.0);
  EXPECT_LE(figures.rmsPercent, 10.0);
  EXPECT_LE(figures.phantomNewton, 0.1);
}
