#include "HapticFixtures.h"

#include <algorithm>

using namespace pointhaptics;

namespace
{

/// Tests that hold for every method.
class EveryMethod : public ::testing::TestWithParam<ProxyMethod>
{
protected:
  HapticParameters parameters() const
  {
    HapticParameters p;
    p.method = GetParam();
    return p;
  }
};

/// A hand that presses through the origin from three sides, slowly and fast, and comes to rest on it.
trial::Path probing(double reach)
{
  trial::Path path;
  for (const Vec3& from : { Vec3(0, 0, 1), Vec3(1, 0.5, 0.2), Vec3(-1, 0, 0) })
  {
    for (int i = 0; i <= 60; ++i)
    {
      path.push_back(reach * (1 - i / 30.0) * from);
    }
    for (int i = 0; i <= 4; ++i)
    {
      path.push_back(reach * (1 - i / 2.0) * from);
    }
    path.insert(path.end(), 20, Vec3(0, 0, 0));
  }
  return path;
}

void expectFinite(const std::vector<ProxyState>& states, double largestForce)
{
  for (std::size_t i = 0; i < states.size(); ++i)
  {
    ASSERT_TRUE(trial::isFinite(states[i])) << "tick " << i;
    ASSERT_LE(norm(states[i].force), largestForce) << "tick " << i;
    ASSERT_NEAR(norm(states[i].normal), 1.0, 1e-6) << "tick " << i;
  }
}

} // namespace

TEST_P(EveryMethod, EqualsTheHandInFreeSpace)
{
  const trial::Scene scene = trial::resampledScene(trial::spherePoints(20000, 1));
  trial::Random random(2);
  trial::Path path;
  for (int i = 0; i < 300; ++i)
  {
    path.push_back((0.04 + 1e-4 * i) * normalized({ std::cos(0.01 * i), std::sin(0.01 * i), 0.5 }));
  }
  for (const ProxyState& s : trial::feel(scene, parameters(), path))
  {
    ASSERT_EQ(s.proxy, s.hip);
    // The sphere of GradientSteps is drawn where it is: its last step to the HIP may be missing.
    ASSERT_LE(norm(s.sphereCenter - s.hip), GetParam() == ProxyMethod::SurfaceFit ? 0.0 : 1e-3 * s.radius);
    ASSERT_EQ(s.force, Vec3());
    ASSERT_FALSE(s.contact);
    ASSERT_EQ(s.status, std::uint32_t(kProxyOk));
    ASSERT_GT(s.radius, 0.0);
  }
}

TEST_P(EveryMethod, WithoutASceneIsFreeAndSaysSo)
{
  Proxy proxy(parameters());
  const ProxyState s = proxy.step({ 1, 2, 3 }, trial::kTick);
  EXPECT_TRUE(s.status & kProxyNoScene);
  EXPECT_FALSE(s.contact);
  EXPECT_EQ(s.force, Vec3());
  EXPECT_EQ(s.proxy, Vec3(1, 2, 3));
}

TEST_P(EveryMethod, SurvivesSmallAndDegenerateClouds)
{
  std::vector<Vec3> line;
  std::vector<Vec3> cross;
  for (int i = -50; i <= 50; ++i)
  {
    line.emplace_back(1e-4 * i, 0, 0);
    cross.emplace_back(1e-4 * i, 0, 0);
    cross.emplace_back(0, 1e-4 * i, 0);
  }
  const std::vector<std::vector<Vec3>> clouds{ { { 0, 0, 0 } }, { { 0, 0, 0 }, { 1e-3, 0, 0 } },
    trial::randomBox(11, 3, { -2e-3, -2e-3, -1e-4 }, { 2e-3, 2e-3, 1e-4 }), std::vector<Vec3>(300, Vec3()),
    line, cross };
  for (std::size_t c = 0; c < clouds.size(); ++c)
  {
    SCOPED_TRACE(c);
    const trial::Scene scene = trial::rawScene(clouds[c]);
    ASSERT_NE(scene, nullptr);
    expectFinite(trial::feel(scene, parameters(), probing(5e-3)), 800.0 * 0.05);
  }
}

TEST_P(EveryMethod, SurvivesAHandExactlyOnPointsAndVoxelCorners)
{
  std::vector<Vec3> grid;
  for (int i = 0; i < 60 * 60; ++i)
  {
    grid.emplace_back(1e-3 * (i % 60 - 30), 1e-3 * (i / 60 - 30), 0);
  }
  HapticSceneInput input;
  input.points = grid;
  input.cellSize = 1e-3;
  const trial::Scene scene = trial::sceneOf(std::move(input));
  trial::Path path;
  for (int i = 0; i < 40; ++i)
  {
    path.emplace_back(0, 0, std::max(0.0, 2e-3 - 1e-4 * i));
  }
  for (int i = 0; i < 20; ++i)
  {
    path.emplace_back(1e-3 * i, 0, 0);
  }
  expectFinite(trial::feel(scene, parameters(), path), 2.0);
}

