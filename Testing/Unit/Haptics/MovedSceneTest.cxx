#include "HapticFixtures.h"

using namespace pointhaptics;

namespace
{

/// Turned, scaled and shifted.
AffineTransform placement(double scale)
{
  return AffineTransform::translation({ 0.004, -0.003, 0.002 }) *
    AffineTransform::rotation(37.0, { 1.0, -2.0, 0.5 }) * AffineTransform::scaling({ scale, scale, scale });
}

trial::Scene moved(const trial::Scene& scene, const AffineTransform& modelToWorkspace)
{
  Status status = Status::Empty;
  trial::Scene result = scene->moved(modelToWorkspace, status);
  EXPECT_EQ(status, Status::Ok);
  EXPECT_TRUE(result);
  return result;
}

trial::Path through(const AffineTransform& transform, const trial::Path& path)
{
  trial::Path result;
  for (const Vec3& p : path)
  {
    result.push_back(transform.apply(p));
  }
  return result;
}

trial::Path torusSlide()
{
  return trial::closedPath(trial::torusCourse, { 0.04, 0, 0.01 }, 1500, 1);
}

/// The exact force on the torus under a similarity.
Vec3 movedTorusForce(const AffineTransform& transform, const Vec3& hip)
{
  return transform.applyToVector(trial::torusForce(transform.inverse().apply(hip)));
}

} // namespace

TEST(MovedScene, AnswersLikeACloudThatWasResampledThere)
{
  const std::vector<Vec3> points = trial::torusPoints(200000, 41);
  const trial::Scene scene = trial::resampledScene(points);
  for (const double scale : { 0.8, 1.4 })
  {
    const AffineTransform transform = placement(scale);
    const trial::Path path = through(transform, torusSlide());
    const auto states = trial::feel(moved(scene, transform), {}, path);
    const auto expected = trial::feel(trial::resampledScene(points, transform), {}, path);
    double worst = 0.0;
    for (std::size_t i = 0; i < path.size(); ++i)
    {
      const Vec3 exact = movedTorusForce(transform, path[i]);
      ASSERT_EQ(states[i].contact, expected[i].contact) << i;
      ASSERT_LE(norm(states[i].force - exact), 4e-4 * norm(exact) + 1e-6) << "tick " << i;
      worst = std::max(worst, norm(states[i].force - expected[i].force));
      ASSERT_NEAR(norm(states[i].normal), 1.0, 1e-12);
    }
    EXPECT_LT(trial::recorded("movedAgainstResampled", worst), 5e-4) << "newtons, scale " << scale;
  }
}

TEST(MovedScene, AnswersInItsOwnFrameWhateverTheTransform)
{
  const trial::Scene scene = trial::resampledScene(trial::torusPoints(100000, 42), placement(0.9));
  const AffineTransform mirror = AffineTransform::scaling({ 1.2, 1.2, -1.2 });
  const trial::Path path = through(placement(0.9), torusSlide());
  const auto expected = trial::feel(scene, {}, path);
  for (const AffineTransform& change : { placement(1.0), placement(2.5), mirror })
  {
    const trial::Scene elsewhere = moved(scene, change * placement(0.9));
    const double scale = elsewhere->latticeScale();
    const auto states = trial::feel(elsewhere, {}, through(change, path));
    for (std::size_t i = 0; i < path.size(); ++i)
    {
      // Rounding may end the search for the foot point a round earlier or later.
      ASSERT_EQ(states[i].contact, expected[i].contact) << i;
      ASSERT_LE(norm(states[i].force - change.applyToVector(expected[i].force)), 2e-4 * scale) << i;
      ASSERT_LE(norm(states[i].proxy - change.apply(expected[i].proxy)), 2e-7 * scale) << i;
      ASSERT_LE(norm(states[i].sphereCenter - change.apply(expected[i].sphereCenter)), 1e-6 * scale) << i;
      ASSERT_LE(norm(scale * states[i].normal - change.applyToVector(expected[i].normal)), 1e-3 * scale) << i;
      ASSERT_NEAR(states[i].radius, scale * expected[i].radius, 1e-6 * scale) << i;
    }
  }
}

