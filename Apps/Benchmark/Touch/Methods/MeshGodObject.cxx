#include "Benchmark/Touch/Methods/MeshGodObject.h"

#include <algorithm>
#include <cmath>

namespace pointhaptics::bench::touch
{
namespace
{

constexpr int kLeafSize = 4;
/// Facets reach this far beyond their sides, metres: no way leads between two neighbours.
constexpr double kSide = 1e-10;
/// A start this far behind a facet counts as in front of it, metres; the second holds before a release: a god
/// object is free only where it did not slip between facets that overlap.
constexpr double kMargin = 2e-6;
constexpr double kReleaseMargin = 3e-5;
/// A round that moves the god object by less than this ends the search, metres.
constexpr double kAtRest = 1e-10;
constexpr int kMostCasts = 1000;
constexpr int kMostPlanes = 4;

bool isInside(const TriangleTree::Facet& f, const Vec3& p)
{
  for (int i = 0; i < 3; ++i)
  {
    const Vec3& a = f.corner[i];
    const Vec3 side = f.corner[(i + 1) % 3] - a;
    if (dot(cross(side, p - a), f.normal) < -kSide * norm(side))
    {
      return false;
    }
  }
  return true;
}

/// The fraction of the way at which the facet's plane is crossed from its front; above 1: not at all.
double crossing(const TriangleTree::Facet& f, const Vec3& from, const Vec3& way, double margin,
  double& height, double& descent)
{
  descent = -dot(f.normal, way);
  height = dot(f.normal, from - f.corner[0]);
  if (descent <= 0.0 || height < -margin || height > descent)
  {
    return 2.0;
  }
  return height / descent;
}

struct Plane
{
  Vec3 normal;
  double offset = 0.0; ///< normal . x of a point on the facet.
};

/// The point nearest @p hip on all of @p count planes at @p clearance; false where they have no point in
/// common.
bool meetingPoint(const Plane* const* planes, int count, const Vec3& hip, double clearance, Vec3& point)
{
  // hip + sum of l_i n_i with (n_i . n_j) l = offset + clearance - n_i . hip; Cramer's rule.
  double gap[3] = {};
  for (int i = 0; i < count; ++i)
  {
    gap[i] = planes[i]->offset + clearance - dot(planes[i]->normal, hip);
  }
  const Vec3& a = planes[0]->normal;
  if (count == 1)
  {
    point = hip + gap[0] * a;
    return true;
  }
  const Vec3& b = planes[1]->normal;
  if (count == 2)
  {
    const double c = dot(a, b);
    const double sine2 = norm2(cross(a, b));
    if (sine2 < 1e-12)
    {
      return false;
    }
    point = hip + ((gap[0] - c * gap[1]) / sine2) * a + ((gap[1] - c * gap[0]) / sine2) * b;
    return true;
  }
  const Vec3& c = planes[2]->normal;
  const double volume = dot(a, cross(b, c));
  if (std::abs(volume) < 1e-7)
  {
    return false;
  }
  point = hip + (gap[0] * cross(b, c) + gap[1] * cross(c, a) + gap[2] * cross(a, b)) / volume;
  return true;
}

} // namespace

TriangleTree::TriangleTree(const TouchMesh& mesh)
{
  for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3)
  {
    Facet f;
    for (std::size_t k = 0; k < 3; ++k)
    {
      f.corner[k] = mesh.points[mesh.triangles[i + k]];
    }
    const Vec3 area = cross(f.corner[1] - f.corner[0], f.corner[2] - f.corner[0]);
    if (norm(area) > kLeastArea)
    {
      f.normal = normalized(area);
      facets_.push_back(f);
    }
  }
  nodes_.emplace_back();
  split(0, 0, int(facets_.size()));
}

