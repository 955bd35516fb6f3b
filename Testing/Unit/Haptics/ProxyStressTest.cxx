#include "HapticFixtures.h"

using namespace pointhaptics;

namespace
{

/// Clouds nobody would choose: blobs, crossing and nearly touching sheets, lines, repeated points, shells
/// with noise, each at its own density.
std::vector<Vec3> randomCloud(trial::Random& random)
{
  std::vector<Vec3> points;
  const int parts = 1 + int(random.below(4));
  for (int part = 0; part < parts; ++part)
  {
    const int n = 20 << random.below(9);
    const Vec3 at = random.inBox({ -0.01, -0.01, -0.01 }, { 0.01, 0.01, 0.01 });
    const Vec3 normal = random.direction();
    const Vec3 a = anyPerpendicular(normal);
    const Vec3 b = cross(normal, a);
    const double size = random.uniform(0.002, 0.02);
    const double noise = random.below(2) == 0 ? 0.0 : random.uniform(0.0, 5e-4);
    const std::size_t kind = random.below(5);
    for (int i = 0; i < n; ++i)
    {
      const double u = size * random.uniform(-1, 1);
      const double v = size * random.uniform(-1, 1);
      const Vec3 away = noise * random.normal() * normal;
      points.push_back(kind == 0 ? at + away + u * a + v * b
          : kind == 1            ? at + away + u * a
          : kind == 2            ? at + size * random.direction() + noise * random.direction()
          : kind == 3            ? at + random.inBox({ -size, -size, -size }, { size, size, size })
                                 : at);
    }
  }
  return points;
}

/// One move of a hand: still, slow, fast, far away, or no number at all.
Vec3 randomMove(trial::Random& random, const Vec3& hip, Vec3& velocity)
{
  switch (random.below(200))
  {
    case 0:
      return random.inBox({ -0.03, -0.03, -0.03 }, { 0.03, 0.03, 0.03 });
    case 1:
      return 1000.0 * random.direction();
    case 2:
      return { NAN, hip.y, hip.z };
    case 3:
      velocity = std::pow(10.0, random.uniform(-8, -2)) * random.direction();
      return hip;
    default:
      break;
  }
  // A weak pull keeps the hand about the cloud.
  velocity += 1e-6 * random.direction() - 2e-5 * hip;
  return hip + velocity;
}

} // namespace

TEST(ProxyStress, KeepsEveryPromiseOnRandomCloudsUnderRandomHands)
{
  constexpr int kTicksPerCloud = 2500;
  trial::Random random(99);
  HapticParameters parameters;
  int contacts = 0;
  for (int done = 0; done < trial::stressTicks(); done += kTicksPerCloud)
  {
    const std::vector<Vec3> points = randomCloud(random);
    const bool raw = random.below(2) == 0;
    const trial::Scene scene = raw ? trial::rawScene(points) : trial::resampledScene(points);
    parameters.contact.staticFriction = random.below(2) == 0 ? 0.0 : 0.5;
    parameters.contact.dynamicFriction = 0.6 * parameters.contact.staticFriction;
    Proxy proxy(parameters);
    proxy.setScene(scene.get());
    Vec3 hip = 0.02 * random.direction();
    Vec3 lastHip = hip;
    Vec3 velocity = -1e-4 * normalized(hip);
    Vec3 lastForce;
    for (int tick = 0; tick < kTicksPerCloud; ++tick)
    {
      const Vec3 asked = randomMove(random, hip, velocity);
      const ProxyState s = proxy.step(asked, trial::kTick);
      SCOPED_TRACE(done + tick);
      ASSERT_TRUE(trial::isFinite(s));
      ASSERT_NEAR(norm(s.normal), 1.0, 1e-9);
      contacts += s.contact;
      if (!isFinite(asked))
      {
        ASSERT_TRUE(s.status & kProxyNonFiniteInput);
        ASSERT_LE(norm(s.force), norm(lastForce) + 1e-12);
        lastForce = s.force;
        continue;
      }
      ASSERT_EQ(s.hip, asked);
      ASSERT_GT(s.radius, 0.0);
      if (!s.contact)
      {
        ASSERT_EQ(s.proxy, asked);
        ASSERT_EQ(s.force, Vec3());
      }
      ASSERT_LE(norm(s.force), 8.0 * (1.0 + 1e-12));
      const double spring = 800.0 * norm(s.proxy - asked);
      ASSERT_TRUE(spring > 8.0 || norm(s.force - 800.0 * (s.proxy - asked)) <= 1e-9 * (1.0 + norm(s.force)));
      // The hand's way since the last tick that had one; letting go is never delayed.
      const double steps = s.status & kProxyEnergyLimit ? 3.0 : 2.0;
      const double steepest = spring > 8.0 ? 1.5 : 1.0; // the fade
      const double allowed =
        steepest * (steps * 800.0 * norm(asked - lastHip) + parameters.contact.settleRate * trial::kTick);
      ASSERT_TRUE(!s.contact || norm(s.force - lastForce) <= allowed * (1.0 + 1e-9) + 1e-9);
      lastForce = s.force;
      hip = norm(asked) < 1.0 ? asked : hip;
      lastHip = asked;
    }
  }
  EXPECT_GT(contacts, trial::stressTicks() / 100) << "the hand meets something";
}
