/// The ball that goes with the foot of the fit, over the bumps between points.
#include "BallFixtures.h"

#include "Haptics/Contact/SurfaceFitProxy.h"

using namespace pointhaptics;

namespace
{

/// A hand, and how its ball moved.
class Hand
{
public:
  explicit Hand(trial::Scene scene)
    : scene_(std::move(scene))
    , memory_(new SurfaceFitProxy::Memory(InstructionSet::Automatic))
  {
  }
  void step(const Vec3& hip)
  {
    before_ = proxy_.ball();
    state_ = ProxyState();
    state_.hip = hip;
    proxy_.step(*scene_, *memory_, ContactParameters(), hip, true, state_);
  }
  bool rode() const { return !before_.isFree() && !ball().isFree() && ball().hasRidden(); }
  /// How deep the ball covers a point now, and did on its way when it rode, over its radius.
  double deepest() const
  {
    double result = double(trial::deepestOnWay(*scene_, ball().center(), ball().center(), ball().scale()));
    if (rode())
    {
      const Vec3 up = proxy_.fit()->normal();
      const Vec3 above = before_.center() + std::max(0.0, dot(ball().center() - before_.center(), up)) * up;
      for (const auto& leg : { std::pair{ before_.center(), above }, { above, ball().center() } })
      {
        const trial::Real on = trial::deepestOnWay(*scene_, leg.first, leg.second, ball().scale());
        result = std::max(result, double(on));
      }
    }
    return result;
  }
  const ProxyBall& ball() const { return proxy_.ball(); }
  const ProxyState& state() const { return state_; }

private:
  trial::Scene scene_;
  std::unique_ptr<SurfaceFitProxy::Memory> memory_;
  SurfaceFitProxy proxy_;
  ProxyBall before_;
  ProxyState state_;
};

}

TEST(BallRide, GoesOverSmoothSurfacesAndCoversNoPoint)
{
  trial::Random random(71);
  const std::vector<Vec3> clouds[] = { trial::spherePoints(trial::kPaperSmall, 5),
    trial::torusPoints(trial::kPaperSmall, 6) };
  for (const std::vector<Vec3>& points : clouds)
  {
    for (const bool isRaw : { true, false })
    {
      Hand hand(isRaw ? trial::rawScene(points) : trial::resampledScene(points));
      // From outside through the whole shape, askew: along its surface for most of the way.
      Vec3 hip(0.036, 0.002, 0.003);
      Vec3 velocity(-2e-5, 0, 0);
      int contacts = 0;
      int rides = 0;
      for (int tick = 0; tick < 8000; ++tick)
      {
        // The hand wanders about a place 1 mm deep under where it is on the shape.
        const Vec3 pull = 0.002 * (hand.state().proxy - 1.25e-3 * hand.state().normal - hip);
        velocity = 0.98 * velocity + (tick < 500 ? Vec3() : pull + 1.5e-5 * random.direction());
        hip += tick < 500 ? Vec3(-2.4e-5, 0, 0) : velocity;
        hand.step(hip);
        ASSERT_LE(hand.deepest(), 1e-8) << tick;
        contacts += hand.state().contact;
        rides += hand.state().contact && hand.rode();
      }
      EXPECT_GT(contacts, 4000);
      EXPECT_GT(trial::recorded("ridesShare", double(rides) / contacts), 0.75);
    }
  }
}

TEST(BallRide, EndsAtAWall)
{
  constexpr double kSpacing = 2e-4;
  trial::Random random(72);
  std::vector<Vec3> points = trial::jitteredPlane(100, 100 * kSpacing, 0.0, random);
  for (const Vec3& p : trial::jitteredPlane(100, 100 * kSpacing, 0.0, random))
  {
    if (p.x > 2.0 * kSpacing)
    {
      points.emplace_back(p.z, p.y, p.x);
    }
  }
  Hand hand(trial::rawScene(points));
  int rides = 0;
  int beside = 0; // ticks that press into the wall with a contact point that is off it
  for (int tick = 0; tick < 700; ++tick)
  {
    const double in = std::min(1.0, tick / 200.0);
    hand.step({ -6e-3 + std::max(0, tick - 200) * 2e-5, 1e-3, 1e-3 - 2e-3 * in });
    ASSERT_LE(hand.deepest(), 1e-8) << tick;
    ASSERT_LT(hand.ball().center().x, tick < 100 ? 1.0 : 0.0) << tick;
    rides += hand.rode();
    beside += tick >= 550 && std::abs(hand.state().proxy.x) > kSpacing;
  }
  EXPECT_GT(rides, 100);
  EXPECT_TRUE(hand.state().contact);
  EXPECT_LT(trial::recorded("besideTheWall", beside), 30) << "of 150, where the fit takes the floor's point";
}

