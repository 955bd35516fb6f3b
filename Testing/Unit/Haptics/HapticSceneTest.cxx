#include "Shapes/Shapes.h"

#include "HapticFixtures.h"

using namespace pointhaptics;

TEST(HapticScene, HoldsEveryFinitePoint)
{
  std::vector<Vec3> points = trial::spherePoints(5000, 1);
  points[7].x = NAN;
  points[8].y = INFINITY;
  Status status = Status::Empty;
  const trial::Scene scene = trial::rawScene(points, &status);
  ASSERT_EQ(status, Status::Ok);
  EXPECT_EQ(scene->numberOfPoints(), 4998u);
  for (const Vec3& p : points)
  {
    if (isFinite(p))
    {
      EXPECT_GE(p.x, scene->bounds().minimum.x);
      EXPECT_LE(p.z, scene->bounds().maximum.z);
    }
  }
}

TEST(HapticScene, RefusesCloudsItCannotUse)
{
  const auto statusOf = [](HapticSceneInput input)
  {
    Status status = Status::Ok;
    EXPECT_EQ(HapticScene::create(std::move(input), status), nullptr);
    return status;
  };
  EXPECT_EQ(statusOf({}), Status::Empty);
  HapticSceneInput input;
  input.points = { { NAN, 0, 0 }, { 0, INFINITY, 0 } };
  EXPECT_EQ(statusOf(input), Status::Empty);
  input.points = { { 0, 0, 0 }, { 1, 0, 0 } };
  input.counts = { 1.0 };
  EXPECT_EQ(statusOf(input), Status::InvalidParameter);
  input.counts.clear();
  input.covariances.resize(3);
  EXPECT_EQ(statusOf(input), Status::InvalidParameter);
  input.covariances.clear();
  input.proxyRadii = { 1.0 };
  EXPECT_EQ(statusOf(input), Status::InvalidParameter);
  input.proxyRadii.clear();
  input.bandwidth = LocalBandwidthSettings();
  input.bandwidth->numberOfNeighbors = 0;
  EXPECT_EQ(statusOf(input), Status::InvalidNeighborhood);
  input.bandwidth.reset();
  input.modelToWorkspace = AffineTransform::scaling({ 1, 0, 1 });
  EXPECT_EQ(statusOf(input), Status::SingularTransform);
  input.modelToWorkspace = AffineTransform::translation({ NAN, 0, 0 });
  EXPECT_EQ(statusOf(input), Status::NonFiniteTransform);
}

TEST(HapticScene, RefusesACloudTooWideForItsSpacing)
{
  HapticSceneInput input;
  input.points = trial::randomBox(1000, 12, { 0, 0, 0 }, { 1e-6, 1e-6, 1e-6 });
  input.points.emplace_back(1e6, 0, 0);
  Status status = Status::Ok;
  EXPECT_EQ(HapticScene::create(std::move(input), status), nullptr);
  EXPECT_EQ(status, Status::LatticeNotAddressable);
}

TEST(HapticScene, RefusesPointsTooFarForAHandToFeelAny)
{
  for (const double far : { 1e8, 1e12, 1e18, 1e30 })
  {
    HapticSceneInput input =
      trial::resampledInput({ { 0, 0, 0 }, { 1, 0, 0 }, { far, 0, 0 } }, {}, far / 300);
    input.bandwidth = LocalBandwidthSettings();
    Status status = Status::Empty;
    EXPECT_EQ(HapticScene::create(std::move(input), status) == nullptr, far > 1e9) << far;
    EXPECT_EQ(status, far > 1e9 ? Status::PointsTooFar : Status::Ok) << far;
  }
}

TEST(HapticScene, OfSmallAndDegenerateCloudsAnswersEverywhere)
{
  const std::vector<std::vector<Vec3>> clouds{ { { 0.1, 0.2, 0.3 } }, { { 0, 0, 0 }, { 0.01, 0, 0 } },
    trial::randomBox(11, 2, { 0, 0, 0 }, { 0.01, 0.01, 0.01 }), std::vector<Vec3>(500, Vec3(1, 1, 1)) };
  for (const std::vector<Vec3>& cloud : clouds)
  {
    const trial::Scene scene = trial::rawScene(cloud);
    ASSERT_NE(scene, nullptr);
    for (const Vec3& p : { cloud[0], Vec3(0, 0, 0), Vec3(1e3, -1e3, 0) })
    {
      EXPECT_GT(scene->proxyRadius(p), 0.0);
      EXPECT_TRUE(std::isfinite(scene->proxyRadius(p)));
      EXPECT_GT(scene->fitRadius(p), 0.0);
      EXPECT_TRUE(std::isfinite(scene->fitRadius(p)));
    }
    EXPECT_TRUE(scene->isNear(cloud[0]));
    EXPECT_FALSE(scene->isNear({ 1e6, 1e6, 1e6 }));
  }
}

