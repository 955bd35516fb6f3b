#include "Core/Neighbors/SurfaceMidpoints.h"

#include "Core/Neighbors/NeighborSweep.h"
#include "Core/Neighbors/TangentCell.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace pointhaptics
{
namespace
{

constexpr double kPi = 3.14159265358979323846;
/// Neighbours of a point that may bound its cell; rows are closer along than across.
constexpr int kNeighbors = 40;
/// A normal is that of the points within so many spacings, and beyond the nearest eight; the further they
/// are the less they count, and so does the other side of a thin plate.
constexpr int kFewest = 8;
constexpr double kNormalReach = 2.5;
constexpr double kBeyondFewest = 1.3; ///< Ratio of squared distances.
/// Neighbours steeper than this above the tangent plane do not count for the spacing, a sine: those of
/// another sheet close by would halve the square of it. It grows by so much at most: at an edge half the
/// neighbours are steep.
constexpr double kGentle = 0.5;
constexpr double kMostOfAll = 1.5;
/// Corners of a cell further away than this many spacings belong to a hole.
constexpr double kCellReach = 2.0;
/// A neighbour steeper than this above the tangent plane is of another sheet; a sine.
constexpr double kSteep = 0.9;
/// Longest edge, over the smaller spacing at its ends; and where it is flat: random points have such gaps.
constexpr double kLongest = 2.0;
constexpr double kLongestFlat = 3.0;
constexpr double kFlat = 25.0 * kPi / 180.0;
/// By how much more than the normals turn an edge may lean.
constexpr double kLean = 45.0 * kPi / 180.0;
constexpr std::size_t kMostEdges = 16;
/// A point has a twin where its nearest neighbour is nearer than this part of the fourth, squared. Of points
/// at random 1 - (1 - 1/16)^3 = 0.176 have; where voxels have joined some of them 0.06 and more, of vertices
/// of meshes mostly 0.02 and less (those cut out of a lattice 0.11: they are left as they are).
constexpr double kTwin = 1.0 / 16.0;
constexpr double kTwinsAtRandom = 0.05;
/// Points no further above each other than this, over the spacing, may be of one noisy sheet.
constexpr double kOfOneSheet = 0.5;

/// Properties of a point.
struct Fan
{
  double spacing = 0.0; ///< 0: the point has no fan.
  bool hasTwin = false;
  Vec3 normal;
  std::array<std::uint32_t, kMostEdges> ends{}; ///< Slots.
  std::size_t size = 0;

  bool has(std::uint32_t slot) const
  {
    return std::find(ends.begin(), ends.begin() + std::ptrdiff_t(size), slot) !=
      ends.begin() + std::ptrdiff_t(size);
  }
};

/// @p d in the plane across @p normal, as long as it is; zero where it is too steep.
Vec3 laidFlat(const Vec3& d, const Vec3& normal)
{
  const double height = dot(d, normal);
  const Vec3 along = d - height * normal;
  const double length = norm(d);
  return std::abs(height) <= kSteep * length && norm2(along) > 0.0 ? (length / norm(along)) * along : Vec3();
}

/// Spacing of a square grid whose fourth and eighth neighbours are as far away; squared distances.
double gridSpacing(double fourth2, double eighth2)
{
  return std::sqrt(kPi * std::max(fourth2 / 4.0, eighth2 / 8.0));
}

class Triangulation
{
public:
  Triangulation(const PointView& points, double sparse, const Executor& executor)
    : sparse_(sparse)
  {
    query_.build(points, executor);
    fans_.resize(std::size_t(query_.size()));
    NeighborSweep::runAll(
      query_, kNeighbors + 1, executor, [this](const NeighborList& list) { this->measure(list); });
    if (!this->areAtRandom())
    {
      NeighborSweep::runAll(
        query_, kNeighbors + 1, executor, [this](const NeighborList& list) { this->makeFan(list); });
    }
  }

  std::vector<Vec3> midpoints() const
  {
    std::vector<Vec3> result;
    for (std::uint32_t a = 0; a < fans_.size(); ++a)
    {
      for (std::size_t i = 0; i < fans_[a].size; ++i)
      {
        const std::uint32_t b = fans_[a].ends[i];
        if ((a < b || !fans_[b].has(a)) && this->isSparse(a, b))
        {
          result.push_back(0.5 * (query_.point(a) + query_.point(b)));
        }
      }
    }
    return result;
  }

private:
  /// Whether the points lie at random: such have gaps which triangles of their edges do not close.
  bool areAtRandom() const
  {
    const auto twins = std::count_if(fans_.begin(), fans_.end(), [](const Fan& fan) { return fan.hasTwin; });
    return double(twins) > kTwinsAtRandom * double(fans_.size());
  }

  Vec3 offset(const NeighborList& list, int i) const
  {
    return query_.point(std::int64_t(list.slots[i])) - query_.point(list.slot);
  }

  Vec3 normalAt(const NeighborList& list, double spacing) const
  {
    const double reach2 = std::max(
      kNormalReach * kNormalReach * spacing * spacing, kBeyondFewest * list.squaredDistances[kFewest]);
    Vec3 sum;
    SymMat3 moments;
    double weights = 0.0;
    for (int i = 0; i < list.count && list.squaredDistances[i] < reach2; ++i)
    {
      const double weight = 1.0 - list.squaredDistances[i] / reach2;
      const Vec3 d = this->offset(list, i);
      sum += weight * d;
      SymMat3 moment = outerProduct(d);
      moment *= weight;
      moments += moment;
      weights += weight;
    }
    SymMat3 mean = outerProduct(sum);
    mean *= -1.0 / weights;
    moments += mean;
    return symmetricEigen(moments).vectors[0];
  }

  /// The spacing without neighbours of another sheet; 0: there are too few of the point's own.
  double spacingOfSheet(const NeighborList& list, const Vec3& normal) const
  {
    double fourth2 = 0.0;
    int count = 0;
    for (int i = 1; i < list.count; ++i)
    {
      const double height = dot(this->offset(list, i), normal);
      if (height * height > kGentle * kGentle * list.squaredDistances[i])
      {
        continue;
      }
      ++count;
      fourth2 = count == 4 ? list.squaredDistances[i] : fourth2;
      if (count == 8)
      {
        return gridSpacing(fourth2, list.squaredDistances[i]);
      }
    }
    return 0.0;
  }

  /// Looks along the normal: noise moves points apart that lie at random.
  bool hasTwin(const NeighborList& list, const Vec3& normal, double spacing) const
  {
    std::array<double, kFewest> across2;
    across2.fill(INFINITY);
    for (int i = 1; i <= kFewest; ++i)
    {
      const Vec3 d = this->offset(list, i);
      const double height = dot(d, normal);
      if (std::abs(height) < kOfOneSheet * spacing)
      {
        across2[std::size_t(i - 1)] = norm2(d) - height * height;
      }
    }
    std::sort(across2.begin(), across2.end());
    return std::isfinite(across2[3]) && across2[0] < kTwin * across2[3];
  }

  /// Finds the spacing and the normal of a point.
  void measure(const NeighborList& list)
  {
    if (list.count <= kFewest)
    {
      return;
    }
    const double spacing = gridSpacing(list.squaredDistances[4], list.squaredDistances[8]);
    if (spacing <= 0.0)
    {
      return;
    }
    Fan& fan = fans_[std::size_t(list.slot)];
    fan.normal = this->normalAt(list, spacing);
    fan.hasTwin = this->hasTwin(list, fan.normal, spacing);
    fan.spacing = std::clamp(this->spacingOfSheet(list, fan.normal), spacing, kMostOfAll * spacing);
  }

  /// Finds the edges of a point. Neighbours of another sheet bound no cell: they would end the edges across a
  /// hole on this one.
  void makeFan(const NeighborList& list)
  {
    Fan& fan = fans_[std::size_t(list.slot)];
    if (fan.spacing <= 0.0)
    {
      return;
    }
    // Points further away than half the last neighbour may have nearer ones that are not listed.
    const double known = 0.5 * std::sqrt(list.squaredDistances[list.count - 1]);
    TangentCell cell(fan.normal, std::max(kCellReach * fan.spacing, known));
    const auto isOfSheet = [&](int i)
    { return this->followsSurface(std::uint32_t(list.slot), std::uint32_t(list.slots[i])); };
    for (int i = 1; i < list.count; ++i)
    {
      if (isOfSheet(i) && !cell.add(laidFlat(this->offset(list, i), fan.normal)))
      {
        break;
      }
    }
    for (int i = 1; i < list.count && fan.size < kMostEdges; ++i)
    {
      if (cell.touches(laidFlat(this->offset(list, i), fan.normal)) && isOfSheet(i))
      {
        fan.ends[fan.size++] = std::uint32_t(list.slots[i]);
      }
    }
  }

  /// Whether the way from one to the other follows the surface: it leads through no thin plate, and across no
  /// gap.
  bool followsSurface(std::uint32_t first, std::uint32_t second) const
  {
    const Fan& a = fans_[first];
    const Fan& b = fans_[second];
    const Vec3 d = query_.point(second) - query_.point(first);
    const double length = norm(d);
    const double spacing = std::min(a.spacing, b.spacing);
    if (length <= 0.0 || length > kLongestFlat * spacing)
    {
      return false;
    }
    const auto leans = [&](const Fan& fan)
    { return std::asin(std::min(1.0, std::abs(dot(d, fan.normal)) / length)); };
    const double turn = std::acos(std::min(1.0, std::abs(dot(a.normal, b.normal))));
    const bool isFlat = std::max(leans(a), leans(b)) <= kFlat;
    return (isFlat || length <= kLongest * spacing) && leans(a) + leans(b) <= turn + kLean;
  }

  bool isSparse(std::uint32_t first, std::uint32_t second) const
  {
    return std::max(fans_[first].spacing, fans_[second].spacing) >= sparse_;
  }

  double sparse_;
  NeighborQuery query_;
  std::vector<Fan> fans_;
};

} // namespace

std::vector<Vec3> surfaceMidpoints(const PointView& points, double sparse, const Executor& executor)
{
  return Triangulation(points, sparse, executor).midpoints();
}

} // namespace pointhaptics