TEST(MovedScene, AnswersInItsOwnFrameWithGradientStepsToo)
{
  const trial::Scene scene = trial::resampledScene(trial::torusPoints(100000, 48));
  // A quarter of a turn, twice as large: nothing is rounded, so that no point comes into the sphere by it.
  AffineTransform change;
  change.m[0][0] = change.m[1][1] = 0.0;
  change.m[0][1] = -2.0;
  change.m[1][0] = change.m[2][2] = 2.0;
  const HapticParameters parameters = trial::gradientSteps(GradientStepsParameters::tuned());
  const auto expected = trial::feel(scene, parameters, torusSlide());
  const auto states = trial::feel(moved(scene, change), parameters, through(change, torusSlide()));
  bool touched = false;
  for (std::size_t i = 0; i < states.size(); ++i)
  {
    ASSERT_EQ(states[i].contact, expected[i].contact) << i;
    ASSERT_LE(norm(states[i].force - change.applyToVector(expected[i].force)), 1e-10) << i;
    ASSERT_LE(norm(states[i].sphereCenter - change.apply(expected[i].sphereCenter)), 1e-12) << i;
    ASSERT_LE(norm(2.0 * states[i].normal - change.applyToVector(expected[i].normal)), 1e-12) << i;
    ASSERT_NEAR(states[i].radius, 2.0 * expected[i].radius, 1e-15) << i;
    touched = touched || states[i].contact;
  }
  EXPECT_TRUE(touched);
}

TEST(MovedScene, CarriesAContactAlongAtEveryTick)
{
  const trial::Scene scene = trial::resampledScene(trial::torusPoints(200000, 43));
  Proxy proxy;
  proxy.setScene(scene.get());
  const Vec3 hip = trial::torusCourse(0.0);
  ProxyState last =
    trial::feel(proxy, trial::closedPath(trial::torusCourse, { 0.04, 0, 0.01 }, 4000, 0)).back();
  ASSERT_TRUE(last.contact);
  trial::Scene keep = scene;
  for (int i = 1; i <= 600; ++i)
  {
    // Turned by 30 degrees, lifted by 0.3 mm, enlarged by 3 %, all at once.
    const double zoom = 1.0 + 5e-5 * i;
    const AffineTransform transform = AffineTransform::translation({ 0, 0, 5e-7 * i }) *
      AffineTransform::rotation(0.05 * i, { 0, 0, 1 }) * AffineTransform::scaling({ zoom, zoom, zoom });
    const trial::Scene next = moved(scene, transform);
    proxy.setScene(next.get());
    const ProxyState state = proxy.step(hip, trial::kTick);
    ASSERT_TRUE(state.contact) << i;
    ASSERT_EQ(state.status & kProxyBallContact, 0u) << i;
    ASSERT_LE(norm(state.force - movedTorusForce(transform, hip)), 2e-3) << i;
    ASSERT_LE(norm(state.force - last.force), proxy.parameters().contact.settleRate * trial::kTick + 1e-9);
    last = state;
    keep = next;
  }
}

TEST(MovedScene, MeetsAFreeHandFromTheSideItIsOn)
{
  const trial::Scene scene = trial::resampledScene(trial::torusPoints(200000, 44));
  const Vec3 hip{ 0.0, trial::kRingRadius, trial::kTubeRadius + 1e-3 };
  const AffineTransform shift = AffineTransform::translation({ 0.0, 0.0, 2e-3 });
  const AffineTransform turn = AffineTransform::rotation(5.0, { 1, 0, 0 });
  const AffineTransform grow =
    AffineTransform::translation({ 0.0, -5e-3, 0.0 }) * AffineTransform::scaling({ 1.2, 1.2, 1.2 });
  for (const AffineTransform& change : { shift, turn, grow })
  {
    Proxy proxy;
    proxy.setScene(scene.get());
    ASSERT_FALSE(trial::feel(proxy, trial::Path(3, hip)).back().contact);
    const trial::Scene after = moved(scene, change);
    proxy.setScene(after.get());
    const ProxyState state = trial::feel(proxy, trial::Path(100, hip)).back();
    ASSERT_TRUE(state.contact);
    EXPECT_LE(norm(state.force - movedTorusForce(change, hip)), 2e-3);
    EXPECT_GT(norm(state.force), 0.1);
  }
}

