#include "Haptics/LocalScene.h"

#include "HapticFixtures.h"

#include "Core/Base/Boxes.h"
#include "Core/Resample/TransformedBounds.h"
#include "Haptics/Contact/BallCells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

using namespace pointhaptics;
using namespace pointhaptics::trial;

namespace
{

constexpr double kSide = 0.024;
constexpr double kWave = 0.004;
constexpr double kAmplitude = 0.0001;

double height(double x, double y)
{
  return kAmplitude * std::sin(2.0 * kPi * x / kWave) * std::sin(2.0 * kPi * y / kWave);
}

/// Points of a square with waves that are a few voxels long.
std::vector<Vec3> waves(int n, double noise = 0.0)
{
  Random random(7);
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i)
  {
    Vec3 p = random.inBox({ -0.5 * kSide, -0.5 * kSide, 0.0 }, { 0.5 * kSide, 0.5 * kSide, 0.0 });
    p.z = height(p.x, p.y) + (noise > 0.0 ? noise * random.normal() : 0.0);
    points.push_back(p);
  }
  return points;
}

constexpr int kDense = 50000; // 0.11 mm apart

Bounds handAt(const Vec3& place)
{
  Bounds hand;
  hand.include(place);
  return hand;
}

/// Null: no point is finite.
std::shared_ptr<const PointIndex> indexOf(const std::vector<Vec3>& points)
{
  const auto index = std::make_shared<PointIndex>();
  const Status status = index->build(PointView(points.data(), std::int64_t(points.size())));
  return status == Status::Ok ? index : nullptr;
}

/// A cloud with the scene of all of it.
struct Cloud
{
  explicit Cloud(const std::vector<Vec3>& points, const Bounds& workspace = {})
    : builder(indexOf(points))
  {
    SceneOrigin origin;
    origin.bandwidth.emplace();
    origin.voxels.lattice.automaticWorkspace = workspace.empty();
    origin.voxels.lattice.workspace = workspace;
    HapticSceneInput input = resampledInput(points);
    input.origin = std::make_shared<const SceneOrigin>(origin);
    whole = sceneOf(std::move(input));
  }
  LocalSceneFollower follower() const { return LocalSceneFollower(whole, builder.index()); }
  Scene whole;
  LocalSceneBuilder builder;
};

bool isSame(const Cell& a, const Cell& b)
{
  const SymMat3 &p = a.covariance, &q = b.covariance;
  return a.mean == b.mean && a.count == b.count && p.xx == q.xx && p.xy == q.xy && p.xz == q.xz &&
    p.yy == q.yy && p.yz == q.yz && p.zz == q.zz;
}

std::vector<Cell> cellsAbout(const HapticScene& scene, int level, const Vec3& place, double radius)
{
  std::vector<Cell> cells;
  scene.pyramid().visitBall(
    level, place, radius, [&](std::uint32_t, const Cell& cell, double) { cells.push_back(cell); });
  return cells;
}

TEST(LocalScene, HasCellsAboutAsFineAsThePoints)
{
  Cloud cloud(waves(kDense));
  const Vec3 hand{ 0.001, 0.0005, 0.0 };
  ASSERT_TRUE(isFinerNear(handAt(hand), *cloud.whole));
  const Scene scene = cloud.builder.build(handAt(hand), cloud.whole);
  ASSERT_NE(scene, nullptr);
  EXPECT_LT(scene->cellSize(), 0.6 * cloud.whole->cellSize());
  EXPECT_GE(scene->cellSize(), LocalSceneBuilder::kFinest * cloud.whole->cellSize());
  EXPECT_LT(scene->fitRadius(hand), 0.6 * cloud.whole->fitRadius(hand));
  EXPECT_EQ(scene->globalCloudNumber(), cloud.whole->cloudNumber());
}

