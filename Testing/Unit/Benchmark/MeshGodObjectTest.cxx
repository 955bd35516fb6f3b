/// The god object on a mesh is the truth of `bench touch`: it is held against closed forms here.
#include "Benchmark/Touch/Methods/MeshGodObject.h"
#include "Benchmark/Touch/TouchJudge.h"
#include "Benchmark/Touch/TouchStrokes.h"
#include "Shapes/PortableRandom.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{

using namespace pointhaptics;
using namespace pointhaptics::bench::touch;

constexpr double kExact = 1e-12;

bool always(int, int, int)
{
  return true;
}

TouchMesh boxOf(double half)
{
  return blockMesh({ -half, half }, { -half, half }, { -half, half }, always);
}

/// Follows @p path with @p steps steps between its places.
GodObjectState follow(MeshGodObject& object, const std::vector<Vec3>& path, int steps = 100)
{
  GodObjectState state = object.step(path.front());
  for (std::size_t i = 1; i < path.size(); ++i)
  {
    for (int k = 1; k <= steps; ++k)
    {
      state = object.step(path[i - 1] + (double(k) / steps) * (path[i] - path[i - 1]));
    }
  }
  return state;
}

void expectPoint(const GodObjectState& state, const Vec3& point, double tolerance = kExact)
{
  EXPECT_TRUE(state.contact);
  EXPECT_LE(norm(state.point - point), tolerance)
    << state.point.x << ' ' << state.point.y << ' ' << state.point.z;
}

TEST(MeshGodObject, StaysOnTheFlatFaceOfABoxAboveTheHip)
{
  const TriangleTree tree(boxOf(0.025));
  MeshGodObject object(tree);
  EXPECT_FALSE(object.step({ 0.001, 0.002, 0.027 }).contact);
  expectPoint(object.step({ 0.001, 0.002, 0.024 }), { 0.001, 0.002, 0.025 });
  expectPoint(object.step({ 0.011, -0.012, 0.022 }), { 0.011, -0.012, 0.025 });
  const GodObjectState state = object.step({ -0.02, -0.01, 0.0249 });
  expectPoint(state, { -0.02, -0.01, 0.025 });
  EXPECT_EQ(state.planes, 1);
  EXPECT_DOUBLE_EQ(state.normals[0].z, 1.0);
  EXPECT_FALSE(object.step({ -0.02, -0.01, 0.02501 }).contact);
}

TEST(MeshGodObject, LetsGoWhereTheHipPassesThePlaneBesideTheEdge)
{
  const TriangleTree tree(boxOf(0.025));
  for (const double depth : { 1e-4, 1e-3, 5e-3 })
  {
    MeshGodObject object(tree);
    follow(object, { { 0.02, 0.003, 0.027 }, { 0.02, 0.003, 0.025 - depth } });
    expectPoint(object.step({ 0.025 - 1e-6, 0.003, 0.025 - depth }), { 0.025 - 1e-6, 0.003, 0.025 });
    const Vec3 outside{ 0.025 + 1e-6, 0.003, 0.025 - depth };
    const GodObjectState state = object.step(outside);
    EXPECT_FALSE(state.contact);
    EXPECT_EQ(state.point, outside);
  }
}

TEST(MeshGodObject, IsTheNearestPointOfASphereUpToItsFacets)
{
  const double radius = 0.025;
  const int rings = 200;
  const TriangleTree tree(sphereMesh(radius, rings));
  // Facets lie below the sphere by up to their sagitta, and lean by about their angle.
  const double angle = 3.14159265 / rings;
  MeshGodObject object(tree);
  follow(object, { { 0.0, 0.001, 0.027 }, { 0.0, 0.001, 0.024 } });
  detail::PortableRandom random(3);
  Vec3 along = { 0.0, 0.0, 1.0 };
  for (int i = 0; i < 2000; ++i)
  {
    along = normalized(along + 0.004 * random.sphere() + Vec3(0.002, 0.001, 0.0));
    const double depth = 1e-3;
    const GodObjectState state = object.step((radius - depth) * along);
    ASSERT_TRUE(state.contact) << i;
    ASSERT_LE(radius - norm(state.point), radius * angle * angle) << i;
    ASSERT_LE(norm(state.point - radius * along), depth * 1.5 * angle + radius * angle * angle) << i;
  }
}

