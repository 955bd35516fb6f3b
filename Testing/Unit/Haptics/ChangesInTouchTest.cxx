#include "HapticFixtures.h"

#include "Shapes/Shapes.h"

#include <algorithm>

using namespace pointhaptics;

namespace
{

constexpr double kSide = 0.025; // of the box from its middle

/// A cloud and a hand's way to where it rests on it.
struct Place
{
  const char* name;
  HapticSceneInput input; ///< Input with the cloud as it is.
  std::vector<Vec3> points;
  Vec3 above;
  Vec3 hip;
  bool isFlat = false;
  bool isEdge = false;
};

trial::Scene limited(HapticSceneInput input, double minimumRadius, double maximumRadius)
{
  LocalBandwidthSettings bandwidth;
  bandwidth.minimumRadius = minimumRadius;
  bandwidth.maximumRadius = maximumRadius;
  input.bandwidth = bandwidth;
  return trial::sceneOf(std::move(input));
}

HapticSceneInput rawInput(const std::vector<Vec3>& points)
{
  HapticSceneInput input;
  input.points = points;
  return input;
}

std::vector<Vec3> boxPoints()
{
  std::vector<Vec3> points;
  EXPECT_EQ(generateShape(Shape::Box, trial::kPaperSmall, 3, 0.0, points), Status::Ok);
  return points;
}

/// The bare vertices of folds, as far apart as those are deep.
std::vector<Vec3> folds(double spacing, double slope)
{
  trial::Random random(5);
  std::vector<Vec3> points;
  for (int i = 0; i < 1600; ++i)
  {
    const double x = spacing * (i % 40 - 20 + 0.4 * random.uniform(-1, 1));
    const double y = spacing * (i / 40 - 20 + 0.4 * random.uniform(-1, 1));
    points.emplace_back(x, y, slope * std::abs(std::remainder(x, 8 * spacing)));
  }
  return points;
}

std::vector<Place> places()
{
  const std::vector<Vec3> plane = trial::planePoints(60000, 21);
  const std::vector<Vec3> box = boxPoints();
  const std::vector<Vec3> bare = folds(1e-3, 0.5);
  return { { "plane", trial::resampledInput(plane), plane, { -0.0206, 0.001, 0.002 },
             { -0.0197, 0.001, -0.001 }, true },
    { "edge", trial::resampledInput(box), box, { kSide - 5e-4, 0.001, kSide + 0.002 },
      { kSide - 3e-4, 0.002, kSide - 8e-4 }, false, true },
    { "bare", rawInput(bare), {}, { -0.003, 0.002, 0.004 }, { 0.002, 0.001, 0.0 } } };
}

/// The other scenes of a place: other limits of the radius, finer and coarser cells, and the model moved.
std::vector<std::pair<const char*, trial::Scene>> changesOf(const Place& place, const trial::Scene& scene)
{
  std::vector<std::pair<const char*, trial::Scene>> changes{ { "larger", limited(place.input, 3e-3, 0.0) } };
  if (!place.points.empty())
  {
    changes.emplace_back("smaller", limited(place.input, 0.0, 3e-4));
    changes.emplace_back("finer", trial::resampledScene(place.points, {}, trial::kVoxel / 2));
    changes.emplace_back("coarser", trial::resampledScene(place.points, {}, trial::kVoxel * 2));
  }
  const AffineTransform there = AffineTransform::translation(place.hip);
  const AffineTransform back = AffineTransform::translation(-place.hip);
  Status status = Status::Ok;
  changes.emplace_back(
    "zoomed", scene->moved(there * AffineTransform::scaling({ 1.03, 1.03, 1.03 }) * back, status));
  changes.emplace_back(
    "turned", scene->moved(there * AffineTransform::rotation(3.0, { 0.2, 0, 1 }) * back, status));
  changes.emplace_back("shifted", scene->moved(AffineTransform::translation({ 2e-4, 1e-4, 3e-4 }), status));
  return changes;
}

HapticParameters parametersOf(ProxyMethod method, double friction)
{
  HapticParameters parameters;
  parameters.method = method;
  parameters.contact.staticFriction = friction;
  parameters.contact.dynamicFriction = 0.75 * friction;
  return parameters;
}

class ChangesInTouch : public ::testing::TestWithParam<ProxyMethod>
{
};

} // namespace

