/// No hand is held: force limit, fade, break-away, and no energy from nothing.
#include "Haptics/ContactEnergy.h"
#include "Haptics/ContactSpring.h"

#include "Unit/Haptics/HapticFixtures.h"
#include "Unit/Haptics/ServoLoopFixtures.h"

#include <cmath>

using namespace pointhaptics;

namespace
{

constexpr ProxyMethod kMethods[] = { ProxyMethod::SurfaceFit, ProxyMethod::Sphere,
  ProxyMethod::GradientSteps };

HapticParameters withLimit(ProxyMethod method, double forceLimit)
{
  HapticParameters parameters;
  parameters.method = method;
  parameters.contact.forceLimit = forceLimit;
  return parameters;
}

void moveTo(trial::Path& path, const Vec3& to, double speed)
{
  const Vec3 from = path.back();
  const int ticks = int(std::ceil(norm(to - from) / (speed * trial::kTick)));
  for (int i = 1; i <= ticks; ++i)
  {
    path.push_back(from + (double(i) / ticks) * (to - from));
  }
}

/// A hand in a closed sphere of radius 25 mm: from above to @p depth, and back.
trial::Path pressAndBack(double depth)
{
  trial::Path path = { Vec3(0, 0, 0.028) };
  moveTo(path, Vec3(0, 0, 0.025 - depth), 0.1);
  moveTo(path, Vec3(0, 0, 0.028), 0.1);
  return path;
}

/// Energy that a way gave to the hand, by the trapezoid rule, joule.
double energyOf(const std::vector<ProxyState>& states)
{
  double energy = 0.0;
  for (std::size_t i = 1; i < states.size(); ++i)
  {
    energy += 0.5 * dot(states[i].force + states[i - 1].force, states[i].hip - states[i - 1].hip);
  }
  return energy;
}

} // namespace

TEST(ContactSpring, IsPlainThenConstantThenGone)
{
  const ContactSpring spring(800.0, 8.0);
  EXPECT_EQ(spring.part(0.00999), 1.0);
  EXPECT_NEAR(800.0 * 0.015 * spring.part(0.015), 8.0, 1e-12);
  EXPECT_NEAR(800.0 * 0.020 * spring.part(0.020), 8.0, 1e-12);
  EXPECT_NEAR(800.0 * 0.025 * spring.part(0.025), 4.0, 1e-12);
  EXPECT_EQ(spring.part(0.030), 0.0);
  EXPECT_DOUBLE_EQ(spring.end(), 0.030);
  EXPECT_DOUBLE_EQ(ContactSpring(3200.0, 8.0).end(), 0.015) << "at least 5 mm";
  EXPECT_DOUBLE_EQ(ContactSpring(100.0, 8.0).end(), 0.045) << "at most 15 mm";
  EXPECT_DOUBLE_EQ(ContactSpring(0.0, 8.0).end(), 0.045);
  EXPECT_EQ(ContactSpring(800.0, INFINITY).part(1.0), 1.0);
}

TEST(ContactEnergy, NeverStoresMoreThanTheHandPutIn)
{
  ContactEnergy energy;
  // A surface appears 1 mm above a hand that rests.
  const Vec3 force(0, 0, 0.8);
  const double part = energy.part(Vec3(), force, Vec3(), 800.0);
  EXPECT_NEAR(0.5 * part * part * 0.64 / 800.0, ContactEnergy::kSlack, 1e-12);
  // A hand that presses in from the surface itself is not touched.
  EXPECT_EQ(energy.part(Vec3(), force, Vec3(0, 0, -1e-3), 800.0), 1.0);
  energy.allow(force, 800.0);
  EXPECT_EQ(energy.part(force, force, Vec3(), 800.0), 1.0) << "the model moved";
}

TEST(BreakAway, NoHandIsHeldWhateverTheMethod)
{
  const trial::Scene plane = trial::resampledScene(trial::planePoints(100000, 7));
  for (const ProxyMethod method : kMethods)
  {
    SCOPED_TRACE(int(method));
    Proxy proxy(withLimit(method, 8.0));
    proxy.setScene(plane.get());
    trial::Path path = { Vec3(0.001, 0.002, 0.005) };
    moveTo(path, Vec3(0.001, 0.002, -0.035), 0.1);
    const auto pressed = trial::feel(proxy, path);
    double most = 0.0;
    for (const ProxyState& state : pressed)
    {
      most = std::max(most, norm(state.force));
    }
    EXPECT_LE(most, 8.0);
    EXPECT_GT(most, 7.99);
    const auto rest = trial::feel(proxy, trial::Path(200, path.back()));
    EXPECT_FALSE(rest.back().contact);
    EXPECT_EQ(rest.back().force, Vec3());
    EXPECT_NE(rest.back().status & kProxyLetGo, 0u) << "it is said";
    // The way out is free. A new contact from the side it was touched on ends what is said.
    trial::Path out = { path.back() };
    moveTo(out, Vec3(0.004, 0.002, 0.040), 0.1);
    for (const ProxyState& state : trial::feel(proxy, out))
    {
      ASSERT_LT(norm(state.force), 0.05) << state.hip.z;
    }
    trial::Path back = { out.back() };
    moveTo(back, Vec3(0.001, 0.002, -0.002), 0.1);
    const ProxyState again = trial::feel(proxy, back).back();
    EXPECT_TRUE(again.contact);
    EXPECT_GT(again.force.z, 1.0);
    EXPECT_EQ(again.status & kProxyLetGo, 0u);
  }
}