TEST(MeshGodObject, IsHeldByTwoPlanesInAStepAndByThreeInACorner)
{
  // An L in x and y and z: a concave edge along y at x = 0, z = 0, closed by a wall at y = 0.01.
  const TouchMesh mesh = blockMesh({ -0.03, 0.0, 0.03 }, { -0.03, 0.01, 0.03 }, { -0.02, 0.0, 0.02 },
    [](int x, int y, int z) { return z == 0 || x == 0 || y == 1; });
  const TriangleTree tree(mesh);
  MeshGodObject object(tree);
  GodObjectState state =
    follow(object, { { 0.01, 0.0, 0.01 }, { 0.01, 0.0, -0.001 }, { -0.002, 0.0, -0.001 } });
  expectPoint(state, { 0.0, 0.0, 0.0 });
  EXPECT_EQ(state.planes, 2);
  state = follow(object, { { -0.002, 0.0, -0.001 }, { -0.002, 0.0135, -0.001 } });
  expectPoint(state, { 0.0, 0.01, 0.0 });
  EXPECT_EQ(state.planes, 3);
  state = follow(object, { { -0.002, 0.0135, -0.001 }, { 0.004, 0.0135, 0.003 } });
  expectPoint(state, { 0.004, 0.01, 0.003 });
  EXPECT_EQ(state.planes, 1);
}

TEST(MeshGodObject, NeverPassesThroughAThinPlate)
{
  const TriangleTree tree(blockMesh({ -0.03, 0.03 }, { -0.03, 0.03 }, { -5e-5, 5e-5 }, always));
  detail::PortableRandom random(9);
  MeshGodObject object(tree);
  object.step({ 0.0, 0.0, 0.01 });
  for (int i = 0; i < 5000; ++i)
  {
    const Vec3 hip{ random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.002) };
    const GodObjectState state = object.step(hip);
    ASSERT_EQ(state.contact, hip.z < 5e-5) << i;
    ASSERT_LE(norm(state.point - Vec3(hip.x, hip.y, std::max(hip.z, 5e-5))), kExact) << i;
  }
}

TEST(MeshGodObject, GoesThroughAHoleOnlyWhereItIs)
{
  const TriangleTree tree(blockMesh({ -0.03, -0.005, 0.005, 0.03 }, { -0.03, -0.005, 0.005, 0.03 },
    { -0.002, 0.0 }, [](int x, int y, int) { return x != 1 || y != 1; }));
  MeshGodObject object(tree);
  follow(object, { { -0.01, 0.0, 0.002 }, { -0.01, 0.0, -0.001 } });
  expectPoint(object.step({ -0.005001, 0.0, -0.001 }), { -0.005001, 0.0, 0.0 });
  EXPECT_FALSE(object.step({ -0.0049, 0.0, -0.001 }).contact);
  EXPECT_FALSE(follow(object, { { -0.0049, 0.0, -0.001 }, { 0.0, 0.0, -0.005 } }).contact);
  // From below, and against the wall of the hole.
  expectPoint(follow(object, { { 0.0, 0.0, -0.005 }, { 0.01, 0.0, -0.005 }, { 0.01, 0.0, -0.0015 } }),
    { 0.01, 0.0, -0.002 });
  follow(object, { { 0.01, 0.0, -0.003 }, { 0.0, 0.0, -0.003 }, { 0.0, 0.0, -0.001 } });
  expectPoint(follow(object, { { 0.0, 0.0, -0.001 }, { 0.007, 0.0, -0.001 } }), { 0.005, 0.0, -0.001 });
}

TEST(MeshGodObject, NeverMovesAwayFromTheHipWithinAStep)
{
  TouchMesh mesh = generatedMesh("gear");
  const TriangleTree tree(mesh);
  detail::PortableRandom random(4);
  MeshGodObject object(tree);
  Vec3 hip{ 0.0, 0.0, 0.05 };
  Vec3 last = object.step(hip).point;
  for (int i = 0; i < 20000; ++i)
  {
    hip += 3e-4 * random.sphere() - (1e-5 * norm(hip) / 0.02) * normalized(hip);
    const GodObjectState state = object.step(hip);
    ASSERT_LE(norm(state.point - hip), norm(last - hip) + 1e-6) << i;
    ASSERT_TRUE(state.contact || state.point == hip) << i;
    last = state.point;
  }
}

TEST(TouchMesh, GeneratedMeshesAreClosedAndOutward)
{
  for (const std::string& name : generatedMeshNames())
  {
    TouchMesh mesh = generatedMesh(name);
    ASSERT_FALSE(mesh.triangles.empty()) << name;
    Vec3 sum;
    double volume = 0.0;
    for (std::size_t i = 0; i < mesh.triangles.size(); i += 3)
    {
      const Vec3& a = mesh.points[mesh.triangles[i]];
      const Vec3& b = mesh.points[mesh.triangles[i + 1]];
      const Vec3& c = mesh.points[mesh.triangles[i + 2]];
      sum += cross(b - a, c - a);
      volume += dot(a, cross(b, c)) / 6.0;
    }
    EXPECT_LE(norm(sum), 1e-15) << name;
    EXPECT_GT(volume, 3e-6) << name;
    const std::vector<std::uint32_t> before = mesh.triangles;
    orientOutward(mesh);
    EXPECT_EQ(mesh.triangles, before) << name;
  }
}