void TriangleTree::split(int node, int begin, int end)
{
  Vec3 low{ INFINITY, INFINITY, INFINITY };
  Vec3 high = -low;
  for (int i = begin; i < end; ++i)
  {
    for (const Vec3& p : facets_[std::size_t(i)].corner)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        low[axis] = std::min(low[axis], p[axis]);
        high[axis] = std::max(high[axis], p[axis]);
      }
    }
  }
  nodes_[std::size_t(node)].low = low;
  nodes_[std::size_t(node)].high = high;
  if (end - begin <= kLeafSize)
  {
    nodes_[std::size_t(node)].first = begin;
    nodes_[std::size_t(node)].count = end - begin;
    return;
  }
  const Vec3 extent = high - low;
  const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
  const int middle = (begin + end) / 2;
  const auto place = [axis](const Facet& f)
  { return f.corner[0][axis] + f.corner[1][axis] + f.corner[2][axis]; };
  std::nth_element(facets_.begin() + begin, facets_.begin() + middle, facets_.begin() + end,
    [&](const Facet& a, const Facet& b) { return place(a) < place(b); });
  const int children = int(nodes_.size());
  nodes_[std::size_t(node)].first = children;
  nodes_.resize(nodes_.size() + 2);
  split(children, begin, middle);
  split(children + 1, middle, end);
}

template <class Visitor>
void TriangleTree::visit(const Vec3& from, const Vec3& way, double margin, Visitor&& visitor) const
{
  const Vec3 to = from + way;
  int stack[128];
  int depth = 0;
  stack[depth++] = 0;
  while (depth > 0)
  {
    const Node& node = nodes_[std::size_t(stack[--depth])];
    double first = 0.0;
    double last = 1.0;
    bool meets = true;
    for (int axis = 0; axis < 3 && meets; ++axis)
    {
      const double low = node.low[axis] - margin;
      const double high = node.high[axis] + margin;
      meets = std::max(from[axis], to[axis]) >= low && std::min(from[axis], to[axis]) <= high;
      if (meets && std::abs(way[axis]) > 1e-12)
      {
        const double a = (low - from[axis]) / way[axis];
        const double b = (high - from[axis]) / way[axis];
        first = std::max(first, std::min(a, b));
        last = std::min(last, std::max(a, b));
        meets = first <= last;
      }
    }
    if (!meets)
    {
      continue;
    }
    for (int i = node.first; i < node.first + node.count; ++i)
    {
      visitor(facets_[std::size_t(i)]);
    }
    if (node.count == 0 && !facets_.empty())
    {
      stack[depth++] = node.first;
      stack[depth++] = node.first + 1;
    }
  }
}

TriangleTree::Hit TriangleTree::cast(const Vec3& from, const Vec3& way, double margin) const
{
  Hit hit;
  visit(from, way, margin + kSide,
    [&](const Facet& f)
    {
      double height = 0.0;
      double descent = 0.0;
      const double where = crossing(f, from, way, margin, height, descent);
      const double stop = std::max(0.0, (height - kClearance) / descent);
      if (where > 1.0 || (hit.facet && stop >= hit.fraction))
      {
        return;
      }
      // A start behind the plane: what counts is whether it is behind this facet.
      const Vec3 place = height < 0.0 ? from - height * f.normal : from + where * way;
      if (isInside(f, place))
      {
        hit = { &f, std::min(stop, 1.0) };
      }
    });
  return hit;
}

bool TriangleTree::isCrossed(const Vec3& from, const Vec3& to, Side side) const
{
  bool crossed = false;
  const Vec3 way = to - from;
  visit(from, way, kSide,
    [&](const Facet& f)
    {
      const double a = dot(f.normal, from - f.corner[0]);
      const double b = a + dot(f.normal, way);
      const bool isWanted = (a > 0.0) != (b > 0.0) && (side == Side::Any || a < b);
      crossed = crossed || (isWanted && isInside(f, from + (a / (a - b)) * way));
    });
  return crossed;
}

/// The facets met since the last straight way, and the target they leave.
struct MeshGodObject::Planes
{
  Plane plane[kMostPlanes];
  bool active[kMostPlanes] = {};
  int count = 0;