TEST(LocalScene, OverlappingOnesHaveTheSameCellsBitForBit)
{
  Cloud cloud(waves(kDense));
  const Scene a = cloud.builder.build(handAt({ 0.0, 0.0, 0.0 }), cloud.whole);
  const Scene b = cloud.builder.build(handAt({ 0.0013, -0.0008, 0.0004 }), cloud.whole);
  ASSERT_TRUE(a && b);
  ASSERT_EQ(a->cellSize(), b->cellSize());
  for (int level = 0; level < 3; ++level)
  {
    const std::vector<Cell> first = cellsAbout(*a, level, {}, 0.002);
    const std::vector<Cell> second = cellsAbout(*b, level, {}, 0.002);
    ASSERT_GT(first.size(), 10u);
    ASSERT_EQ(first.size(), second.size());
    // Their order is that of the pyramid, which begins elsewhere.
    const auto isAmong = [&](const Cell& cell)
    { return std::any_of(second.begin(), second.end(), [&](const Cell& c) { return isSame(c, cell); }); };
    EXPECT_TRUE(std::all_of(first.begin(), first.end(), isAmong)) << level;
  }
}

TEST(LocalScene, SharesWhatWasGatheredWhereItOverlapsTheLastOne)
{
  Cloud cloud(waves(kDense));
  const Vec3 hand{ 0.0009, -0.0008, 0.0 };
  const Scene a = cloud.builder.build(handAt({}), cloud.whole);
  const Scene b = cloud.builder.build(handAt({ 0.0018, -0.0016, 0.0 }), cloud.whole);
  const Scene far = cloud.builder.build(handAt({ 0.009, 0.0, 0.0 }), cloud.whole);
  ASSERT_TRUE(a && b && far);
  const Bounds shared = b->sharedWith(*a);
  EXPECT_TRUE(contains(shared, hand));
  EXPECT_FALSE(contains(shared, { -0.0028, 0.0, 0.0 })) << "of the first alone";
  EXPECT_TRUE(far->sharedWith(*a).empty());
  EXPECT_TRUE(a->sharedWith(*cloud.whole).empty());
  Cloud other(waves(kDense));
  EXPECT_TRUE(other.builder.build(handAt({}), other.whole)->sharedWith(*a).empty()) << "another cloud";
  FitCells fit;
  Vec3 gradient;
  a->fitScale(hand, fit, gradient);
  b->carryOver(fit, shared);
  const double radius = b->fitRadius(hand);
  EXPECT_NEAR(b->fitScale(hand, fit, gradient).radius, radius, 1e-12 * radius);
}

TEST(LocalScene, CoversWhatIsWithinReachOfTheHandAndItsContact)
{
  Cloud cloud(waves(kDense));
  Bounds hand;
  hand.include({ 0.0, 0.0, -0.001 });
  hand.include({ 0.0005, 0.0, 0.0 });
  const Scene scene = cloud.builder.build(hand, cloud.whole);
  ASSERT_NE(scene, nullptr);
  const double reach = LocalSceneBuilder::kReach;
  EXPECT_TRUE(scene->covers({ 0.0005 + 0.99 * reach, 0.0, 0.0 }));
  EXPECT_FALSE(scene->covers({ 0.0005 + 1.01 * reach, 0.0, 0.0 }));
  EXPECT_TRUE(scene->covers({ 0.0, 0.0, -0.001 - 0.99 * reach }));
  EXPECT_FALSE(scene->covers({ 0.0, 0.0, -0.001 - 1.01 * reach }));
  ASSERT_NE(scene->fallback(), nullptr);
  EXPECT_EQ(scene->fallback()->cloudNumber(), cloud.whole->cloudNumber());
}