TEST(BreakAway, TheFarSideOfAThickPartIsFeltByAHandThatCameThrough)
{
  std::vector<Vec3> points = trial::planePoints(60000, 7);
  const std::size_t size = points.size();
  for (std::size_t i = 0; i < size; ++i)
  {
    points.push_back(points[i] - Vec3(0, 0, 0.012));
  }
  const trial::Scene plate = trial::resampledScene(points);
  Proxy proxy(withLimit(ProxyMethod::SurfaceFit, 8.0));
  proxy.setScene(plate.get());
  trial::Path path = { Vec3(0.001, 0.002, 0.005) };
  moveTo(path, Vec3(0.001, 0.002, -0.045), 0.1);
  EXPECT_NE(trial::feel(proxy, path).back().status & kProxyLetGo, 0u);
  trial::Path back = { path.back() };
  moveTo(back, Vec3(0.001, 0.002, -0.010), 0.1);
  EXPECT_LT(trial::feel(proxy, back).back().force.z, -1.0) << "2 mm into it from below";
}

TEST(BreakAway, AHandThatComesBackFindsAllAsItLeftIt)
{
  const trial::Scene sphere = trial::resampledScene(trial::spherePoints(200000, 8));
  for (const double depth : { 0.008, 0.020 })
  {
    const trial::Path path = pressAndBack(depth);
    const auto limited = trial::feel(sphere, withLimit(ProxyMethod::SurfaceFit, 8.0), path);
    const auto plain = trial::feel(sphere, withLimit(ProxyMethod::SurfaceFit, INFINITY), path);
    for (std::size_t i = 0; i < path.size(); ++i)
    {
      ASSERT_EQ(limited[i].proxy, plain[i].proxy) << i;
      ASSERT_EQ(limited[i].normal, plain[i].normal) << i;
      ASSERT_LE(norm(limited[i].force), 8.0) << i;
      ASSERT_TRUE(norm(plain[i].force) > 8.0 || limited[i].force == plain[i].force) << i;
    }
  }
}

TEST(BreakAway, EndsWithoutAForceWhereTheSpringIsSoft)
{
  const trial::Scene plane = trial::resampledScene(trial::planePoints(100000, 7));
  HapticParameters parameters;
  parameters.contact.stiffness = 200.0;
  Proxy proxy(parameters);
  proxy.setScene(plane.get());
  trial::Path path = { Vec3(0.001, 0.002, 0.005) };
  moveTo(path, Vec3(0.001, 0.002, -0.060), 0.1);
  double last = 0.0;
  bool isLetGo = false;
  for (const ProxyState& state : trial::feel(proxy, path))
  {
    if ((state.status & kProxyLetGo) != 0u && !isLetGo)
    {
      EXPECT_LT(last, 0.05);
      isLetGo = true;
    }
    last = norm(state.force);
  }
  EXPECT_TRUE(isLetGo);
}

TEST(BreakAway, AServoLoopRefusesAPortThatDeclaresNoForce)
{
  for (const double declared : { 0.0, -1.0, double(NAN) })
  {
    trial::ScriptedPort port;
    port.bounds.maximumForce = declared;
    ServoLoop loop;
    EXPECT_EQ(loop.start(port, HapticParameters(), trial::plainSettings()), Status::InvalidParameter)
      << declared;
  }
}

TEST(BreakAway, ClosedPathsInScatterGiveNoEnergy)
{
  trial::Random random(10);
  std::vector<Vec3> points;
  for (int i = 0; i < 20000; ++i)
  {
    points.push_back(random.inBox({ -0.04, -0.04, -0.04 }, { 0.04, 0.04, 0.04 }));
  }
  const trial::Scene fog = trial::resampledScene(points);
  double most = 0.0;
  int limited = 0;
  for (int run = 0; run < 20; ++run)
  {
    trial::Path path = { 0.02 * random.direction() };
    for (int leg = 0; leg < 8; ++leg)
    {
      moveTo(path, path.back() + 4e-3 * random.direction(), 0.05);
    }
    const trial::Path way = path;
    path.insert(path.end(), way.rbegin(), way.rend());
    const std::vector<ProxyState> states = trial::feel(fog, HapticParameters(), path);
    most = std::max(most, energyOf(states));
    for (const ProxyState& state : states)
    {
      limited += (state.status & kProxyEnergyLimit) != 0u;
    }
  }
  EXPECT_GT(trial::recorded("limitedTicksInFog", limited), 50)
    << "the hand touches points, and the limit speaks";
  EXPECT_LT(trial::recorded("energyInFog", most), 0.2e-3);
}

TEST(BreakAway, NoHandAtTheRimOfANoisySheetIsPushedFromBehind)
{
  constexpr double kHalf = 0.03;
  trial::Random random(7);
  std::vector<Vec3> points;
  for (int i = 0; i < 20000; ++i)
  {
    const Vec3 place = random.inBox({ -kHalf, -kHalf, 0.0 }, { kHalf, kHalf, 0.0 });
    points.push_back(place + Vec3(0.0, 0.0, 3e-4 * random.normal()));
  }
  const trial::Scene sheet = trial::resampledScene(points);
  for (int hand = 0; hand < 24; ++hand)
  {
    const double side = hand % 2 == 0 ? 1.0 : -1.0;
    const double x = kHalf - random.uniform(0.5e-3, 3e-3);
    const double y = random.uniform(-0.02, 0.02);
    trial::Path path = { { x, y, 4e-3 * side } };
    moveTo(path, { x, y, -0.85e-3 * side }, 0.025);
    path.insert(path.end(), 500, path.back());
    moveTo(path, { x, y, 4e-3 * side }, 0.025);
    for (const ProxyState& state : trial::feel(sheet, HapticParameters(), path))
    {
      ASSERT_GT(side * state.force.z, -0.2) << hand << ' ' << state.hip.z;
    }
  }
}
