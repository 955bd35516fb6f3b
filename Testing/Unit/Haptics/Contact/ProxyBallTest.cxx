#include "BallFixtures.h"

using namespace pointhaptics;
using trial::BallInScene;
using trial::deepestOnWay;
using trial::LongVec;
using trial::Real;

namespace
{

/// Sheets, shells, lines, blobs and waves, some of them across each other, each at its own density.
std::vector<Vec3> randomSurfaces(trial::Random& random)
{
  std::vector<Vec3> points;
  const int parts = 1 + int(random.below(3));
  for (int part = 0; part < parts; ++part)
  {
    const int n = 1 << (4 + random.below(9));
    const Vec3 at = random.inBox({ -0.006, -0.006, -0.006 }, { 0.006, 0.006, 0.006 });
    const Vec3 normal = random.direction();
    const Vec3 a = anyPerpendicular(normal);
    const Vec3 b = cross(normal, a);
    const double size = random.uniform(0.003, 0.015);
    const double wave = random.below(2) == 0 ? 0.0 : random.uniform(0.0, 0.3 * size);
    const std::size_t kind = random.below(5);
    for (int i = 0; i < n; ++i)
    {
      const double u = random.uniform(-1, 1);
      const double v = random.uniform(-1, 1);
      const Vec3 sheet = at + size * (u * a + v * b) + wave * std::sin(4 * u) * std::cos(3 * v) * normal;
      points.push_back(kind < 2 ? sheet
          : kind == 2           ? at + size * random.direction()
          : kind == 3           ? at + size * u * a
                                : at + random.inBox({ -size, -size, -size }, { size, size, size }));
    }
  }
  return points;
}

/// One move of a hand of at most 1 m/s, mostly: still, slow, fast, a leap, far away.
Vec3 randomHandMove(trial::Random& random, const Vec3& hip, Vec3& velocity)
{
  switch (random.below(300))
  {
    case 0:
      return random.inBox({ -0.03, -0.03, -0.03 }, { 0.03, 0.03, 0.03 });
    case 1:
      velocity = Vec3();
      return hip;
    case 2:
      velocity = std::pow(10.0, random.uniform(-8, -3)) * random.direction();
      return hip;
    case 3:
      return random.below(20) == 0 ? 10.0 * random.direction() : hip;
    default:
      break;
  }
  velocity += 2e-6 * random.direction() - 5e-5 * hip;
  return hip + velocity;
}

/// How many points the scene has that a ball at @p center with a way of @p way looks at.
int pointsNear(const HapticScene& scene, const Vec3& center, double way)
{
  int count = 0;
  const ContactField& field = scene.contactField();
  field.pyramid().visitBall(0, center, way + field.largest(),
    [&](std::uint32_t index, const Cell&, double d2)
    {
      const double reach = double(field.radii(0)[index]) + way;
      count += d2 < reach * reach;
    });
  return count;
}

/// The distance from the HIP that the ball may have now. It follows the HIP's way in strides of a radius. In
/// one stride it ends no farther from the HIP than it stood; over several, farther than before by no more
/// than the HIP went. And by what growing pushes it, and by the bumps that gliding lifts it over, a tenth of
/// a radius each. @p bound: the last tick's; it receives this tick's.
double mostAway(
  const ProxyBall& before, const ProxyBall& ball, const Vec3& last, const Vec3& asked, double& bound)
{
  const double moved = norm(asked - last);
  const double grown = std::max(0.0, ball.radius() - before.radius());
  const bool oneStride = before.isThere(last) && moved < 0.9 * before.radius();
  const double most =
    (oneStride ? norm(before.center() - asked) : bound + moved) + 3.0 * grown + 0.3 * ball.radius();
  bound = ball.isThere(asked) ? norm(ball.center() - asked) : bound + moved;
  return most;
}

/// Checks that hold in every tick, also among more points than the ball can know. @param again another ball
/// under the same hand, in memory of its own.
void expectOrderly(const BallInScene& hand, const BallInScene& again, const ProxyBall& before)
{
  const ProxyBall& ball = hand.ball();
  ASSERT_TRUE(trial::isFinite(ball));
  ASSERT_TRUE(trial::isSame(ball, again.ball())) << "the same hand, the same ball";
  ASSERT_GT(ball.radius(), 0.0);
  ASSERT_GE(ball.scale(), before.scale());
}

/// How deep the ball covers a point, over that point's radius.
double coveredBy(const BallInScene& hand)
{
  return double(deepestOnWay(hand.scene(), hand.ball().center(), hand.ball().center(), hand.ball().scale()));
}

/// True if the ball followed in one stride, and neither glided nor grew: it only slid, which brings it no
/// further from the HIP.
bool hasOnlySlid(const ProxyBall& before, const BallInScene& hand, const Vec3& last)
{
  const ProxyBall& ball = hand.ball();
  return !before.isFree() && before.isThere(last) && ball.isThere(hand.hip()) && !hand.hasGlided() &&
    ball.radius() <= before.radius() && norm(hand.hip() - last) < 0.9 * ball.radius();
}

double quantile(std::vector<double> values, double part)
{
  std::sort(values.begin(), values.end());
  return values.empty() ? 0.0 : values[std::size_t(part * double(values.size() - 1))];
}

class ProxyBallPromises : public ::testing::TestWithParam<int>
{
};

} // namespace