TEST_P(EveryMethod, IsTheSameBitForBitWhenRepeated)
{
  const std::vector<Vec3> points = trial::spherePoints(50000, 4, 20e-6);
  const trial::Scene one = trial::resampledScene(points);
  const trial::Scene two = trial::resampledScene(points);
  const trial::Path path = trial::sphereSlide(1e-3, 0.05, 500);
  const auto first = trial::feel(one, parameters(), path);
  const auto second = trial::feel(two, parameters(), path);
  Proxy used(parameters());
  used.setScene(one.get());
  trial::feel(used, probing(0.03));
  used.reset();
  const auto third = trial::feel(used, path);
  for (std::size_t i = 0; i < path.size(); ++i)
  {
    ASSERT_TRUE(trial::operator==(first[i], second[i])) << "tick " << i;
    ASSERT_TRUE(trial::operator==(first[i], third[i])) << "tick " << i << " after reset()";
  }
}

TEST_P(EveryMethod, FeelsTheSameBitForBitWhetherStepsArePrefetchedOrNot)
{
  const trial::Scene scenes[] = { trial::resampledScene(trial::spherePoints(50000, 4, 20e-6)),
    trial::resampledScene(trial::spherePoints(80000, 5, 20e-6)) };
  trial::Path path = probing(0.03);
  const trial::Path slide = trial::sphereSlide(1e-3, 0.05, 300);
  path.insert(path.end(), slide.begin(), slide.end());
  path.insert(
    path.end(), { Vec3(NAN, 0, 0), Vec3(1e308, 0, 0), Vec3(-1e308, 0, 0), slide.back(), Vec3(0, 0, 1) });
  HapticParameters unlimited = parameters();
  unlimited.contact.forceLimit = INFINITY;
  Proxy plain(unlimited);
  Proxy prefetched(unlimited);
  prefetched.prefetch(); // without a scene
  int contacts = 0;
  for (std::size_t i = 0; i < path.size(); ++i)
  {
    if (i % 40 == 0)
    {
      plain.setScene(scenes[i / 40 % 2].get());
      prefetched.setScene(scenes[i / 40 % 2].get());
    }
    for (std::size_t k = 0; k < i % 3; ++k)
    {
      prefetched.prefetch();
    }
    const ProxyState expected = plain.step(path[i], trial::kTick);
    ASSERT_TRUE(trial::operator==(prefetched.step(path[i], trial::kTick), expected)) << "tick " << i;
    contacts += expected.contact ? 1 : 0;
  }
  EXPECT_GT(contacts, 300);
}

TEST_P(EveryMethod, LeavesNoForceBehindWhenTheHandComesOut)
{
  const trial::Scene scene = trial::resampledScene(trial::spherePoints(100000, 5));
  trial::Path path = trial::sphereSlide(1e-3, 0.05, 200);
  const Vec3 out = normalized(path.back());
  for (int i = 0; i < 100; ++i)
  {
    path.push_back((0.024 + 2e-4 * i) * out);
  }
  const auto states = trial::feel(scene, parameters(), path);
  EXPECT_EQ(states.back().force, Vec3());
  EXPECT_FALSE(states.back().contact);
  EXPECT_EQ(states.back().proxy, states.back().hip);
}

TEST_P(EveryMethod, StaysFiniteWhileTheHandIsNotANumberAndRecovers)
{
  const trial::Scene scene = trial::resampledScene(trial::spherePoints(50000, 6));
  Proxy proxy(parameters());
  proxy.setScene(scene.get());
  // Not a number on the very first tick, too.
  EXPECT_TRUE(trial::isFinite(proxy.step({ NAN, NAN, NAN }, trial::kTick)));
  trial::feel(proxy, trial::sphereSlide(1e-3, 0.05, 100));
  for (int i = 0; i < 12; ++i)
  {
    const ProxyState s = proxy.step({ 0, INFINITY, 0 }, trial::kTick);
    ASSERT_TRUE(trial::isFinite(s));
    ASSERT_TRUE(s.status & kProxyNonFiniteInput);
    ASSERT_LE(norm(s.force), 1.6);
  }
  EXPECT_EQ(proxy.step({ NAN, 0, 0 }, trial::kTick).force, Vec3());
  const ProxyState away = trial::feel(proxy, trial::Path(200, Vec3(0.05, 0.05, 0.05))).back();
  EXPECT_EQ(away.proxy, away.hip);
}

