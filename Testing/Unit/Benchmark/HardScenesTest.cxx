/// The scenes and figures of the study "hard", by methods whose behaviour is known.
#include "Benchmark/Touch/Hard/HandInTheLoop.h"
#include "Benchmark/Touch/Hard/HardFigures.h"
#include "Benchmark/Touch/Studies.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace
{

using namespace pointhaptics;
using namespace pointhaptics::bench::touch;
using namespace pointhaptics::bench::touch::hard;

constexpr double kSpring = 800.0;

TouchBenchmarkOptions quickOptions(const std::string& family, StrokeSet set = StrokeSet::A)
{
  TouchBenchmarkOptions options;
  options.makeQuick();
  options.families = { family };
  options.strokeSet = set;
  return options;
}

HardScene firstOf(const std::string& family, StrokeSet set = StrokeSet::A)
{
  const TouchBenchmarkOptions options = quickOptions(family, set);
  return hardScenes(options).front().make();
}

using Contact = std::function<Vec3(const Vec3& hip, std::size_t tick, const TouchTruth& truth)>;

/// Figures of a hand whose contact point is what @p contact says.
HardFigures figuresOf(const HardScene& scene, const Contact& contact)
{
  const CloudDistance distance(scene.points);
  const std::vector<TouchTruth> truths = hardTruths(scene, kSpring);
  HardJudge judge(scene, distance, kSpring);
  for (std::size_t i = 0; i < scene.strokes.size(); ++i)
  {
    const TouchTruth none;
    const TouchTruth& truth = truths.empty() ? none : truths[i];
    TouchTrace trace;
    for (std::size_t tick = 0; tick < scene.strokes[i].hip.size(); ++tick)
    {
      ProxyState state;
      state.hip = scene.strokes[i].hip[tick];
      state.proxy = contact(state.hip, tick, truth);
      state.force = kSpring * (state.proxy - state.hip);
      state.contact = norm(state.force) > 0.0;
      trace.states.push_back(state);
      trace.microseconds.push_back(1.0);
    }
    judge.add(trace, truths.empty() ? nullptr : &truth);
  }
  return judge.figures();
}

Vec3 asTheTruth(const Vec3& hip, std::size_t tick, const TouchTruth& truth)
{
  return truth.ticks[tick].free ? hip : hip + truth.ticks[tick].force / kSpring;
}

TEST(HardScenes, TheTruthItselfPasses)
{
  for (const char* family : { "rim", "steps", "leaves" })
  {
    const HardFigures figures = figuresOf(firstOf(family), asTheTruth);
    EXPECT_EQ(figures.strokes, 8) << family;
    EXPECT_EQ(figures.held, 0) << family;
    EXPECT_EQ(figures.fellThrough, 0) << family;
    EXPECT_EQ(figures.phantomPercent, 0.0) << family;
    EXPECT_EQ(figures.lostPercent, 0.0) << family;
    EXPECT_LT(figures.energyJoule, 1e-4) << family;
    // Contact points of forces that were cut are off the surface.
    EXPECT_TRUE(figures.contactSpacings < 5.0 || figures.largestNewton >= kForceLimit) << family;
  }
}

TEST(HardScenes, AHandThatIsNeverLetGoIsHeld)
{
  // With a truth that is free at the end, and without one.
  for (const char* family : { "steps", "grid" })
  {
    Vec3 first;
    const HardFigures figures = figuresOf(firstOf(family),
      [&](const Vec3& hip, std::size_t tick, const TouchTruth&)
      {
        first = tick == 0 ? hip - Vec3(0.0, 0.0, 1e-3) : first;
        return first;
      });
    EXPECT_EQ(figures.held, figures.strokes) << family;
    EXPECT_EQ(figures.notLetGo, family == std::string("grid") ? figures.strokes : 0) << family;
    EXPECT_GT(figures.largestNewton, 8.0) << family;
  }
}

TEST(HardScenes, AHandThatFeelsNothingFallsThrough)
{
  const HardFigures figures =
    figuresOf(firstOf("steps"), [](const Vec3& hip, std::size_t, const TouchTruth&) { return hip; });
  EXPECT_EQ(figures.fellThrough, figures.strokes);
  EXPECT_EQ(figures.lostPercent, 100.0);
  EXPECT_EQ(figures.held, 0);
  EXPECT_EQ(figures.energyJoule, 0.0);
}

TEST(HardScenes, AForceThatLagsGivesEnergyOnAClosedPath)
{
  const HardScene fog = firstOf("fog");
  EXPECT_TRUE(std::all_of(fog.strokes.begin(), fog.strokes.end(),
    [](const TouchStroke& stroke) { return stroke.hip.front() == stroke.hip.back(); }));
  Vec3 last;
  const HardFigures figures = figuresOf(fog,
    [&](const Vec3& hip, std::size_t tick, const TouchTruth&)
    {
      // Pushes along the way of the hand.
      const Vec3 way = tick == 0 ? Vec3() : hip - last;
      last = hip;
      return hip + way;
    });
  EXPECT_GT(figures.energyJoule, 1e-5);
}

TEST(HardScenes, SetsOfStrokesShareTheCloudAndNoPlace)
{
  const HardScene a = firstOf("steps");
  const HardScene b = firstOf("steps", StrokeSet::B);
  EXPECT_EQ(a.name, "steps 1:8, noise 0.3");
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.points, firstOf("steps").points);
  ASSERT_EQ(a.strokes.size(), b.strokes.size());
  for (std::size_t i = 0; i < a.strokes.size(); ++i)
  {
    EXPECT_NE(a.strokes[i].hip.front(), b.strokes[i].hip.front());
  }
}

TEST(HardScenes, EachFamilyHasAScene)
{
  for (const std::string& family : hardFamilies())
  {
    const TouchBenchmarkOptions options = quickOptions(family);
    EXPECT_EQ(hardScenes(options).empty(), family == "scan") << family << ": scans come from files";
  }
}

TEST(HandInTheLoop, RestsOnAPlaneAndTremblesWhereAForceOscillates)
{
  const TouchPlace place{ {}, { 0.0, 0.0, 1.0 } };
  const LoopHand hand{ 0.1, 300.0, 0.4, 2.5, 800.0, 1 };
  const LoopFigures plane = runOnPlane(hand, place);
  EXPECT_LT(plane.oscillation, 1e-6);
  EXPECT_LT(plane.energyJoule, 1e-4);
  int tick = 0;
  const LoopFigures pushed =
    runLoop(hand, place, [&](const Vec3&) { return Vec3(++tick % 40 < 20 ? 0.5 : -0.5, 0.0, 0.0); });
  EXPECT_GT(pushed.oscillation, 10e-6);
  EXPECT_GT(pushed.energyJoule, 1e-4);
}

} // namespace