TEST(TouchMesh, OrientationIsRepairedPartByPart)
{
  TouchMesh mesh = boxOf(0.01);
  const TouchMesh good = mesh;
  std::swap(mesh.triangles[1], mesh.triangles[2]);
  std::swap(mesh.triangles[10], mesh.triangles[11]);
  orientOutward(mesh);
  const TriangleTree repaired(mesh);
  const TriangleTree expected(good);
  ASSERT_EQ(repaired.facets().size(), expected.facets().size());
  for (const TriangleTree::Facet& f : repaired.facets())
  {
    EXPECT_GT(dot(f.normal, f.corner[0] + f.corner[1] + f.corner[2]), 0.0);
  }
}

TEST(TouchMesh, SamplesLieOnTheSurfaceInProportionToItsArea)
{
  const TouchMesh mesh = blockMesh({ -0.03, 0.03 }, { -0.01, 0.01 }, { -0.01, 0.01 }, always);
  const std::vector<Vec3> points = samplesOf(mesh, 20000, 5);
  ASSERT_EQ(points.size(), 20000u);
  int ends = 0;
  for (const Vec3& p : points)
  {
    const double out = std::max({ std::abs(p.x) / 3.0, std::abs(p.y), std::abs(p.z) });
    ASSERT_NEAR(out, 0.01, 1e-15);
    ends += std::abs(p.x) > 0.03 - 1e-15;
  }
  EXPECT_NEAR(ends / 20000.0, 1.0 / 7.0, 0.01);
  EXPECT_TRUE(samplesOf(mesh, 20000, 5) == points);
}

TEST(TouchStrokes, PressSlideLiftAndTheTruthHoldsOnAFlatFace)
{
  const TriangleTree tree(boxOf(0.2));
  const std::vector<TouchStroke> strokes = strokesOn(tree, 4, StrokeSet::A);
  ASSERT_EQ(strokes.size(), 4u);
  for (const TouchStroke& stroke : strokes)
  {
    const TouchTruth truth = truthOf(tree, stroke, 800.0, 1);
    ASSERT_EQ(truth.ticks.size(), stroke.hip.size());
    EXPECT_FALSE(truth.leaps());
    double most = 0.0;
    int holds = 0;
    for (const TouchTruth::Tick& tick : truth.ticks)
    {
      most = std::max(most, norm(tick.force));
      holds += tick.holds;
      EXPECT_FALSE(tick.holds && tick.free);
    }
    EXPECT_NEAR(most, 0.8, 1e-9);
    EXPECT_GT(holds, 200);
    EXPECT_TRUE(truth.ticks.front().free);
    EXPECT_TRUE(truth.ticks.back().free);
  }
  EXPECT_NE(strokesOn(tree, 1, StrokeSet::B)[0].hip[0], strokes[0].hip[0]);
}

TEST(TouchStrokes, EndWhereAHandComesOutThroughTheWallOfAnOpenScan)
{
  TouchMesh mesh = boxOf(0.025);
  // Without its lid: two triangles whose corners all lie on top.
  std::vector<std::uint32_t> kept;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3)
  {
    const auto isTop = [&](std::uint32_t v) { return mesh.points[v].z > 0.0; };
    if (!std::all_of(mesh.triangles.begin() + i, mesh.triangles.begin() + i + 3, isTop))
    {
      kept.insert(kept.end(), mesh.triangles.begin() + i, mesh.triangles.begin() + i + 3);
    }
  }
  mesh.triangles = kept;
  const TriangleTree tree(mesh);
  TouchStroke stroke;
  moveTo(stroke, { 0.0, 0.0, 0.03 }, { 0.0, 0.0, 0.0 }, 0.05);
  const std::size_t inside = stroke.hip.size();
  moveTo(stroke, stroke.hip.back(), { 0.03, 0.0, 0.0 }, 0.05);
  const TouchTruth truth = truthOf(tree, stroke, 800.0, 1);
  EXPECT_NEAR(double(truth.ticks.size()), double(inside) + 500.0, 2.0);
  EXPECT_TRUE(truth.ticks.back().free);
}

/// Feels the mesh itself, times a factor.
class MeshTouch : public TouchMethod
{
public:
  MeshTouch(const TriangleTree& tree, double factor)
    : object_(tree)
    , factor_(factor)
  {
  }
  void reset(const TouchScene&) override { object_.reset(); }
  ProxyState step(const Vec3& hip, double) override
  {
    const GodObjectState state = object_.step(hip);
    ProxyState felt;
    felt.hip = hip;
    felt.contact = state.contact;
    felt.force = (800.0 * factor_) * (state.point - hip);
    felt.status = state.contact ? 4u : 0u;
    return felt;
  }

private:
  MeshGodObject object_;
  double factor_;
};