TEST_P(ProxyBallPromises, AreKeptOnRandomCloudsUnderRandomHands)
{
  constexpr int kTicksPerCloud = 1000;
  trial::Random random(GetParam());
  int contacts = 0;
  int crowded = 0;
  int closer = 0;
  int straight = 0;
  double mostCovered = 0.0;
  for (int done = 0; done < trial::stressTicks(); done += kTicksPerCloud)
  {
    const std::vector<Vec3> points = randomSurfaces(random);
    BallInScene hand(random.below(2) == 0 ? trial::rawScene(points) : trial::resampledScene(points));
    BallInScene again = hand.copy();
    const ProxyBall& ball = hand.ball();
    Vec3 hip = 0.025 * random.direction();
    Vec3 velocity = -1e-4 * normalized(hip);
    hand.step(hip), again.step(hip);
    double bound = norm(ball.center() - hip);
    bool isCrowded = false;
    for (int tick = 0; tick < kTicksPerCloud; ++tick)
    {
      SCOPED_TRACE(done + tick);
      const ProxyBall before = ball;
      const Vec3 last = hand.hip();
      const Vec3 asked = randomHandMove(random, hip, velocity);
      hand.step(asked), again.step(asked);
      hip = norm(asked) < 1.0 ? asked : hip;
      contacts += !before.isFree() && !ball.isFree();
      const double most = mostAway(before, ball, last, asked, bound);
      expectOrderly(hand, again, before);
      ASSERT_FALSE(::testing::Test::HasFatalFailure());
      // Points that the ball did not know may stay covered until it comes off.
      isCrowded = (hand.takeStatus() & kProxyCellLimit) != 0u || (isCrowded && !ball.isFree());
      if (isCrowded)
      {
        ++crowded;
        mostCovered = std::max(mostCovered, coveredBy(hand));
        hand.invalidate(), again.invalidate();
        continue;
      }
      ASSERT_LE(coveredBy(hand), 1e-8);
      ASSERT_LE(norm(ball.center() - asked), most + 1e-9 * ball.radius());
      if (hasOnlySlid(before, hand, last))
      {
        ++closer;
        ASSERT_LE(norm(ball.center() - asked), norm(before.center() - asked) + 1e-9 * ball.radius());
      }
      if (before.isFree() && before.isThere(last) && !ball.hasSlid() && ball.scale() == before.scale())
      {
        ++straight;
        ASSERT_LE(double(deepestOnWay(hand.scene(), before.center(), ball.center(), ball.scale())), 1e-8);
      }
    }
  }
  const double ticks = trial::stressTicks();
  trial::recorded("coveredWhereCrowdedOverRadius", mostCovered);
  EXPECT_GT(contacts, ticks / 20) << "the hand meets something";
  EXPECT_GT(trial::recorded("onlySlidShare", closer / ticks), 0.05);
  EXPECT_GT(trial::recorded("straightShare", straight / ticks), 0.05);
  EXPECT_LT(trial::recorded("crowdedShare", crowded / ticks), 0.1);
}

/// A million ticks in shards that run side by side.
INSTANTIATE_TEST_SUITE_P(Seeds, ProxyBallPromises, ::testing::Range(21, 31));