TEST(LocalScene, IsTheSameForEveryExecutor)
{
  Cloud cloud(waves(kDense));
  const Bounds hand = handAt({ 0.002, 0.001, 0.0 });
  const Scene one = cloud.builder.build(hand, cloud.whole);
  const ThreadedExecutor threads(3);
  const BackwardExecutor backward(16);
  for (const Executor* executor :
    { static_cast<const Executor*>(&threads), static_cast<const Executor*>(&backward) })
  {
    const Scene other = cloud.builder.build(hand, cloud.whole, *executor);
    ASSERT_TRUE(one && other);
    ASSERT_EQ(one->numberOfPoints(), other->numberOfPoints());
    for (double x = 0.0; x < 0.004; x += 0.00037)
    {
      const Vec3 place{ x, 0.001, 0.0 };
      EXPECT_EQ(one->fitRadius(place), other->fitRadius(place));
      EXPECT_EQ(one->proxyRadius(place), other->proxyRadius(place));
    }
  }
}

TEST(LocalScene, IsOfNoUseWherePointsAreSparseOrSmoothOrNoisyOrFar)
{
  const Bounds hand = handAt({ 0.001, 0.0005, 0.0 });
  Cloud sparse(waves(3000)); // 0.44 mm apart
  EXPECT_FALSE(isFinerNear(hand, *sparse.whole));
  EXPECT_EQ(sparse.builder.build(hand, sparse.whole), nullptr);
  Cloud smooth(planePoints(300000, 1));
  EXPECT_EQ(smooth.builder.build(hand, smooth.whole), nullptr);
  Cloud noisy(spherePoints(kPaperLarge, 1, 2e-5));
  EXPECT_EQ(noisy.builder.build(handAt({ 0.0, 0.0, kSphereRadius }), noisy.whole), nullptr);
  // Noise of two spacings leaves a point or two in each voxel.
  Cloud thick(waves(18000, 3.6e-4));
  EXPECT_EQ(thick.builder.build(hand, thick.whole), nullptr);
  Cloud dense(waves(kDense));
  EXPECT_NE(dense.builder.build(hand, dense.whole), nullptr);
  EXPECT_EQ(dense.builder.build(handAt({ 0.0, 0.0, 0.02 }), dense.whole), nullptr);
}

TEST(LocalScene, EndsWhereTheWorkspaceEnds)
{
  Bounds workspace;
  workspace.include({ -0.01, -0.01, -0.01 });
  workspace.include({ 0.00123, 0.01, 0.01 });
  Cloud cloud(waves(kDense), workspace);
  const Scene scene = cloud.builder.build(handAt({ 0.0005, 0.0, 0.0 }), cloud.whole);
  ASSERT_NE(scene, nullptr);
  EXPECT_LT(scene->bounds().maximum.x, 0.00123);
  EXPECT_GT(scene->bounds().maximum.x, 0.00110);
  EXPECT_EQ(cloud.builder.build(handAt({ 0.011, 0.0, 0.0 }), cloud.whole), nullptr);
}

TEST(LocalScene, OfNothingIsNone)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Cloud cloud(waves(kDense));
  EXPECT_EQ(cloud.builder.build({}, cloud.whole), nullptr);
  EXPECT_EQ(cloud.builder.build(handAt({ nan, 0.0, 0.0 }), cloud.whole), nullptr);
  EXPECT_EQ(cloud.builder.build(handAt({}), nullptr), nullptr);
  LocalSceneBuilder empty;
  EXPECT_EQ(empty.build(handAt({}), cloud.whole), nullptr);
  EXPECT_EQ(cloud.builder.build(handAt({}), resampledScene(waves(kDense))), nullptr) << "without an origin";
  std::vector<Vec3> points = waves(kDense);
  points.insert(points.begin(), { nan, 0.0, 0.0 });
  LocalSceneBuilder most(indexOf(points));
  const Scene scene = most.build(handAt({}), cloud.whole);
  ASSERT_NE(scene, nullptr);
  EXPECT_EQ(scene->numberOfPoints(), cloud.builder.build(handAt({}), cloud.whole)->numberOfPoints());
}