TEST(BallRide, LeavesPointsAboveTheSurfaceOutsideOnTheWayToo)
{
  constexpr double kSpacing = 2e-4;
  trial::Random random(74);
  std::vector<Vec3> points = trial::jitteredPlane(100, 100 * kSpacing, 0.0, random);
  for (int i = 0; i < 150; ++i)
  {
    points.emplace_back(
      1e-2 * random.uniform(-1, 1), 1e-2 * random.uniform(-1, 1), random.uniform(6e-4, 1e-3));
  }
  Hand hand(trial::rawScene(points));
  Vec3 hip(0, 0, 2e-3);
  Vec3 velocity(1.2e-4, 5e-5, 0);
  int rides = 0;
  for (int tick = 0; tick < 20000; ++tick)
  {
    velocity.x = std::abs(hip.x) > 9e-3 ? -std::copysign(velocity.x, hip.x) : velocity.x;
    velocity.y = std::abs(hip.y) > 9e-3 ? -std::copysign(velocity.y, hip.y) : velocity.y;
    hip += velocity;
    hip.z = std::max(-1e-3, hip.z - 2e-5);
    hand.step(hip);
    ASSERT_LE(hand.deepest(), 1e-8) << tick;
    rides += hand.rode();
  }
  EXPECT_GT(rides, 500);
}

TEST(BallRide, GrowsBeforeThePointsAreSparse)
{
  constexpr double kFine = 1e-4;
  constexpr double kCoarse = 4e-4;
  trial::Random random(73);
  std::vector<Vec3> points;
  for (const double spacing : { kFine, kCoarse })
  {
    const int n = int(0.02 / spacing);
    for (const Vec3& p : trial::jitteredPlane(n, 0.02, 0.0, random))
    {
      if ((p.x < 0.0) == (spacing == kFine))
      {
        points.push_back(p);
      }
    }
  }
  for (const double speed : { 2e-5, 5e-5 })
  {
    Hand hand(trial::rawScene(points));
    int rides = 0;
    for (int tick = 0; tick < 100 + int(1.2e-2 / speed); ++tick)
    {
      const double x = -6e-3 + std::max(0, tick - 100) * speed;
      hand.step({ x, 1e-3, 1e-3 - 2e-5 * std::min(tick, 100) });
      ASSERT_LE(hand.deepest(), 1e-8) << tick;
      ASSERT_GT(hand.ball().center().z, 0.0) << x;
      rides += hand.rode();
      if (x > 2e-3)
      {
        ASSERT_GT(hand.ball().radius(), 0.8 * 2.4 * kCoarse) << x;
      }
    }
    EXPECT_GT(rides, 50);
  }
}

/// A ball sinks further between the points of a random sample than the hand presses here. Where the points
/// lie to one side of the foot by chance the contact must not end, as it does at a rim.
TEST(BallRide, KeepsALightPressOnARandomSample)
{
  for (const double depth : { 5e-5, 1e-4, 2e-4, 4e-4 })
  {
    Hand hand(trial::resampledScene(trial::spherePoints(18500, 75)));
    for (int tick = 0; tick < 6000; ++tick)
    {
      const double angle = 2e-3 * std::max(0, tick - 100);
      const double height = std::max(0.0, 1e-3 * (1.0 - tick / 100.0)) - depth;
      const Vec3 hip = (trial::kSphereRadius + height) *
        Vec3(std::cos(angle), std::sin(angle) * std::cos(1.0 + 0.1 * angle),
          std::sin(angle) * std::sin(1.0 + 0.1 * angle));
      hand.step(hip);
      if (tick > 100)
      {
        ASSERT_TRUE(hand.state().contact) << depth << " at tick " << tick;
        ASSERT_NEAR(norm(hand.state().proxy - hip), depth, 0.02 * depth) << "at tick " << tick;
      }
    }
  }
}