TEST(ProxyBall, LooksAtABoundedNumberOfPointsInATick)
{
  // A large ball, as sparse points ask for, at the border of dense ones: thousands of them are within its
  // reach, and each way leads to others.
  trial::Random random(67);
  std::vector<Vec3> points = trial::jitteredPlane(400, 0.08, 0.0, random);
  std::uint64_t most = 0;
  for (Vec3& p : points)
  {
    p.x += 0.04;
  }
  for (Vec3 p : trial::jitteredPlane(16, 0.08, 0.0, random))
  {
    p.x -= 0.04;
    points.push_back(p);
  }
  BallInScene hand(trial::rawScene(points));
  for (int run = 0; run < 10; ++run)
  {
    hand.ball().reset();
    hand.step({ random.uniform(-0.03, -0.01), random.uniform(-0.01, 0.01), 0.03 });
    for (int tick = 0; tick < 300; ++tick)
    {
      const std::uint64_t before = hand.cells().pointsExamined();
      hand.step(hand.hip() +
        Vec3(random.uniform(-0.001, 0.002), random.uniform(-0.001, 0.001), tick < 100 ? -0.0004 : 0.0));
      most = std::max(most, hand.cells().pointsExamined() - before);
    }
  }
  trial::recorded("mostLookedAt", double(most));
  EXPECT_LT(most, 60000u);
}

TEST(ProxyBall, NeverMovesAwayFromAHandThatRests)
{
  trial::Random random(22);
  for (int cloud = 0; cloud < 60; ++cloud)
  {
    BallInScene hand(trial::rawScene(trial::jitteredPlane(20, 0.02, 0.0, random)));
    hand.step(random.inBox({ -0.005, -0.005, 0.003 }, { 0.005, 0.005, 0.004 }));
    hand.go(random.inBox({ -0.007, -0.007, -0.004 }, { 0.007, 0.007, -0.0005 }), random.uniform(0.01, 1.0));
    // Its radius settles first.
    hand.rest(100);
    double away = norm(hand.ball().center() - hand.hip());
    for (int i = 0; i < 50; ++i)
    {
      hand.rest(1);
      const double now = norm(hand.ball().center() - hand.hip());
      ASSERT_LE(now, away + 0.01 * hand.ball().radius()) << cloud; // a glide lifts it
      away = now;
    }
  }
}

TEST(ProxyBall, IsFiniteAndFreeInTheEndWhateverTheCloud)
{
  trial::Random random(28);
  std::vector<Vec3> line;
  for (int i = 0; i < 200; ++i)
  {
    line.emplace_back(1e-4 * (i - 100), 0, 0);
  }
  std::vector<Vec3> pair(1000, Vec3(1e-3, 0, 0));
  pair.resize(2000, Vec3(-1e-3, 0, 0));
  for (const std::vector<Vec3>& points : { std::vector<Vec3>(1), std::vector<Vec3>(100000, Vec3(0, 0, 0)),
         line, pair, std::vector<Vec3>{ Vec3(0, 0, 0), Vec3(1e-5, 0, 0), Vec3(0, 1e-8, 0) } })
  {
    for (const bool raw : { true, false })
    {
      if (raw && points.size() > 5000)
      {
        continue; // slow to make a scene of
      }
      BallInScene hand(raw ? trial::rawScene(points) : trial::resampledScene(points));
      for (const Vec3& start : { Vec3(0, 0, 0.005), Vec3(0, 0, 0), points.back() })
      {
        hand.ball().reset();
        hand.step(start);
        for (int move = 0; move < 60; ++move)
        {
          const double size = std::pow(10.0, random.uniform(-6, -2));
          hand.go(move % 3 == 0 ? points[random.below(points.size())] : size * random.direction(), 0.2);
          hand.rest(2);
          ASSERT_TRUE(trial::isFinite(hand.ball())) << points.size();
          ASSERT_GT(hand.ball().radius(), 0.0);
          ASSERT_TRUE(!hand.ball().isFree() || hand.ball().center() == hand.hip());
        }
        hand.go({ 0.2, 0.3, 0.4 }, 1.0);
        hand.rest(50);
        EXPECT_TRUE(hand.ball().isFree()) << points.size() << ' ' << raw;
        EXPECT_EQ(hand.ball().center(), hand.hip());
      }
    }
  }
}

TEST(ProxyBall, IsFiniteInACloudSmallerThanAnyHand)
{
  trial::Random random(35);
  BallInScene hand(trial::rawScene({ Vec3(0, 0, 0), Vec3(1e-12, 0, 0), Vec3(0, 1e-15, 0) }));
  for (int i = 0; i < 300; ++i)
  {
    hand.step(std::pow(10.0, random.uniform(-16, -2)) * random.direction());
    ASSERT_TRUE(trial::isFinite(hand.ball()));
  }
}

