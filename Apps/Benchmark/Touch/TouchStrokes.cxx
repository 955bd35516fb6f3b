#include "Benchmark/Touch/TouchStrokes.h"

#include "Shapes/PortableRandom.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics::bench::touch
{
namespace
{

constexpr double kHeight = 4e-3;
constexpr double kDepth = 1e-3;
constexpr double kSlide = 10e-3;
constexpr double kLift = 5e-3;
constexpr double kSlowSpeed = 0.020;
constexpr double kFastSpeed = 0.050;
/// A ray from outside ends this far above the place it goes to.
constexpr double kJustAbove = 1e-6;
/// Places tried for one that can be reached.
constexpr int kMostTries = 200;
constexpr double kNearShift = 10e-6;
constexpr double kFarShift = 50e-6;
constexpr int kShifts = 4;
constexpr double kAgreement = 0.25;

std::uint64_t seedOf(StrokeSet set)
{
  return set == StrokeSet::A ? 2801 : 2802;
}

Vec3 randomPlace(const TriangleTree& tree, const std::vector<double>& areas, detail::PortableRandom& random,
  const TriangleTree::Facet*& facet)
{
  const double wanted = random.uniform() * areas.back();
  const auto found = std::upper_bound(areas.begin(), areas.end(), wanted);
  facet = &tree.facets()[std::min(areas.size() - 1, std::size_t(found - areas.begin()))];
  double u = random.uniform();
  double v = random.uniform();
  if (u + v > 1.0)
  {
    u = 1.0 - u;
    v = 1.0 - v;
  }
  return facet->corner[0] + u * (facet->corner[1] - facet->corner[0]) +
    v * (facet->corner[2] - facet->corner[0]);
}

TouchStroke strokeAt(const Vec3& place, const Vec3& normal, const Vec3& tangent, double speed)
{
  TouchStroke stroke;
  const Vec3 low = place - kDepth * normal;
  const Vec3 end = low + kSlide * tangent;
  moveTo(stroke, place + kHeight * normal, low, kPressSpeed);
  moveTo(stroke, low, end, speed);
  moveTo(stroke, end, end + kLift * normal, kFastSpeed);
  stay(stroke, kRestTicks);
  return stroke;
}

} // namespace

void moveTo(TouchStroke& stroke, const Vec3& from, const Vec3& to, double speed)
{
  if (stroke.hip.empty())
  {
    stroke.hip.push_back(from);
  }
  const int ticks = std::max(1, int(std::lround(norm(to - from) / (speed * kTickSeconds))));
  for (int i = 1; i <= ticks; ++i)
  {
    stroke.hip.push_back(from + (double(i) / ticks) * (to - from));
  }
}

void stay(TouchStroke& stroke, int ticks)
{
  stroke.hip.insert(stroke.hip.end(), std::size_t(ticks), Vec3(stroke.hip.back()));
}

std::vector<TouchStroke> strokesOn(const TriangleTree& tree, int count, StrokeSet set)
{
  std::vector<TouchStroke> strokes;
  if (tree.facets().empty())
  {
    return strokes;
  }
  std::vector<double> areas;
  double sum = 0.0;
  for (const TriangleTree::Facet& f : tree.facets())
  {
    sum += norm(cross(f.corner[1] - f.corner[0], f.corner[2] - f.corner[0]));
    areas.push_back(sum);
  }
  detail::PortableRandom random(seedOf(set));
  for (int tries = 0; int(strokes.size()) < count && tries < kMostTries * count; ++tries)
  {
    const TriangleTree::Facet* facet = nullptr;
    const Vec3 place = randomPlace(tree, areas, random, facet);
    const Vec3& n = facet->normal;
    const Vec3 a = anyPerpendicular(n);
    double x = 0.0;
    double y = 0.0;
    random.circle(x, y);
    if (!tree.isCrossed(place + kHeight * n, place + kJustAbove * n, TriangleTree::Side::Any))
    {
      strokes.push_back(
        strokeAt(place, n, x * a + y * cross(n, a), strokes.size() % 2 == 0 ? kSlowSpeed : kFastSpeed));
    }
  }
  return strokes;
}

TouchTruth truthOf(const TriangleTree& tree, const TouchStroke& stroke, double stiffness, std::uint64_t seed)
{
  detail::PortableRandom random(seed);
  std::vector<Vec3> shifts;
  std::vector<MeshGodObject> others;
  for (int i = 0; i < 2 * kShifts; ++i)
  {
    shifts.push_back((i < kShifts ? kNearShift : kFarShift) * random.sphere());
    others.emplace_back(tree);
  }
  TouchTruth truth;
  MeshGodObject hand(tree);
  GodObjectState last;
  bool leapt = false;
  for (std::size_t i = 0; i < stroke.hip.size(); ++i)
  {
    const Vec3& hip = stroke.hip[i];
    const GodObjectState state = hand.step(hip);
    const double moved = i == 0 ? 0.0 : norm(hip - stroke.hip[i - 1]);
    if (!leapt && state.contact && last.contact && norm(state.point - last.point) > 4.0 * moved + 2e-4)
    {
      leapt = true;
      truth.certain = i;
    }
    // The hand fell through a hole of the scan, and comes out through its wall: points have two sides.
    if (i > 0 && !state.contact && !last.contact &&
      tree.isCrossed(last.point, state.point, TriangleTree::Side::Back))
    {
      break;
    }
    last = state;
    TouchTruth::Tick tick;
    tick.force = stiffness * (state.point - hip);
    tick.contact = state.contact;
    tick.free = !state.contact;
    tick.holds = state.contact && norm(tick.force) > kForceFloor;
    for (std::size_t k = 0; k < others.size(); ++k)
    {
      const GodObjectState other = others[k].step(hip + shifts[k]);
      const Vec3 force = stiffness * (other.point - hip - shifts[k]);
      tick.free = tick.free && !other.contact;
      tick.holds = tick.holds && other.contact && norm(force - tick.force) <= kAgreement * norm(tick.force);
    }
    truth.ticks.push_back(tick);
  }
  truth.certain = leapt ? truth.certain : truth.ticks.size();
  return truth;
}

} // namespace pointhaptics::bench::touch