TEST_P(EveryMethod, SurvivesEverySwapOfItsSceneInContact)
{
  const std::vector<Vec3> points = trial::spherePoints(50000, 7);
  const trial::Scene original = trial::resampledScene(points);
  for (const double zoom : { 1e-3, 0.5, 1000.0 })
  {
    const AffineTransform transform =
      AffineTransform::rotation(20, { 1, 1, 0 }) * AffineTransform::scaling({ zoom, zoom, zoom });
    const trial::Scene zoomed =
      trial::resampledScene(points, transform, std::max(zoom, 1e-2) * trial::kVoxel);
    Proxy proxy(parameters());
    proxy.setScene(original.get());
    trial::feel(proxy, trial::sphereSlide(1e-3, 0.05, 100));
    proxy.setScene(zoomed.get());
    expectFinite(trial::feel(proxy, trial::Path(50, Vec3(0.02, 0.01, 0.005))), 800.0 * 30.0);
    proxy.setScene(nullptr);
    // It fades.
    const ProxyState none = trial::feel(proxy, trial::Path(12, Vec3(0.02, 0.01, 0.005))).back();
    EXPECT_EQ(none.force, Vec3());
    EXPECT_FALSE(none.contact);
    proxy.setScene(original.get());
    expectFinite(trial::feel(proxy, trial::sphereSlide(1e-3, 0.05, 100)), 100.0);
  }
}

TEST_P(EveryMethod, SurvivesTeleports)
{
  const trial::Scene scene = trial::resampledScene(trial::spherePoints(50000, 8));
  trial::Random random(9);
  trial::Path path;
  for (int i = 0; i < 400; ++i)
  {
    path.insert(path.end(), 1 + random.below(4), random.inBox({ -0.04, -0.04, -0.04 }, { 0.04, 0.04, 0.04 }));
  }
  path.push_back({ 1e6, -1e6, 1e6 });
  path.push_back({ 0, 0, 0 });
  path.push_back({ 1e300, 0, 0 });
  path.push_back({ 0.06, 0, 0 });
  const auto states = trial::feel(scene, parameters(), path);
  for (std::size_t i = 0; i < states.size(); ++i)
  {
    ASSERT_TRUE(trial::isFinite(states[i])) << "tick " << i;
  }
}

TEST_P(EveryMethod, StiffnessScalesTheForce)
{
  if (GetParam() == ProxyMethod::Sphere)
  {
    GTEST_SKIP() << "the ball leaps from gap to gap, and what it leaps settles in newtons";
  }
  const trial::Scene scene = trial::resampledScene(trial::spherePoints(50000, 10));
  HapticParameters soft = parameters();
  soft.contact.stiffness = 400.0;
  const trial::Path path = trial::sphereSlide(1e-3, 0.05, 100);
  const auto hard = trial::feel(scene, parameters(), path);
  const auto half = trial::feel(scene, soft, path);
  for (std::size_t i = 0; i < path.size(); ++i)
  {
    ASSERT_LE(norm(hard[i].force - 2.0 * half[i].force), 1e-12);
  }
}

namespace
{

/// A hand that rests a millimetre deep, and the force on it.
struct Resting
{
  explicit Resting(const HapticParameters& parameters)
    : scene(trial::resampledScene(trial::planePoints(60000, 21)))
    , proxy(parameters)
  {
    proxy.setScene(scene.get());
    last = trial::feel(proxy, trial::planeSlide(1e-3, 0.05, 60)).back();
    hip = last.hip;
    for (int i = 0; i < 100; ++i)
    {
      last = proxy.step(hip, trial::kTick);
    }
  }
  /// The largest change of the force within a tick, of so many to come.
  double largestChange(int ticks)
  {
    double largest = 0.0;
    for (int i = 0; i < ticks; ++i)
    {
      const ProxyState state = proxy.step(hip, trial::kTick);
      largest = std::max(largest, norm(state.force - last.force));
      last = state;
    }
    return largest;
  }

  trial::Scene scene;
  Proxy proxy;
  Vec3 hip;
  ProxyState last;
};

} // namespace