TEST(ProxyBall, SurvivesHandsThatAreFarAwayAndComeBack)
{
  trial::Random random(29);
  BallInScene hand(trial::rawScene(trial::spherePoints(8000, 0.01, random)));
  for (const double far : { 1.0, 1e3, 1e6, 1e12, 1e154, 1e200, 1e300, 1.7e308 })
  {
    for (int run = 0; run < 10; ++run)
    {
      hand.step({ 0, 0, 0.02 });
      const Vec3 direction = random.direction();
      hand.step(far * Vec3(direction.x, direction.y, std::abs(direction.z)));
      ASSERT_TRUE(trial::isFinite(hand.ball())) << far;
      hand.rest(3);
      ASSERT_TRUE(trial::isFinite(hand.ball())) << far;
      hand.step({ 0, 0, 0.02 });
      hand.rest(20);
      ASSERT_TRUE(hand.ball().isFree()) << far;
      ASSERT_EQ(hand.ball().center(), hand.hip()) << far;
      ASSERT_GT(hand.ball().radius(), 0.0);
      hand.go({ 0, 0, 0.005 }, 0.5);
      ASSERT_FALSE(hand.ball().isFree()) << far;
      ASSERT_GT(hand.ball().center().z, 0.01);
      hand.go({ 0, 0, 0.02 }, 0.5);
      ASSERT_TRUE(hand.ball().isFree()) << far;
    }
  }
}

TEST(ProxyBall, MovesWithTheModel)
{
  trial::Random random(30);
  const std::vector<Vec3> points = trial::spherePoints(8000, 0.01, random);
  // By so much that no digit of a place of the model is lost to speak of; the cells stay as they are.
  const AffineTransform shift = AffineTransform::translation({ 0.03125, -0.0625, 0.015625 });
  const AffineTransform turn = AffineTransform::rotation(37.0, { 1, 2, 3 });
  for (const AffineTransform& change : { shift, turn, shift * turn })
  {
    std::vector<Vec3> moved;
    for (const Vec3& p : points)
    {
      moved.push_back(change.apply(p));
    }
    const bool sameCells = change == shift;
    BallInScene hand(trial::rawScene(points));
    hand.step({ 0, 0, 0.013 });
    hand.go({ 0.001, 0.002, 0.008 }, 0.1);
    hand.rest(100);
    BallInScene carried = hand.copy();
    const ProxyBall before = hand.ball();
    carried.enter(trial::rawScene(moved), change, 1.0);
    const double r = hand.ball().radius();
    ASSERT_FALSE(carried.ball().isFree());
    EXPECT_EQ(carried.ball().radius(), r);
    EXPECT_LE(norm(carried.ball().center() - change.apply(hand.ball().center())), 1e-15);
    // Both measure their radius where they are.
    hand.ball().carry(AffineTransform(), 1.0);
    EXPECT_TRUE(trial::isSame(hand.ball(), before));
    hand.invalidate();
    for (int tick = 0; tick < 200; ++tick)
    {
      const Vec3 to = hand.hip() + (tick < 100 ? Vec3() : Vec3(2e-5, -1e-5, 0));
      hand.step(to);
      carried.step(change.apply(to));
      const double off = norm(carried.ball().center() - change.apply(hand.ball().center()));
      ASSERT_LE(off, (sameCells ? 1e-6 : tick < 100 ? 0.2 : 1.2) * r) << tick;
      ASSERT_FALSE(carried.ball().isFree());
    }
  }
}

TEST(ProxyBall, IsScaledWithTheModel)
{
  trial::Random random(31);
  const std::vector<Vec3> points = trial::spherePoints(8000, 0.01, random);
  const AffineTransform change = AffineTransform::scaling({ 2, 2, 2 });
  std::vector<Vec3> larger;
  for (const Vec3& p : points)
  {
    larger.push_back(2.0 * p);
  }
  BallInScene hand(trial::rawScene(points));
  hand.step({ 0, 0, 0.013 });
  hand.go({ 0.001, 0.002, 0.008 }, 0.1);
  hand.rest(100);
  BallInScene carried = hand.copy();
  carried.enter(trial::rawScene(larger), change, 2.0);
  EXPECT_EQ(carried.ball().center(), 2.0 * hand.ball().center());
  EXPECT_EQ(carried.ball().radius(), 2.0 * hand.ball().radius());
  hand.ball().carry(AffineTransform(), 1.0);
  hand.invalidate();
  hand.rest(20);
  carried.rest(20);
  EXPECT_LE(norm(carried.ball().center() - 2.0 * hand.ball().center()), 0.2 * carried.ball().radius());
  EXPECT_NEAR(carried.ball().radius(), 2.0 * hand.ball().radius(), 0.2 * carried.ball().radius());
}

