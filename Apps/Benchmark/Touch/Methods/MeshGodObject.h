/// @file
/// The god object of Zilles and Salisbury on a triangle mesh, one-sided: the truth that the touch of a cloud
/// is judged by.
#pragma once

#include "Benchmark/Touch/TouchMesh.h"

#include <array>
#include <memory>

namespace pointhaptics::bench::touch
{

/// The triangles of a mesh in a tree of boxes. Read only after construction; any thread. Metres.
class TriangleTree
{
public:
  struct Facet
  {
    Vec3 corner[3];
    Vec3 normal; ///< Unit, outward.
  };

  struct Hit
  {
    const Facet* facet = nullptr; ///< Null: nothing is in the way.
    double fraction = 1.0;        ///< Part of the way to the facet, with the clearance kept.
  };

  /// Triangles without area are left out.
  explicit TriangleTree(const TouchMesh& mesh);

  /// The first facet that a point meets from its front on the way from @p from by @p way. The point stops
  /// kClearance above it. A start up to @p margin metres behind a facet counts as in front of it.
  Hit cast(const Vec3& from, const Vec3& way, double margin) const;
  enum class Side
  {
    Any,
    Back
  };
  /// Whether the segment crosses a facet, from any side or from its back.
  bool isCrossed(const Vec3& from, const Vec3& to, Side side) const;

  const std::vector<Facet>& facets() const { return facets_; }

  /// Metres that a point keeps above what it met, against rounding.
  static constexpr double kClearance = 1e-7;

private:
  struct Node
  {
    Vec3 low;
    Vec3 high;
    int first = 0; ///< A leaf's facets. Else: the children are `first` and `first + 1`.
    int count = 0; ///< 0: no leaf.
  };

  void split(int node, int begin, int end);
  template <class Visitor>
  void visit(const Vec3& from, const Vec3& way, double margin, Visitor&& visitor) const;

  std::vector<Facet> facets_;
  std::vector<Node> nodes_;
};

struct GodObjectState
{
  Vec3 point; ///< On the surface; the HIP where free.
  bool contact = false;
  int planes = 0;                ///< Facets that hold it, at most three of them at once.
  std::array<Vec3, 3> normals{}; ///< Normals of these facets, unit, outward.
};

/// Goes from where it is towards the HIP along straight lines, and stops at facets met from their front. It
/// comes to rest at a local minimum of the distance to the HIP. Exact up to rounding: the clearance is taken
/// off the reported point. The tree must outlive it. One thread at a time.
class MeshGodObject
{
public:
  enum class Facets
  {
    OfClosedMesh,
    /// Each facet is there with both windings and is met from either side: a start behind a facet, however
    /// near, is in front of its twin.
    OfOpenMesh
  };

  explicit MeshGodObject(const TriangleTree& tree, Facets facets = Facets::OfClosedMesh);

  /// The next HIP is taken as free space.
  void reset() { placed_ = false; }
  GodObjectState step(const Vec3& hip);

private:
  struct Planes;
  bool descend(const Vec3& hip, Planes& planes, int& casts);

  const TriangleTree* tree_;
  double margin_;
  double releaseMargin_;
  Vec3 position_;
  bool placed_ = false;
};

} // namespace pointhaptics::bench::touch
