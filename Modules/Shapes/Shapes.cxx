#include "Shapes/Shapes.h"

#include "Shapes/IdolShape.h"
#include "Shapes/PortableRandom.h"
#include "Shapes/ShapeFoot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace pointhaptics
{
namespace
{

using detail::Jet;
using detail::PortableRandom;

/// Density where it is highest over where it is lowest.
constexpr double kDensityRatio = 16.0;

struct Sample
{
  Vec3 point;
  Vec3 normal;
};

const Vec3 kUp{ 0.0, 0.0, 1.0 };

Sample drawPlane(PortableRandom& random)
{
  const double x = random.uniform(-detail::kPlaneHalf, detail::kPlaneHalf);
  return { { x, random.uniform(-detail::kPlaneHalf, detail::kPlaneHalf), 0.0 }, kUp };
}

Sample drawDensityStep(PortableRandom& random)
{
  const bool dense = random.uniform() < kDensityRatio / (kDensityRatio + 1.0);
  const double x = random.uniform(0.0, detail::kPlaneHalf);
  return { { dense ? x : -x, random.uniform(-detail::kPlaneHalf, detail::kPlaneHalf), 0.0 }, kUp };
}

Sample drawHole(PortableRandom& random)
{
  for (;;)
  {
    const Sample sample = drawPlane(random);
    if (norm2(sample.point) >= detail::kHoleRadius * detail::kHoleRadius)
    {
      return sample;
    }
  }
}

Sample drawSphere(PortableRandom& random)
{
  const Vec3 normal = random.sphere();
  return { detail::kSphereRadius * normal, normal };
}

Sample drawTorus(PortableRandom& random)
{
  double aroundX = 0.0, aroundY = 0.0, outwards = 0.0, upwards = 0.0;
  random.circle(aroundX, aroundY);
  double radius = 0.0;
  do // area grows with the distance from the axis
  {
    random.circle(outwards, upwards);
    radius = detail::kTorusRing + detail::kTorusTube * outwards;
  } while (random.uniform() * (detail::kTorusRing + detail::kTorusTube) >= radius);
  return { { radius * aroundX, radius * aroundY, detail::kTorusTube * upwards },
    { outwards * aroundX, outwards * aroundY, upwards } };
}

Sample drawEllipsoid(PortableRandom& random)
{
  const auto& a = detail::kEllipsoidAxes;
  for (;;)
  {
    const Vec3 q = random.sphere();
    const Vec3 n{ q.x / a[0], q.y / a[1], q.z / a[2] };
    // |n| is the area the map q -> a q makes of a piece of the sphere; its maximum is 1 / a[2].
    if (random.uniform() < norm(n) * a[2])
    {
      return { { a[0] * q.x, a[1] * q.y, a[2] * q.z }, normalized(n) };
    }
  }
}

Sample drawSaddle(PortableRandom& random)
{
  const double k = detail::kSaddleLength;
  const double steepest = 2.0 * detail::kSaddleHalf / k;
  for (;;)
  {
    const double x = random.uniform(-detail::kSaddleHalf, detail::kSaddleHalf);
    const double y = random.uniform(-detail::kSaddleHalf, detail::kSaddleHalf);
    const Vec3 n{ -2.0 * x / k, 2.0 * y / k, 1.0 };
    if (random.uniform() * std::sqrt(1.0 + 2.0 * steepest * steepest) < norm(n))
    {
      return { { x, y, (x * x - y * y) / k }, normalized(n) };
    }
  }
}

Sample drawBox(PortableRandom& random)
{
  const int face = static_cast<int>(random.bits() >> 33);
  const int axis = face % 3;
  const double side = (face / 3) % 2 == 0 ? 1.0 : -1.0;
  Sample sample;
  sample.point[(axis + 1) % 3] = random.uniform(-detail::kBoxHalf, detail::kBoxHalf);
  sample.point[(axis + 2) % 3] = random.uniform(-detail::kBoxHalf, detail::kBoxHalf);
  sample.point[axis] = side * detail::kBoxHalf;
  sample.normal[axis] = side;
  return sample;
}

Sample drawEdge(PortableRandom& random)
{
  const double across = random.uniform(-detail::kEdgeWidth, detail::kEdgeWidth);
  const double y = random.uniform(-detail::kPlaneHalf, detail::kPlaneHalf);
  return across < 0.0 ? Sample{ { across, y, 0.0 }, kUp } : Sample{ { 0.0, y, -across }, { 1.0, 0.0, 0.0 } };
}

Sample drawSheet(PortableRandom& random)
{
  const double up = random.uniform() < 0.5 ? -1.0 : 1.0;
  const double x = random.uniform(-detail::kSheetHalf, detail::kSheetHalf);
  const double y = random.uniform(-detail::kSheetHalf, detail::kSheetHalf);
  return { { x, y, up * detail::kSheetHalfThickness }, { 0.0, 0.0, up } };
}

/// The idol about a point of the unit sphere, as a function of two parameters in the sphere's tangent plane.
template <int Order>
struct IdolPatch
{
  Vec3 first, second; ///< The tangents of the parameters on the unit sphere.
  std::array<Jet<Order>, 3> position;

  explicit IdolPatch(const Vec3& q)
    : first(anyPerpendicular(q))
    , second(cross(q, first))
  {
    Jet<Order> x[3], length2(0.0);
    for (int axis = 0; axis < 3; ++axis)
    {
      x[axis].d[0] = q[axis];
      x[axis].d[1] = first[axis];
      x[axis].d[2] = second[axis];
      length2 = length2 + x[axis] * x[axis];
    }
    const Jet<Order> scale = inverse(sqrt(length2));
    position = detail::idolMap<Jet<Order>>({ x[0] * scale, x[1] * scale, x[2] * scale });
  }
  Vec3 term(int i) const { return { position[0].d[i], position[1].d[i], position[2].d[i] }; }
  Vec3 point() const { return term(0); }
  /// Outward; its length is the area the map makes of a piece of the unit sphere.
  Vec3 areaNormal() const { return cross(term(1), term(2)); }
};

/// 1 behind the foot to kDensityRatio at the face, smooth over the unit sphere.
double idolDensity(const Vec3& q)
{
  const double towardsFace = std::clamp(0.5 * (1.0 + 0.8 * q.z - 0.6 * q.y), 0.0, 1.0);
  const double eased = towardsFace * towardsFace * (3.0 - 2.0 * towardsFace);
  const double root = 1.0 + 3.0 * eased;
  return root * root;
}

/// Upper bounds over the unit sphere: the largest of many samples, and a margin.
struct IdolBounds
{
  static constexpr int kSlices = 128;
  std::array<double, kSlices> area{}; ///< Integral of the area normal's length, by the height of q.
  double densityTimesArea = 0.0;

  static int slice(const Vec3& q) { return std::clamp(int((0.5 + 0.5 * q.z) * kSlices), 0, kSlices - 1); }
  static const IdolBounds& get()
  {
    static const IdolBounds bounds = []
    {
      IdolBounds result;
      PortableRandom random(1);
      for (int i = 0; i < 60000; ++i)
      {
        const Vec3 q = random.sphere();
        const double size = 1.4 * norm(IdolPatch<1>(q).areaNormal());
        result.area[slice(q)] = std::max(result.area[slice(q)], size);
        result.densityTimesArea = std::max(result.densityTimesArea, idolDensity(q) * size);
      }
      return result;
    }();
    return bounds;
  }
};

Sample drawIdol(PortableRandom& random)
{
  const IdolBounds& bounds = IdolBounds::get();
  for (;;)
  {
    const Vec3 q = random.sphere();
    const double threshold = random.uniform() * bounds.densityTimesArea;
    const double density = idolDensity(q);
    if (threshold >= density * bounds.area[IdolBounds::slice(q)])
    {
      continue; // the cheap half of the test
    }
    const IdolPatch<1> patch(q);
    const Vec3 n = patch.areaNormal();
    if (threshold < density * norm(n))
    {
      return { patch.point(), normalized(n) };
    }
  }
}

/// Newton on half the squared distance over the unit sphere, from @p q downhill; the Hessian is shifted where
/// it is not positive and the step halved where the distance does not fall.
Vec3 idolDescend(const Vec3& p, Vec3 q)
{
  for (int round = 0; round < 60; ++round)
  {
    const IdolPatch<2> patch(q);
    const Vec3 r = patch.point() - p;
    const Vec3 fa = patch.term(1), fb = patch.term(2);
    const double ga = dot(r, fa), gb = dot(r, fb);
    double haa = dot(fa, fa) + dot(r, patch.term(3));
    const double hab = dot(fa, fb) + dot(r, patch.term(4));
    double hbb = dot(fb, fb) + dot(r, patch.term(5));
    const double smallest = 0.5 * (haa + hbb) - std::hypot(0.5 * (haa - hbb), hab);
    const double floor = 1e-3 * (dot(fa, fa) + dot(fb, fb));
    if (smallest < floor)
    {
      haa += floor - smallest;
      hbb += floor - smallest;
    }
    const double determinant = haa * hbb - hab * hab;
    double da = (hab * gb - hbb * ga) / determinant;
    double db = (hab * ga - haa * gb) / determinant;
    const double limit = std::min(1.0, 0.2 / std::max(std::hypot(da, db), 1e-300));
    da *= limit;
    db *= limit;
    if (std::hypot(da, db) < 4e-16)
    {
      break;
    }
    Vec3 next;
    bool fell = false;
    for (int halving = 0; halving < 30 && !fell; ++halving)
    {
      next = normalized(q + da * patch.first + db * patch.second);
      const Vec3 there = IdolPatch<1>(next).point() - p;
      // The rounding of the point hides the last steps: allow for it.
      fell = norm2(there) <= norm2(r) + 1e-16 * norm(r) + 1e-33;
      da *= 0.5;
      db *= 0.5;
    }
    if (!fell || next == q)
    {
      break;
    }
    q = next;
  }
  return q;
}

struct IdolSeed
{
  Vec3 q;
  Vec3 point;
};

/// Points about 1 mm apart all over the idol.
const std::vector<IdolSeed>& idolSeeds()
{
  static const std::vector<IdolSeed> seeds = []
  {
    PortableRandom random(2);
    const auto& bounds = IdolBounds::get().area;
    const double largest = *std::max_element(bounds.begin(), bounds.end());
    std::vector<IdolSeed> table;
    while (table.size() < 16384)
    {
      const Vec3 q = random.sphere();
      const IdolPatch<1> patch(q);
      if (random.uniform() * largest < norm(patch.areaNormal()))
      {
        table.push_back({ q, patch.point() });
      }
    }
    return table;
  }();
  return seeds;
}

/// Where to start the descents: the nearest seeds, at most one in a millimetre, as far as a seed can lie from
/// the foot point it leads to.
std::vector<IdolSeed> idolStarts(const Vec3& p)
{
  constexpr double kReach = 0.0025;
  constexpr double kApart = 0.001;
  constexpr std::size_t kStarts = 24;
  const std::vector<IdolSeed>& seeds = idolSeeds();
  double smallest2 = std::numeric_limits<double>::infinity();
  for (const IdolSeed& seed : seeds)
  {
    smallest2 = std::min(smallest2, norm2(seed.point - p));
  }
  std::vector<std::pair<double, const IdolSeed*>> near;
  for (const IdolSeed& seed : seeds)
  {
    const double distance2 = norm2(seed.point - p);
    if (distance2 <= smallest2 + kReach * kReach)
    {
      near.emplace_back(distance2, &seed);
    }
  }
  std::sort(near.begin(), near.end());
  std::vector<IdolSeed> starts;
  for (const auto& candidate : near)
  {
    const auto isClose = [&](const IdolSeed& start)
    { return norm2(start.point - candidate.second->point) < kApart * kApart; };
    if (starts.size() < kStarts && std::none_of(starts.begin(), starts.end(), isClose))
    {
      starts.push_back(*candidate.second);
    }
  }
  return starts;
}

SurfacePoint idolFoot(const Vec3& p)
{
  Vec3 best;
  double bestDistance2 = std::numeric_limits<double>::infinity();
  for (const IdolSeed& start : idolStarts(p))
  {
    const Vec3 q = idolDescend(p, start.q);
    const double distance2 = norm2(IdolPatch<1>(q).point() - p);
    if (distance2 < bestDistance2)
    {
      bestDistance2 = distance2;
      best = q;
    }
  }
  const IdolPatch<1> patch(best);
  const Vec3 normal = normalized(patch.areaNormal());
  return detail::footOn(p, patch.point(), normal, dot(p - patch.point(), normal) < 0.0);
}

/// In the order of Shape.
constexpr struct
{
  const char* name;
  Sample (*draw)(PortableRandom&);
  SurfacePoint (*foot)(const Vec3&);
} kShapes[kNumberOfShapes] = { { "plane", drawPlane, detail::planeFoot },
  { "sphere", drawSphere, detail::sphereFoot }, { "torus", drawTorus, detail::torusFoot },
  { "ellipsoid", drawEllipsoid, detail::ellipsoidFoot }, { "saddle", drawSaddle, detail::saddleFoot },
  { "box", drawBox, detail::boxFoot }, { "edge", drawEdge, detail::edgeFoot },
  { "sheet", drawSheet, detail::sheetFoot }, { "hole", drawHole, detail::holeFoot },
  { "density-step", drawDensityStep, detail::planeFoot }, { "idol", drawIdol, idolFoot } };

} // namespace

const char* shapeName(Shape shape) noexcept
{
  return kShapes[static_cast<int>(shape)].name;
}

bool shapeFromName(const std::string& name, Shape& shape) noexcept
{
  const auto* const found = std::find_if(
    std::begin(kShapes), std::end(kShapes), [&name](const auto& each) { return name == each.name; });
  shape = found == std::end(kShapes) ? shape : static_cast<Shape>(found - std::begin(kShapes));
  return found != std::end(kShapes);
}

Status generateShape(Shape shape, std::int64_t count, std::uint64_t seed, double noise,
  std::vector<Vec3>& points, std::vector<Vec3>* normals)
{
  points.clear();
  if (normals)
  {
    normals->clear();
  }
  if (count < 0 || !(noise >= 0.0 && std::isfinite(noise)))
  {
    return Status::InvalidParameter;
  }
  points.resize(static_cast<std::size_t>(count));
  if (normals)
  {
    normals->resize(points.size());
  }
  PortableRandom random(seed);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Sample sample = kShapes[static_cast<int>(shape)].draw(random);
    points[i] = noise > 0.0 ? sample.point + (noise * random.gaussian()) * sample.normal : sample.point;
    if (normals)
    {
      (*normals)[i] = sample.normal;
    }
  }
  return Status::Ok;
}

SurfacePoint closestPoint(Shape shape, const Vec3& position)
{
  return kShapes[static_cast<int>(shape)].foot(position);
}

} // namespace pointhaptics