TEST_P(EveryMethod, ChangesOfParametersWhilePressedDoNotKick)
{
  Resting hand(parameters());
  ASSERT_GT(norm(hand.last.force), 0.5);
  const double step = parameters().contact.settleRate * trial::kTick * (1.0 + 1e-6);
  // GradientSteps trembles by itself.
  const double still = hand.largestChange(50);
  HapticParameters changed = parameters();
  const auto expectGentle = [&](const char* what)
  {
    hand.proxy.setParameters(changed);
    EXPECT_LE(hand.largestChange(60), step + still) << what;
  };
  changed.contact.stiffness = 1600.0;
  expectGentle("stiffness");
  EXPECT_GT(norm(hand.last.force), 1.3) << "it arrives";
  changed.contact.damping = 3.0;
  expectGentle("damping");
  changed.contact.staticFriction = changed.contact.dynamicFriction = 0.5;
  expectGentle("friction");
  changed.contact.stiffness = 100.0;
  expectGentle("less stiffness");
  changed.method = GetParam() == ProxyMethod::Sphere ? ProxyMethod::GradientSteps : ProxyMethod::Sphere;
  expectGentle("method");
}

TEST_P(EveryMethod, AHandThatComesOutWhileAChangeSettlesIsNotPulledIn)
{
  HapticParameters soft = parameters();
  soft.contact.stiffness = 100.0;
  Resting hand(soft);
  const Vec3 out = normalized(hand.last.force);
  hand.proxy.setParameters(parameters());
  for (int i = 0; i < 20; ++i)
  {
    hand.hip += 3e-4 * out;
    const ProxyState state = hand.proxy.step(hand.hip, trial::kTick);
    ASSERT_GE(dot(state.force, out), -1e-9) << i;
  }
}

TEST_P(EveryMethod, FadesWithinTenMillisecondsWhenTheSceneVanishesOrTheClockStands)
{
  Resting hand(parameters());
  const double most = 1.01 * norm(hand.last.force) / 10.0;
  hand.proxy.setScene(nullptr);
  EXPECT_LE(hand.largestChange(5), most);
  EXPECT_GT(norm(hand.last.force), 0.0);
  EXPECT_LE(hand.largestChange(6), most);
  EXPECT_EQ(hand.last.force, Vec3());
  EXPECT_FALSE(hand.last.contact);

  Resting other(parameters());
  for (int i = 1; i <= 10; ++i)
  {
    const ProxyState state = other.proxy.step(other.hip, 0.0);
    EXPECT_LE(norm(state.force - other.last.force), most) << i;
    other.last = state;
  }
  EXPECT_EQ(other.last.force, Vec3());
}

TEST_P(EveryMethod, FadesOnWhereOneFaultFollowsAnother)
{
  Resting hand(parameters());
  const double most = 1.01 * norm(hand.last.force) / 10.0;
  for (int i = 0; i < 18; ++i)
  {
    if (i == 5)
    {
      hand.proxy.setScene(nullptr);
    }
    const ProxyState state =
      hand.proxy.step(i % 3 == 0 ? Vec3(NAN, 0, 0) : hand.hip, i < 5 ? 0.0 : trial::kTick);
    ASSERT_LE(norm(state.force), norm(hand.last.force)) << i;
    ASSERT_LE(norm(state.force - hand.last.force), most) << i;
    hand.last = state;
  }
  EXPECT_EQ(hand.last.force, Vec3());

  Resting other(parameters());
  other.proxy.setScene(nullptr);
  other.proxy.setScene(other.scene.get());
  EXPECT_LE(other.largestChange(20), 1.01 * parameters().contact.settleRate * trial::kTick);
}