TEST(HapticScene, IsNearWhereverAPointIsWithinItsClearance)
{
  const std::vector<Vec3> points = trial::spherePoints(20000, 3);
  const trial::Scene scene = trial::rawScene(points);
  ASSERT_GT(scene->clearance(), 0.0);
  for (const Vec3& p : trial::randomBox(2000, 4, { -0.04, -0.04, -0.04 }, { 0.04, 0.04, 0.04 }))
  {
    double nearest = INFINITY;
    for (const Vec3& q : points)
    {
      nearest = std::min(nearest, norm2(p - q));
    }
    if (std::sqrt(nearest) <= scene->clearance())
    {
      ASSERT_TRUE(scene->isNear(p));
    }
  }
}

TEST(HapticScene, ProxyRadiusFollowsTheGivenRadii)
{
  HapticSceneInput input;
  input.points = trial::planePoints(20000, 5);
  for (const Vec3& p : input.points)
  {
    input.proxyRadii.push_back(p.x < 0 ? 0.001 : 0.002);
  }
  const trial::Scene scene = trial::sceneOf(input);
  EXPECT_NEAR(scene->proxyRadius({ -0.02, 0, 0 }), 0.001, 5e-5);
  EXPECT_NEAR(scene->proxyRadius({ 0.02, 0, 0 }), 0.002, 1e-4);
  double last = scene->proxyRadius({ -0.02, 0, 0 });
  for (double x = -0.02; x < 0.02; x += 1e-5)
  {
    const double radius = scene->proxyRadius({ x, 0, 0 });
    EXPECT_LE(std::fabs(radius - last), 2e-5) << "smooth";
    last = radius;
  }
}

// Without radii the scene takes 2.8 typical spacings everywhere; its header promises local ones.
TEST(HapticScene, ProxyRadiusIsLargerWhereTheCloudIsSparse)
{
  std::vector<Vec3> points = trial::planePoints(40000, 6);
  const std::size_t dense = points.size();
  for (std::size_t i = 0; i < dense; ++i)
  {
    points[i].x = 0.5 * points[i].x - 0.015;
  }
  for (Vec3 p : trial::planePoints(2500, 7))
  {
    p.x = 0.5 * p.x + 0.015;
    points.push_back(p);
  }
  const trial::Scene scene = trial::rawScene(points);
  const double spacing = std::sqrt(0.03 * 0.06 / 40000);
  EXPECT_NEAR(scene->proxyRadius({ -0.02, 0, 0 }) / (2.8 * spacing), 1.0, 0.2);
  EXPECT_NEAR(scene->proxyRadius({ 0.02, 0, 0 }) / (2.8 * 4 * spacing), 1.0, 0.2);
}

// The scene asks for the radii of a few points only: it must not show.
TEST(HapticScene, WithARuleIsThatOfTheWholeArrayOfRadii)
{
  for (const bool duplicates : { false, true })
  {
    HapticSceneInput lazy = trial::resampledInput(trial::spherePoints(50000, 14, 20e-6));
    if (duplicates)
    {
      lazy.points.insert(lazy.points.end(), 100, lazy.points[5]);
      lazy.counts.resize(lazy.points.size(), 1.0);
      lazy.covariances.resize(lazy.points.size());
    }
    lazy.bandwidth = LocalBandwidthSettings();
    HapticSceneInput whole = lazy;
    whole.bandwidth.reset();
    const PointView points(lazy.points.data(), std::int64_t(lazy.points.size()));
    NeighborQuery query;
    query.build(points);
    std::vector<double> bandwidths;
    ASSERT_EQ(
      localBandwidths(points, lazy.counts, query, *lazy.bandwidth, bandwidths, whole.proxyRadii), Status::Ok);
    const trial::Scene one = trial::sceneOf(lazy);
    const trial::Scene other = trial::sceneOf(whole);
    for (const Vec3& p : trial::randomBox(500, 15, { -0.03, -0.03, -0.03 }, { 0.03, 0.03, 0.03 }))
    {
      ASSERT_EQ(one->proxyRadius(p), other->proxyRadius(p));
    }
  }
}