  /// One that does not hold makes room where there is none.
  void add(const TriangleTree::Facet& f)
  {
    int slot = count;
    if (count == kMostPlanes)
    {
      slot = int(std::find(active, active + kMostPlanes, false) - active);
      slot = std::min(slot, kMostPlanes - 1);
    }
    else
    {
      ++count;
    }
    plane[slot] = { f.normal, dot(f.normal, f.corner[0]) };
  }

  bool allows(const Vec3& point, double clearance) const
  {
    return std::all_of(plane, plane + count,
      [&](const Plane& p) { return dot(p.normal, point) - p.offset >= clearance - 1e-12; });
  }

  /// The point nearest @p hip on the free side of all planes: of the meeting points of up to three planes
  /// that are free of the others, the nearest one. @p otherwise where rounding leaves none.
  Vec3 target(const Vec3& hip, double clearance, const Vec3& otherwise)
  {
    Vec3 best = otherwise;
    double bestDistance = INFINITY;
    unsigned bestChoice = 0;
    for (unsigned choice = 1; choice < (1u << count); ++choice)
    {
      const Plane* chosen[kMostPlanes];
      int size = 0;
      for (int i = 0; i < count; ++i)
      {
        if (choice & (1u << i))
        {
          chosen[size++] = &plane[i];
        }
      }
      Vec3 point;
      if (size <= 3 && meetingPoint(chosen, size, hip, clearance, point) && allows(point, clearance) &&
        norm2(point - hip) < bestDistance)
      {
        best = point;
        bestDistance = norm2(point - hip);
        bestChoice = choice;
      }
    }
    for (int i = 0; i < count; ++i)
    {
      active[i] = (bestChoice & (1u << i)) != 0;
    }
    return best;
  }
};

MeshGodObject::MeshGodObject(const TriangleTree& tree, Facets facets)
  : tree_(&tree)
  , margin_(facets == Facets::OfClosedMesh ? kMargin : 0.0)
  , releaseMargin_(facets == Facets::OfClosedMesh ? kReleaseMargin : 0.0)
{
}

/// One straight way towards the HIP, along as many facets as are met from there. False: it came to the HIP.
bool MeshGodObject::descend(const Vec3& hip, Planes& planes, int& casts)
{
  Vec3 target = hip;
  while (casts < kMostCasts)
  {
    ++casts;
    const Vec3 way = target - position_;
    if (planes.count > 0 && norm2(way) < kAtRest * kAtRest)
    {
      return true;
    }
    TriangleTree::Hit hit = tree_->cast(position_, way, margin_);
    if (!hit.facet && planes.count == 0)
    {
      hit = tree_->cast(position_, way, releaseMargin_);
    }
    if (!hit.facet)
    {
      position_ = target;
      return planes.count > 0;
    }
    position_ += hit.fraction * way;
    const double height = dot(hit.facet->normal, position_ - hit.facet->corner[0]);
    if (height < 0.0)
    {
      position_ += (TriangleTree::kClearance - height) * hit.facet->normal;
    }
    planes.add(*hit.facet);
    target = planes.target(hip, TriangleTree::kClearance, position_);
  }
  return true;
}

GodObjectState MeshGodObject::step(const Vec3& hip)
{
  if (!placed_)
  {
    position_ = hip;
    placed_ = true;
  }
  GodObjectState state;
  Planes planes;
  int casts = 0;
  for (bool moves = true; moves && casts < kMostCasts;)
  {
    const Vec3 before = position_;
    planes = Planes();
    state.contact = descend(hip, planes, casts);
    moves = state.contact && norm2(position_ - before) > kAtRest * kAtRest;
  }
  state.point = position_;
  if (state.contact)
  {
    const Vec3 exact = planes.target(hip, 0.0, position_);
    if (norm(exact - position_) < 100.0 * TriangleTree::kClearance)
    {
      state.point = exact;
    }
    for (int i = 0; i < planes.count; ++i)
    {
      if (planes.active[i] && state.planes < 3)
      {
        state.normals[std::size_t(state.planes++)] = planes.plane[i].normal;
      }
    }
  }
  return state;
}

} // namespace pointhaptics::bench::touch