TEST_P(EveryMethod, AHandThatWasNoNumberWhileAChangeSettledIsFeltAgainWithoutAKick)
{
  for (const double stiffness : { 1600.0, 100.0 })
  {
    for (const int missing : { 1, 4, 20 })
    {
      SCOPED_TRACE(std::to_string(stiffness) + " N/m, " + std::to_string(missing) + " ticks");
      Resting hand(parameters());
      const double still = hand.largestChange(50);
      HapticParameters changed = parameters();
      changed.contact.stiffness = stiffness;
      hand.proxy.setParameters(changed);
      hand.largestChange(3);
      ProxyState last = hand.last;
      const double fade = norm(last.force) / 10.0;
      for (int i = 0; i < missing; ++i)
      {
        if (i == 2)
        {
          // While nobody knows where the hand is, too.
          changed.contact.stiffness = 800.0;
          hand.proxy.setParameters(changed);
        }
        const ProxyState state = hand.proxy.step({ NAN, 0.0, 0.0 }, trial::kTick);
        ASSERT_LE(norm(state.force - last.force), fade * (1.0 + 1e-9));
        last = state;
      }
      const double settle = parameters().contact.settleRate * trial::kTick + still;
      for (int i = 0; i < 60; ++i)
      {
        // The sphere of GradientSteps leaps over the points of its own accord while it slides.
        const double moved = GetParam() == ProxyMethod::GradientSteps ? 0.0 : 1e-6 * (i % 7);
        hand.hip.x += moved;
        const ProxyState state = hand.proxy.step(hand.hip, trial::kTick);
        const double follows = 2.0 * std::max(800.0, stiffness) * moved;
        ASSERT_LE(norm(state.force - last.force), settle + follows + 1e-8) << "tick " << i;
        ASSERT_GE(state.force.z, 0.0) << "it pulls nobody in, tick " << i;
        last = state;
      }
      EXPECT_GT(last.force.z, 0.8 * 1e-3 * (missing > 2 ? 800.0 : stiffness)) << "it arrives";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Proxy, EveryMethod,
  ::testing::Values(ProxyMethod::SurfaceFit, ProxyMethod::GradientSteps, ProxyMethod::Sphere),
  [](const ::testing::TestParamInfo<ProxyMethod>& method)
  {
    return method.param == ProxyMethod::SurfaceFit ? "SurfaceFit"
      : method.param == ProxyMethod::Sphere        ? "Sphere"
                                                   : "GradientSteps";
  });
;

TEST(Proxy, DampingActsAlongTheNormalInContactOnly)
{
  const trial::Scene scene = trial::resampledScene(trial::planePoints(100000, 11));
  HapticParameters damped;
  damped.contact.damping = 5.0;
  trial::Path path;
  for (int i = 0; i < 40; ++i)
  {
    path.emplace_back(1e-5 * i, 0, 2e-3 - 1e-4 * i);
  }
  const auto with = trial::feel(scene, damped, path);
  const auto without = trial::feel(scene, {}, path);
  for (std::size_t i = 1; i < path.size(); ++i)
  {
    const Vec3 extra = with[i].force - without[i].force;
    if (with[i].contact && with[i - 1].contact)
    {
      EXPECT_NEAR(extra.z, 5.0 * 0.1, 1e-6) << "against 0.1 m/s";
    }
    else if (!with[i].contact)
    {
      EXPECT_EQ(extra, Vec3());
    }
    EXPECT_NEAR(extra.x, 0.0, 1e-6) << "the tangential speed is not damped";
  }
}

TEST(Proxy, IgnoresParametersThatAreNotOk)
{
  Proxy proxy;
  HapticParameters bad;
  bad.contact.stiffness = NAN;
  ASSERT_NE(bad.check(), Status::Ok);
  proxy.setParameters(bad);
  EXPECT_EQ(proxy.parameters().contact.stiffness, 800.0);
}

TEST(Proxy, AChangeOfMethodStartsWithoutContact)
{
  const trial::Scene scene = trial::resampledScene(trial::spherePoints(50000, 12));
  Proxy proxy;
  proxy.setScene(scene.get());
  const auto states = trial::feel(proxy, trial::sphereSlide(1e-3, 0.05, 100));
  ASSERT_TRUE(states.back().contact);
  proxy.setParameters(trial::gradientSteps(GradientStepsParameters::tuned()));
  // The force of the last method goes at the settle rate.
  const ProxyState s = trial::feel(proxy, trial::Path(20, states.back().hip)).back();
  EXPECT_FALSE(s.contact);
  EXPECT_EQ(s.force, Vec3());
}

TEST(Proxy, TheContactPointOnNoiseStaysUnderAHandThatTrembles)
{
  trial::Random random(31);
  std::vector<Vec3> points = trial::planePoints(112000, 30); // 0.18 mm apart
  for (Vec3& p : points)
  {
    p.z = 3.6e-4 * random.normal();
  }
  const trial::Scene scene = trial::resampledScene(points);
  for (int place = 0; place < 12; ++place)
  {
    const Vec3 side = random.inBox({ -0.02, -0.02, 0.0 }, { 0.02, 0.02, 0.0 });
    trial::Path path;
    for (int i = 0; i <= 200; ++i)
    {
      path.push_back(side + Vec3(0, 0, 5e-3 - 4e-5 * i));
    }
    const Vec3 rest = path.back();
    for (int i = 0; i < 400; ++i)
    {
      const double angle = 2.0 * trial::kPi * i / 100.0;
      path.push_back(rest + 5e-6 * Vec3(std::cos(angle) - 1.0, std::sin(angle), 0.0));
    }
    const auto states = trial::feel(scene, {}, path);
    Bounds contact;
    for (std::size_t i = states.size() - 200; i < states.size(); ++i)
    {
      ASSERT_TRUE(states[i].contact) << place;
      contact.include(states[i].proxy);
    }
    // Fits of noise moved it by up to twice the hand's way.
    EXPECT_LT(norm(contact.extent()), 1e-6) << place;
  }
}