TEST(MovedScene, GivesPlaceToAResampledCloudWithoutAStep)
{
  const std::vector<Vec3> points = trial::torusPoints(200000, 45);
  const trial::Scene scene = trial::resampledScene(points);
  const AffineTransform transform = placement(1.1);
  const trial::Scene turned = moved(scene, transform);
  const trial::Scene fresh = trial::resampledScene(points, transform);
  const AffineTransform onwards = AffineTransform::rotation(0.1, { 0, 1, 0 }) * transform;
  const trial::Scene later = moved(fresh, onwards);
  Proxy proxy;
  proxy.setScene(turned.get());
  const auto states = trial::feel(proxy, through(transform, torusSlide()));
  ASSERT_TRUE(states.back().contact);
  const Vec3 hip = states.back().hip;
  proxy.setScene(fresh.get());
  const ProxyState there = proxy.step(hip, trial::kTick);
  EXPECT_TRUE(there.contact);
  EXPECT_EQ(there.status & (kProxyBallContact | kProxySettling), 0u);
  EXPECT_LE(norm(there.force - states.back().force), 5e-4);
  proxy.setScene(later.get());
  const ProxyState further = proxy.step(hip, trial::kTick);
  EXPECT_TRUE(further.contact);
  EXPECT_EQ(further.status & kProxyBallContact, 0u);
  EXPECT_LE(norm(further.force - movedTorusForce(onwards, hip)), 2e-3);
}

TEST(MovedScene, SharesTheCloud)
{
  const trial::Scene scene = trial::resampledScene(trial::planePoints(20000, 46));
  const trial::Scene other = trial::resampledScene(trial::planePoints(20000, 46));
  const trial::Scene elsewhere = moved(moved(scene, placement(1.5)), placement(2.0));
  EXPECT_EQ(&elsewhere->pyramid(), &scene->pyramid());
  EXPECT_EQ(elsewhere->cloudNumber(), scene->cloudNumber());
  EXPECT_NE(other->cloudNumber(), scene->cloudNumber());
  EXPECT_EQ(elsewhere->modelToWorkspace(), placement(2.0));
  EXPECT_TRUE(elsewhere->modelToLattice().isIdentity());
  EXPECT_NEAR(elsewhere->latticeScale(), 2.0, 1e-12);
  EXPECT_FALSE(moved(elsewhere, {})->isMoved());
  const Vec3 p{ 0.01, -0.02, 0.03 };
  EXPECT_LE(norm(elsewhere->toLattice(elsewhere->toWorkspace(p)) - p), 1e-15);
  EXPECT_LE(norm(elsewhere->toWorkspace(p) - placement(2.0).apply(p)), 1e-15);
}

TEST(MovedScene, RefusesWhatIsNoSimilarity)
{
  const trial::Scene scene = trial::resampledScene(trial::planePoints(20000, 47), placement(1.3));
  AffineTransform shear;
  shear.m[0][1] = 0.1;
  AffineTransform notFinite;
  notFinite.m[1][3] = NAN;
  const struct
  {
    AffineTransform transform;
    Status expected;
  } cases[] = { { shear, Status::InvalidParameter },
    { AffineTransform::scaling({ 1.0, 1.0, 1.001 }) * placement(1.3), Status::InvalidParameter },
    { AffineTransform::scaling({ 0, 0, 0 }), Status::SingularTransform },
    { notFinite, Status::NonFiniteTransform } };
  for (const auto& c : cases)
  {
    Status status = Status::Ok;
    EXPECT_FALSE(scene->moved(c.transform, status));
    EXPECT_EQ(status, c.expected);
  }
}
