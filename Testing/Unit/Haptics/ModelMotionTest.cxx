#include "HapticFixtures.h"

using namespace pointhaptics;

namespace
{

/// Largest change of the force in a tick in which the hand moves by @p moved.
double largestStep(const HapticParameters& parameters, double moved)
{
  return 2.0 * parameters.contact.stiffness * moved + parameters.contact.settleRate * trial::kTick + 1e-9;
}

} // namespace

TEST(ModelMotion, KeepsItsSideWhenTheModelIsZoomedInContact)
{
  const std::vector<Vec3> points = trial::spherePoints(200000, 22);
  const trial::Scene before = trial::resampledScene(points);
  for (const double zoom : { 0.93, 0.98, 1.02, 1.2, 1.5 })
  {
    HapticParameters unlimited;
    unlimited.contact.forceLimit = INFINITY;
    Proxy proxy(unlimited);
    proxy.setScene(before.get());
    const auto states = trial::feel(proxy, trial::sphereSlide(2e-3, 0.05, 100));
    const Vec3 hip = states.back().hip;
    const trial::Scene after = trial::resampledScene(points, AffineTransform::scaling({ zoom, zoom, zoom }));
    proxy.setScene(after.get());
    Vec3 last = states.back().force;
    for (int i = 0; i < 150; ++i)
    {
      const ProxyState s = proxy.step(hip, trial::kTick);
      ASSERT_TRUE(s.contact) << zoom;
      ASSERT_GT(dot(s.normal, normalized(hip)), 0.99) << zoom;
      ASSERT_LE(norm(s.force - last), largestStep(proxy.parameters(), 0.0)) << zoom << " tick " << i;
      last = s.force;
    }
    EXPECT_NEAR(norm(last), 800.0 * (zoom * trial::kSphereRadius - norm(hip)), 1e-3) << zoom;
  }
}

TEST(ModelMotion, MeetsASurfaceThatGrowsPastAFreeHand)
{
  const std::vector<Vec3> points = trial::spherePoints(200000, 24);
  const trial::Scene before = trial::resampledScene(points);
  // The hand rests outside, at a part of the radius that the zoom passes; in one step or in many.
  const Vec3 hip = 1.1 * trial::kSphereRadius * normalized({ 1, -0.5, 0.7 });
  for (const int steps : { 1, 7 })
  {
    Proxy proxy;
    proxy.setScene(before.get());
    ASSERT_FALSE(trial::feel(proxy, trial::Path(5, hip)).back().contact);
    trial::Scene keep = before;
    Vec3 last;
    for (int i = 1; i <= steps; ++i)
    {
      const double zoom = 1.0 + 0.2 * i / steps;
      const trial::Scene next = trial::resampledScene(points, AffineTransform::scaling({ zoom, zoom, zoom }));
      proxy.setScene(next.get());
      const ProxyState s = proxy.step(hip, trial::kTick);
      ASSERT_LE(norm(s.force - last), largestStep(proxy.parameters(), 0.0)) << "zoom " << zoom;
      last = s.force;
      keep = next;
    }
    const ProxyState s = trial::feel(proxy, trial::Path(100, hip)).back();
    ASSERT_TRUE(s.contact) << steps;
    EXPECT_NEAR(norm(s.force), 800.0 * 0.1 * trial::kSphereRadius, 1e-3);
    EXPECT_GT(dot(s.force, hip), 0.0) << "pushed out, the way it came from";
  }
}

TEST(ModelMotion, ZoomsByAnyFactorStepNoFurtherThanTheSettleRate)
{
  const std::vector<Vec3> points = trial::spherePoints(60000, 26);
  Proxy proxy;
  trial::Scene keep = trial::resampledScene(points);
  proxy.setScene(keep.get());
  const auto states = trial::feel(proxy, trial::sphereSlide(1e-3, 0.05, 50));
  const Vec3 hip = states.back().hip;
  Vec3 last = states.back().force;
  for (const double zoom : { 1000.0, 1.0, 0.001, 3.0, 0.5, 1.0 })
  {
    const double voxel = zoom > 100.0 ? 0.3 : zoom < 0.01 ? 1e-6 : trial::kVoxel;
    const trial::Scene next =
      trial::resampledScene(points, AffineTransform::scaling({ zoom, zoom, zoom }), voxel);
    proxy.setScene(next.get());
    for (int i = 0; i < 40; ++i)
    {
      const ProxyState s = proxy.step(hip, trial::kTick);
      ASSERT_TRUE(trial::isFinite(s)) << zoom;
      // A model that shrinks away from the hand lets go at once.
      ASSERT_LE(norm(s.force - (s.contact ? last : Vec3())), largestStep(proxy.parameters(), 0.0) * s.contact)
        << zoom << " tick " << i;
      last = s.force;
    }
    keep = next;
  }
}

TEST(ModelMotion, LetsGoAtOnceWhereTheHandSlidesOffAnEdgeMeanwhile)
{
  // A model that turns, shifts and grows keeps the offset settling all the time, at the rate of the force.
  const trial::Scene scene = trial::resampledScene(trial::planePoints(60000, 8));
  const AffineTransform turn = AffineTransform::rotation(1e-3, { 0, 0, 1 });
  const AffineTransform shift = AffineTransform::translation({ 0, 0, 2e-4 });
  const AffineTransform grow = AffineTransform::scaling({ 1 + 1e-5, 1 + 1e-5, 1 + 1e-5 });
  for (const ProxyMethod method : { ProxyMethod::SurfaceFit, ProxyMethod::Sphere })
  {
    for (const AffineTransform& change : { turn, shift, grow })
    {
      HapticParameters parameters;
      parameters.method = method;
      Proxy proxy(parameters);
      proxy.setScene(scene.get());
      AffineTransform transform;
      trial::Scene keep = scene;
      int changes = 0;
      bool released = false;
      for (const Vec3& hip : trial::planeSlide(1e-3, 0.3, 200))
      {
        trial::Scene next = keep;
        if (hip.x > 0.02 && changes++ < 40)
        {
          Status status = Status::Ok;
          transform = change * transform;
          next = scene->moved(transform, status);
          ASSERT_EQ(status, Status::Ok);
          // Whoever changes the stiffness of all moments changes it in that of the release, too.
          parameters.contact.stiffness += 1.0;
          proxy.setParameters(parameters);
        }
        proxy.setScene(next.get());
        const ProxyState state = proxy.step(hip, trial::kTick);
        keep = next;
        const double outside = transform.inverse().apply(hip).x - 0.03;
        ASSERT_TRUE(outside < 5e-4 || norm(state.force) == 0.0) << outside << ' ' << norm(state.force);
        ASSERT_TRUE(!released || norm(state.force) == 0.0) << "there was none the tick before";
        released = released || (outside > 0.0 && !state.contact);
      }
      EXPECT_TRUE(released);
      EXPECT_GT(changes, 30);
    }
  }
}