TouchFigures judged(const TriangleTree& tree, double factor)
{
  MeshTouch method(tree, factor);
  TouchJudge judge(800.0);
  for (const TouchStroke& stroke : strokesOn(tree, 20, StrokeSet::B))
  {
    const TouchTruth truth = truthOf(tree, stroke, 800.0, 1);
    judge.add(walk(method, {}, stroke, truth.ticks.size(), 1), truth);
  }
  return judge.figures();
}

TEST(TouchJudge, FindsNoFaultInTheTruthAndMeasuresWhatIsOff)
{
  const TriangleTree tree(generatedMesh("gear"));
  const TouchFigures exact = judged(tree, 1.0);
  EXPECT_EQ(exact.strokes, 20);
  EXPECT_GT(exact.judgedPercent, 80.0);
  EXPECT_EQ(exact.rmsPercent, 0.0);
  EXPECT_EQ(exact.p95Percent, 0.0);
  EXPECT_LE(exact.directionP95Degrees, 1e-6);
  EXPECT_EQ(exact.lostPercent, 0.0);
  EXPECT_EQ(exact.phantomNewton, 0.0);
  EXPECT_EQ(exact.held + exact.laterHeld + exact.pops, 0);
  EXPECT_NEAR(exact.energyJoule, 0.0, 1e-15);
  EXPECT_NEAR(exact.statusPercent[2], 100.0 * double(exact.contacts) / double(exact.ticks), 1e-9);
  const TouchFigures strong = judged(tree, 1.1);
  EXPECT_NEAR(strong.medianPercent, 10.0, 1e-6);
  EXPECT_NEAR(strong.p95Percent, 10.0, 1e-6);
  EXPECT_NEAR(strong.rmsPercent, 10.0, 1e-6);
  EXPECT_EQ(strong.pops, 0);
  const TouchFigures nothing = judged(tree, 0.0);
  EXPECT_EQ(nothing.lostPercent, nothing.judged > 0 ? 100.0 : 0.0);
  EXPECT_GE(nothing.pops, 18) << "one or two strokes have no tick that holds";
  const TouchFigures pulling = judged(tree, -1.0);
  EXPECT_NEAR(pulling.rmsPercent, 200.0, 1e-6);
  EXPECT_NEAR(pulling.directionP95Degrees, 180.0, 1e-6);
  EXPECT_EQ(pulling.pops, nothing.pops);
}

TEST(TouchStrokes, TheTruthDoesNotHoldWhereAShiftDecides)
{
  const TriangleTree tree(boxOf(0.025));
  TouchStroke stroke;
  moveTo(stroke, { 0.02, 0.0, 0.027 }, { 0.02, 0.0, 0.024 }, 0.025);
  moveTo(stroke, stroke.hip.back(), { 0.03, 0.0, 0.024 }, 0.005);
  const TouchTruth truth = truthOf(tree, stroke, 800.0, 1);
  for (std::size_t i = 0; i < truth.ticks.size(); ++i)
  {
    const double inside = 0.025 - stroke.hip[i].x;
    if (std::abs(inside) > 6e-5 && stroke.hip[i].z < 0.02475)
    {
      EXPECT_EQ(truth.ticks[i].holds, inside > 0.0) << inside;
      EXPECT_EQ(truth.ticks[i].free, inside < 0.0) << inside;
    }
  }
  EXPECT_FALSE(truth.leaps());
}

TEST(MeshGodObject, MeetsAnOpenMeshFromBothSidesAndLeavesIt)
{
  TouchMesh sheet;
  sheet.points = { { -1.0, -1.0, 0.0 }, { 1.0, -1.0, 0.0 }, { 0.0, 1.0, 0.0 } };
  sheet.triangles = { 0, 1, 2, 0, 2, 1 };
  const TriangleTree tree(sheet);
  MeshGodObject hand(tree, MeshGodObject::Facets::OfOpenMesh);
  for (const double side : { 1.0, -1.0 })
  {
    hand.reset();
    EXPECT_FALSE(hand.step({ 0.0, 0.0, 0.1 * side }).contact);
    EXPECT_TRUE(hand.step({ 0.0, 0.0, -0.1 * side }).contact);
    const GodObjectState slid = hand.step({ 0.1, 0.0, -0.2 * side });
    EXPECT_TRUE(slid.contact);
    EXPECT_NEAR(slid.point.x, 0.1, 1e-9);
    EXPECT_NEAR(slid.point.z, 0.0, 1e-9);
    EXPECT_FALSE(hand.step({ 0.1, 0.0, 0.1 * side }).contact);
  }
}

} // namespace