/// Across the waves and back, 0.5 mm deep.
Path stroke(int ticks)
{
  Path path;
  for (int i = 0; i < 100; ++i)
  {
    path.emplace_back(-0.006, 0.0003, 0.0005 - 1e-5 * i);
  }
  for (int i = 0; i < ticks; ++i)
  {
    path.emplace_back(-0.006 + 0.012 * i / ticks, 0.0003 + 0.002 * i / ticks, -0.0005);
  }
  return path;
}

TEST(LocalScene, IsFeltMoreExactlyThanTheWhole)
{
  Cloud cloud(waves(kDense));
  double squares[2] = {};
  for (const bool local : { false, true })
  {
    LocalSceneFollower follower = cloud.follower();
    Proxy proxy;
    const HapticScene* scene = nullptr;
    ProxyState state;
    for (const Vec3& hip : stroke(400))
    {
      const HapticScene* next =
        local ? follower.at(hip, state.contact ? state.proxy : hip) : cloud.whole.get();
      if (next != scene)
      {
        proxy.setScene(scene = next);
      }
      state = proxy.step(hip, kTick);
      const double off = state.contact ? state.proxy.z - height(state.proxy.x, state.proxy.y) : 0.0;
      squares[local] += off * off;
    }
    EXPECT_EQ(follower.numberOfScenes() > 3, local);
    EXPECT_EQ(follower.finestCell() < 0.6 * cloud.whole->cellSize(), local);
  }
  EXPECT_GT(squares[0], 0.0);
  const double factor = std::sqrt(squares[0] / squares[1]);
  RecordProperty("factor", std::to_string(factor));
  EXPECT_GT(factor, 3.0);
}

TEST(LocalScene, TheProxySaysWhereItFeelsTheFallback)
{
  Cloud cloud(waves(kDense));
  const Scene local = cloud.builder.build(handAt({}), cloud.whole);
  ASSERT_NE(local, nullptr);
  const Vec3 within{ 0.0, 0.0, 5e-4 };
  const Vec3 beyond{ 0.01, 0.0, 5e-4 };
  ASSERT_TRUE(local->covers(local->toLattice(within)));
  ASSERT_FALSE(local->covers(local->toLattice(beyond)));
  Proxy proxy;
  proxy.setScene(local.get());
  EXPECT_EQ(proxy.step(within, kTick).status & kProxyFallback, 0u);
  EXPECT_NE(proxy.step(beyond, kTick).status & kProxyFallback, 0u);
  EXPECT_NE(proxy.step(within, kTick).status & kProxyFallback, 0u) << "until the next scene comes";
  proxy.setScene(local.get());
  EXPECT_EQ(proxy.step(within, kTick).status & kProxyFallback, 0u);
  proxy.setScene(cloud.whole.get());
  EXPECT_EQ(proxy.step(beyond, kTick).status & kProxyFallback, 0u) << "it was meant to be felt";
  proxy.setScene(local.get());
  EXPECT_NE(proxy.step(beyond, kTick).status & kProxyFallback, 0u) << "it came where the hand is not";
}

TEST(LocalScene, ChangingToOneAndBackDoesNotKick)
{
  Cloud cloud(waves(kDense));
  const ContactParameters contact;
  LocalSceneFollower follower = cloud.follower();
  Proxy proxy;
  ProxyState last;
  double changes = 0.0;
  int tick = 0;
  const HapticScene* scene = nullptr;
  for (const Vec3& hip : stroke(1500))
  {
    const HapticScene* local = follower.at(hip, last.contact ? last.proxy : hip);
    const HapticScene* next = tick / 37 % 2 == 0 ? local : cloud.whole.get();
    if (next != scene)
    {
      proxy.setScene(scene = next);
    }
    const ProxyState state = proxy.step(hip, kTick);
    if (tick > 0)
    {
      const double limit = 2.0 * contact.stiffness * norm(hip - last.hip) + contact.settleRate * kTick;
      EXPECT_LE(norm(state.force - last.force), limit * (1.0 + 1e-6)) << tick;
      changes += norm(state.force - last.force);
    }
    EXPECT_TRUE(state.contact || tick < 150) << tick;
    last = state;
    ++tick;
  }
  EXPECT_GT(changes, 0.0);
}