TEST(ProxyBall, LooksForItsPointsAFewTimesATickWhereTheyAreCrowded)
{
  // As many as there is room for, and bumps that let it slide in many short moves.
  trial::Random random(29);
  HapticSceneInput input;
  input.points = trial::jitteredPlane(200, 0.02, 0.0, random);
  for (Vec3& point : input.points)
  {
    point.z = 1e-4 * random.uniform(-1, 1);
  }
  input.bandwidth.emplace();
  input.bandwidth->minimumRadius = 1.0e-3;
  Status status = Status::Ok;
  BallInScene hand(HapticScene::create(std::move(input), status));
  hand.step({ -0.004, 0.0, 0.002 });
  hand.go({ -0.004, 0.0, -0.0005 }, 0.05);
  const double likely = 1.1 * hand.ball().radius();
  const int near = pointsNear(hand.scene(), hand.ball().center(), likely);
  ASSERT_LT(near, BallCells::kCapacity);
  ASSERT_GT(pointsNear(hand.scene(), hand.ball().center(), 2.0 * likely), BallCells::kCapacity);
  hand.takeStatus();
  int most = 0;
  for (int i = 1; i <= 200; ++i)
  {
    const int before = hand.cells().passes();
    hand.step({ -0.004 + 4e-5 * i, 0.0, -0.0005 });
    most = std::max(most, hand.cells().passes() - before);
  }
  EXPECT_EQ(hand.takeStatus() & kProxyCellLimit, 0u);
  EXPECT_LE(most, 6);
}

TEST(ProxyBall, LooksForItsPointsAFewTimesToBegin)
{
  trial::Random random(30);
  HapticSceneInput input;
  input.points = trial::jitteredPlane(200, 0.02, 0.0, random);
  input.proxyRadii.assign(input.points.size(), 1.6e-3);
  Status status = Status::Ok;
  BallInScene hand(HapticScene::create(std::move(input), status));
  hand.step({ 0.0, 0.0, 2e-4 });
  EXPECT_FALSE(hand.ball().isFree()) << "there is no room for it";
  EXPECT_EQ(hand.takeStatus() & kProxyCellLimit, 0u);
  EXPECT_LE(hand.cells().passes(), 3);
}

TEST(ProxyBall, FindsThePlaneAndTheSphere)
{
  trial::Random random(32);
  const BallInScene plane(trial::rawScene(trial::jitteredPlane(100, 0.02, 0.0, random)));
  const BallInScene sphere(trial::rawScene(trial::spherePoints(20000, 0.01, random)));
  for (const bool flat : { true, false })
  {
    std::vector<double> off;
    std::vector<double> aside;
    for (int run = 0; run < 100; ++run)
    {
      BallInScene hand = (flat ? plane : sphere).copy();
      const Vec3 up = flat ? Vec3(0, 0, 1) : random.direction();
      const Vec3 foot = flat ? random.inBox({ -0.006, -0.006, 0 }, { 0.006, 0.006, 0 }) : 0.01 * up;
      const double depth = random.uniform(2e-4, 3e-3);
      hand.step(foot + 0.003 * up + 0.001 * random.direction());
      hand.go(foot - depth * up, random.uniform(0.02, 0.3));
      hand.rest(100);
      ASSERT_FALSE(hand.ball().isFree());
      const Vec3 found = hand.ball().nearestPoint(hand.hip());
      ASSERT_NEAR(hand.ball().depth(hand.hip()), norm(found - hand.hip()), 1e-15);
      const double r = hand.ball().radius();
      const Vec3 lean = found - foot - dot(found - foot, up) * up;
      off.push_back(std::abs(flat ? found.z : norm(found) - 0.01) / r);
      aside.push_back(norm(lean) / r);
    }
    const char* names[2][2] = { { "sphereOff", "sphereAside" }, { "planeOff", "planeAside" } };
    EXPECT_LE(trial::recorded(names[flat][0], quantile(off, 1.0)), 0.3);
    // The bumps between points hold it aside where gliding does not help.
    EXPECT_LE(quantile(aside, 0.5), 0.3);
    EXPECT_LE(trial::recorded(names[flat][1], quantile(aside, 1.0)), 1.2);
  }
}