TEST(HapticScene, RadiusByARuleFollowsTheDensityWithoutJumps)
{
  HapticSceneInput input;
  ASSERT_EQ(generateShape(Shape::DensityStep, 60000, 16, 0.0, input.points), Status::Ok);
  input.bandwidth = LocalBandwidthSettings();
  const trial::Scene scene = trial::sceneOf(input);
  EXPECT_NEAR(scene->proxyRadius({ -0.025, 0, 0 }) / scene->proxyRadius({ 0.025, 0, 0 }), 4.0, 0.5);
  double last = scene->proxyRadius({ -0.03, 0.001, 0 });
  for (double x = -0.03; x < 0.03; x += 1e-5)
  {
    const double radius = scene->proxyRadius({ x, 0.001, 0 });
    EXPECT_LE(std::fabs(radius - last), 0.75 * 1e-5) << "at " << x;
    last = radius;
  }
}

// The means of a lattice are about as dense everywhere; their counts tell what the points were.
TEST(HapticScene, RadiusOfAResampledCloudFollowsTheDensityOfThePoints)
{
  std::vector<Vec3> points;
  ASSERT_EQ(generateShape(Shape::DensityStep, 543652, 16, 0.0, points), Status::Ok);
  HapticSceneInput raw;
  raw.points = points;
  raw.bandwidth = LocalBandwidthSettings();
  HapticSceneInput input = trial::resampledInput(points);
  input.bandwidth = LocalBandwidthSettings();
  HapticSceneInput ofMeans = input;
  ofMeans.bandwidth->usePointCounts = false;
  const trial::Scene expected = trial::sceneOf(raw);
  const trial::Scene scene = trial::sceneOf(input);
  const auto ratio = [](const trial::Scene& of) {
    return of->proxyRadius({ -0.025, 0, 0 }) / of->proxyRadius({ 0.025, 0, 0 });
  };
  EXPECT_GE(ratio(scene), 3.5);
  EXPECT_LT(ratio(trial::sceneOf(ofMeans)), 2.0);
  for (const Vec3& p : { Vec3(-0.025, 0, 0), Vec3(-0.02, 0.01, 0), Vec3(0.025, 0, 0), Vec3(0.03, 0.02, 0) })
  {
    // Radii of a few points each scatter.
    EXPECT_NEAR(scene->proxyRadius(p) / expected->proxyRadius(p), 1.0, 0.2);
    EXPECT_EQ(expected->coveringRadius(p), expected->proxyRadius(p));
    EXPECT_EQ(scene->coveringRadius(p), std::max(scene->proxyRadius(p), 2.8 * scene->cellSize()));
  }
}

TEST(HapticScene, DoesNotDependOnTheExecutor)
{
  HapticSceneInput input = trial::resampledInput(trial::spherePoints(50000, 8, 20e-6));
  input.bandwidth = LocalBandwidthSettings();
  Status status = Status::Ok;
  const trial::Scene one = HapticScene::create(input, status);
  const trial::Scene three = HapticScene::create(input, status, trial::ThreadedExecutor(3));
  for (const Vec3& p : trial::randomBox(300, 9, { -0.03, -0.03, -0.03 }, { 0.03, 0.03, 0.03 }))
  {
    EXPECT_EQ(one->proxyRadius(p), three->proxyRadius(p));
    EXPECT_EQ(one->fitScale(p).radius, three->fitScale(p).radius);
    EXPECT_EQ(one->fitScale(p).gate, three->fitScale(p).gate);
  }
}

TEST(HapticScene, SparsePointsGetOthersBetweenThemForTheBall)
{
  // A spiral, as even as the vertices of a mesh.
  std::vector<Vec3> points;
  for (int i = 0; i < 8000; ++i)
  {
    const double z = (i + 0.5) / 4000 - 1.0;
    const double angle = trial::kPi * (3.0 - std::sqrt(5.0)) * i;
    const double r = std::sqrt(1.0 - z * z);
    points.push_back(trial::kSphereRadius * Vec3(r * std::cos(angle), r * std::sin(angle), z));
  }
  const HapticSceneInput input = trial::resampledInput(points);
  const auto raw = trial::rawScene(input.points);
  const auto scene = trial::sceneOf(input);
  EXPECT_EQ(scene->numberOfPoints(), input.points.size());
  EXPECT_GT(scene->contactPyramid().level(0).cells.size(), 3 * scene->numberOfPoints());
  EXPECT_LT(scene->contactCell(), 0.6 * scene->cellSize());
  // No voxels, no size to be sparse against.
  EXPECT_EQ(&raw->contactPyramid(), &raw->pyramid());
}

TEST(HapticScene, DenseAndRandomPointsDecideAboutContactThemselves)
{
  // Points at random likewise: their gaps would stay open.
  const auto few = trial::resampledScene(trial::spherePoints(8000, 5));
  EXPECT_EQ(&few->contactPyramid(), &few->pyramid());
  const auto scene = trial::resampledScene(trial::spherePoints(200000, 5));
  EXPECT_EQ(&scene->contactPyramid(), &scene->pyramid());
  EXPECT_EQ(scene->contactCell(), scene->cellSize());
}