TEST_P(ChangesInTouch, OfScenesAndRadiusLimitsUnderARestingHandDoNotKick)
{
  for (const Place& place : places())
  {
    if (GetParam() == ProxyMethod::GradientSteps && place.isEdge)
    {
      continue; // its sphere goes around the edge by itself, some ticks later
    }
    const trial::Scene scene = trial::sceneOf(place.input);
    const auto changes = changesOf(place, scene);
    for (const double friction : { 0.0, 0.4 })
    {
      const HapticParameters parameters = parametersOf(GetParam(), friction);
      // GradientSteps goes on by itself.
      const double itself = GetParam() == ProxyMethod::GradientSteps ? 0.01 : 1e-4;
      const double step = parameters.contact.settleRate * trial::kTick + itself;
      for (const auto& change : changes)
      {
        SCOPED_TRACE(std::string(place.name) + ' ' + change.first + ' ' + std::to_string(friction));
        Proxy proxy(parameters);
        proxy.setScene(scene.get());
        for (int i = 0; i < 150; ++i)
        {
          static_cast<void>(proxy.step(place.above + (i / 150.0) * (place.hip - place.above), trial::kTick));
        }
        const Vec3 before = trial::feel(proxy, trial::Path(100, place.hip)).back().force;
        ASSERT_GT(norm(before), 0.05);
        Vec3 last = before;
        for (const HapticScene* next : { scene.get(), change.second.get(), scene.get() })
        {
          proxy.setScene(next);
          for (int i = 0; i < 60; ++i)
          {
            const ProxyState state = proxy.step(place.hip, trial::kTick);
            ASSERT_TRUE(state.contact) << i;
            ASSERT_LE(norm(state.force - last), step) << i;
            last = state.force;
          }
        }
        if (GetParam() == ProxyMethod::SurfaceFit && place.isFlat)
        {
          EXPECT_LT(norm(last - before), 1e-3 * norm(before)) << "what sticks by friction goes on to stick";
          EXPECT_EQ(std::abs(last.x) > 0.1, friction > 0.0);
        }
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Proxy, ChangesInTouch,
  ::testing::Values(ProxyMethod::SurfaceFit, ProxyMethod::GradientSteps, ProxyMethod::Sphere),
  [](const ::testing::TestParamInfo<ProxyMethod>& method)
  {
    return method.param == ProxyMethod::SurfaceFit ? "SurfaceFit"
      : method.param == ProxyMethod::Sphere        ? "Sphere"
                                                   : "GradientSteps";
  });

// Past an edge and over folds, where the ball speaks in part of the ticks, while the model moves in each or
// the scene is exchanged in some.
TEST(ChangesInTouchOnTheWay, DoNotKickWhereTheBallSpeaks)
{
  const std::vector<Vec3> box = boxPoints();
  const std::vector<Vec3> bare = folds(5e-4, 1.2);
  const struct
  {
    trial::Scene scene;
    trial::Scene other;
    Vec3 from;
    Vec3 to;
    int leastBallTicks;
  } cases[] = { { trial::resampledScene(box), limited(trial::resampledInput(box), 2e-3, 0.0),
                  { kSide - 3e-3, 1e-3, kSide - 1.5e-3 }, { kSide + 3e-3, 2e-3, kSide - 1.5e-3 }, 15 },
    { trial::resampledScene(box), trial::resampledScene(box, {}, 2 * trial::kVoxel),
      { kSide - 3e-3, 1e-3, kSide - 1.5e-3 }, { kSide + 3e-3, 2e-3, kSide - 1.5e-3 }, 15 },
    { trial::sceneOf(rawInput(bare)), limited(rawInput(bare), 2e-3, 0.0), { -7e-3, 0, 0 }, { 7e-3, 1e-3, 0 },
      40 } };
  for (const auto& c : cases)
  {
    for (const double friction : { 0.0, 0.4 })
    {
      for (int kind = 0; kind < 4; ++kind)
      {
        Proxy proxy(parametersOf(ProxyMethod::SurfaceFit, friction));
        std::vector<trial::Scene> scenes{ c.scene };
        AffineTransform moved;
        ProxyState last;
        int ballTicks = 0;
        int contacts = 0;
        for (int tick = 0; tick < 500; ++tick)
        {
          SCOPED_TRACE(std::to_string(kind) + " tick " + std::to_string(tick));
          const double part = tick < 100 ? 0.0 : (tick - 100) / 400.0;
          const Vec3 hip = c.from + part * (c.to - c.from) + Vec3(0, 0, 4e-5 * std::max(0, 100 - tick));
          const double sign = tick / 40 % 2 ? 1.0 : -1.0;
          const AffineTransform changes[] = { AffineTransform::rotation(0.05 * sign, { 0.3, 0.5, 1 }),
            AffineTransform::scaling((1.0 + 1e-4 * sign) * Vec3(1, 1, 1)),
            AffineTransform::translation(2e-6 * sign * Vec3(1, 1, 1)) };
          Status status = Status::Ok;
          if (kind < 3 && tick > 100)
          {
            moved =
              AffineTransform::translation(hip) * changes[kind] * AffineTransform::translation(-hip) * moved;
            scenes.push_back(c.scene->moved(moved, status));
          }
          proxy.setScene(kind < 3 || tick / 11 % 2 == 0 ? scenes.back().get() : c.other.get());
          const ProxyState state = proxy.step(hip, trial::kTick);
          const double follows = 2.0 * 800.0 * norm(hip - last.hip) + 0.1 + 1e-8;
          ASSERT_TRUE(tick == 0 || !state.contact || norm(state.force - last.force) <= follows)
            << norm(state.force - last.force) - follows;
          ballTicks += (state.status & kProxyBallContact) != 0;
          contacts += state.contact;
          last = state;
        }
        EXPECT_GE(ballTicks, c.leastBallTicks) << kind;
        EXPECT_GT(contacts, 200) << kind;
      }
    }
  }
}

TEST(ChangesInTouchAtAnEdge, AHandStaysOnItsFaceWhereTheModelIsResampledElsewhere)
{
  const std::vector<Vec3> points = boxPoints();
  // By so much that no digit of a place is lost to speak of.
  const AffineTransform shift = AffineTransform::translation({ 0.03125, -0.0625, 0.015625 });
  const trial::Scene here = trial::resampledScene(points);
  const trial::Scene there = trial::resampledScene(points, shift);
  constexpr int kRuns = 60;
  for (const ProxyMethod method : { ProxyMethod::SurfaceFit, ProxyMethod::Sphere })
  {
    trial::Random random(3);
    int spoken = 0;
    int changed = 0;
    for (int run = 0; run < kRuns; ++run)
    {
      Proxy proxy(parametersOf(method, run % 2 == 0 ? 0.0 : 0.4));
      proxy.setScene(here.get());
      const Vec3 hip(kSide - random.uniform(1e-4, 8e-4), random.uniform(-5e-3, 5e-3),
        kSide - random.uniform(4e-4, 1.6e-3));
      const Vec3 beside(hip.x - 3e-3, hip.y, hip.z);
      for (int i = 0; i < 250; ++i)
      {
        const Vec3 press = beside + Vec3(0, 0, std::max(0, 100 - i) * 3e-5);
        static_cast<void>(proxy.step(press + (std::max(0, i - 100) / 150.0) * (hip - beside), trial::kTick));
      }
      const ProxyState before = trial::feel(proxy, trial::Path(50, hip)).back();
      proxy.setScene(there.get());
      const ProxyState after = trial::feel(proxy, trial::Path(60, shift.apply(hip))).back();
      spoken += (before.status & kProxyBallContact) != 0;
      changed += norm(after.force - before.force) > 0.2;
    }
    const bool isFit = method == ProxyMethod::SurfaceFit;
    EXPECT_TRUE(!isFit || spoken > kRuns / 5) << spoken;
    EXPECT_LE(trial::recorded(isFit ? "changedOfFit" : "changedOfSphere", changed), kRuns / 12);
  }
}

TEST(ChangesInTouchAtRest, ARestingHandFeelsTheNewScene)
{
  // Waves that coarse voxels blur.
  trial::Random random(7);
  std::vector<Vec3> points;
  for (int i = 0; i < 50000; ++i)
  {
    const Vec3 p = random.inBox({ -0.012, -0.012, 0 }, { 0.012, 0.012, 0 });
    const double phase = 2.0 * trial::kPi / 4e-3;
    points.emplace_back(p.x, p.y, 1e-4 * std::sin(phase * p.x) * std::sin(phase * p.y));
  }
  const trial::Scene coarse = trial::resampledScene(points, {}, 2 * trial::kVoxel);
  const trial::Scene fine = trial::resampledScene(points, {}, trial::kVoxel / 2);
  trial::Path path;
  for (int i = 0; i < 150; ++i)
  {
    path.emplace_back(1e-3, 1.1e-3, std::max(-5e-4, 5e-4 - 1e-5 * i));
  }
  Proxy proxy;
  proxy.setScene(coarse.get());
  const Vec3 blurred = trial::feel(proxy, path).back().force;
  const Vec3 expected = trial::feel(fine, {}, path).back().force;
  ASSERT_GT(norm(expected - blurred), 0.02);
  proxy.setScene(fine.get());
  const Vec3 felt = trial::feel(proxy, trial::Path(20, path.back())).back().force;
  EXPECT_LT(norm(felt - expected), 1e-5);
}