TEST(LocalSceneFollower, MakesAnotherOneOnlyWhereTheLastOneEnds)
{
  Cloud cloud(waves(kDense));
  LocalSceneFollower follower = cloud.follower();
  EXPECT_EQ(follower.scene(), cloud.whole);
  EXPECT_TRUE(follower.update(handAt({})));
  const Scene first = follower.scene();
  EXPECT_NE(first, cloud.whole);
  const double inner = LocalSceneBuilder::kReach - LocalSceneBuilder::kNearEnd;
  EXPECT_FALSE(follower.update(handAt({ 0.99 * inner, 0.0, 0.0 })));
  EXPECT_EQ(follower.scene(), first);
  EXPECT_TRUE(follower.update(handAt({ 1.01 * inner, 0.0, 0.0 })));
  EXPECT_NE(follower.scene(), first);
  EXPECT_EQ(follower.numberOfScenes(), 2);
  EXPECT_TRUE(follower.update(handAt({ 0.0, 0.0, 0.03 }))) << "far away the whole cloud is felt";
  EXPECT_EQ(follower.scene(), cloud.whole);
  EXPECT_FALSE(follower.update(handAt({ 0.0, 0.0005, 0.03 })));
  EXPECT_TRUE(follower.update(handAt({})));
  EXPECT_EQ(follower.numberOfScenes(), 3);
}

TEST(LocalSceneFollower, CoversWhereAHandThatMovesWillBe)
{
  Cloud cloud(waves(kDense));
  const double reach = LocalSceneBuilder::kReach;
  const double most = LocalSceneFollower::kMostAhead;
  for (const bool moves : { false, true })
  {
    LocalSceneFollower follower = cloud.follower();
    EXPECT_TRUE(follower.update(handAt({})));
    const Bounds hand = handAt({ 0.001, 0.0, 0.0 });
    // At 0.2 m/s it is beyond the end by the time a scene is made.
    EXPECT_EQ(follower.update(hand, moves ? 0.005 : 0.0), moves);
    EXPECT_EQ(follower.scene()->covers({ 0.001 + 0.2 * LocalSceneFollower::kCoveredAhead, 0.0, 0.0 }), moves);
    EXPECT_EQ(follower.scene()->covers({ 0.001 + 0.999 * (most + reach), 0.0, 0.0 }), moves);
    EXPECT_TRUE(follower.scene()->covers({ -0.99 * (reach - 0.001), 0.0, 0.0 })) << "and where it is";
  }
  LocalSceneFollower fast = cloud.follower();
  fast.update(handAt({}));
  EXPECT_TRUE(fast.update(handAt({ 0.001, 0.0, 0.0 }), 0.001));
  EXPECT_FALSE(fast.scene()->covers({ 0.001 + 1.001 * (most + reach), 0.0, 0.0 })) << "no further than that";
}

TEST(LocalScene, HasTheCellsOfTheLatticeWherePointsAreSparser)
{
  // A dense strip among points so far apart that cells of their own would be coarser.
  constexpr double kStrip = 0.0005;
  Random random(7);
  std::vector<Vec3> points;
  for (int i = 0; i < 16000; ++i)
  {
    const double half = i < 2400 ? kStrip : 0.5 * kSide;
    Vec3 p = random.inBox({ -half, -0.5 * kSide, 0.0 }, { half, 0.5 * kSide, 0.0 });
    p.z = height(p.x, p.y);
    points.push_back(p);
  }
  Cloud cloud(points);
  const Scene scene = cloud.builder.build(handAt({ 0.0, 0.0005, 0.0 }), cloud.whole);
  ASSERT_NE(scene, nullptr);
  const double parts = cloud.whole->cellSize() / scene->cellSize();
  EXPECT_NEAR(parts, std::round(parts), 1e-9);
}

} // namespace
