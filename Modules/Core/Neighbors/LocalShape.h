/// @file
/// Shape of the surface at each point of a cloud, from its neighbours: spacing, flatness and normal.
#pragma once

#include "Core/Base/Executor.h"
#include "Core/Base/PointView.h"
#include "Core/Base/ProgressObserver.h"
#include "Core/Base/Status.h"
#include "Core/Neighbors/NeighborQuery.h"

#include <cstdint>
#include <vector>

namespace pointhaptics
{

/// The surface about one point.
struct PointShape
{
  /// Over the spacing: of points at random one gap in 100,000 is wider.
  static constexpr double kLargestReach = 2.2;

  /// Distance to the next points, as if they lay in a square grid on a plane, but less where the point is
  /// alone; 0: the point is not finite, or there is no other place. Unit of the coordinates.
  float spacing = 0.0F;
  /// Radius of discs about flat points that leave no gap between them, up to kLargestReach of the spacing; 0:
  /// the surface is not flat here, or ends. Points at random have gaps that their mean distance does not
  /// tell of.
  float reach = 0.0F;
  /// 1: the neighbours lie on a smooth surface. 0: on a line, in foliage, or too few.
  float flatness = 0.0F;
  /// Unit normal on either side; zero where the flatness of all neighbours is 0.
  float normal[3] = { 0.0F, 0.0F, 0.0F };
};

/// The surface about each point of a cloud.
struct LocalShape
{
  std::vector<PointShape> points; ///< One for each point of the cloud, in its order.
  double medianSpacing = 0.0;
  double meanFlatness = 0.0;
  /// Median distance of flat neighbourhoods from their plane (root mean square) over the spacing.
  double noise = 0.0;
  int numberOfNeighbors = 0;

  /// The shape of point @p i; that of nothing known where nothing was measured.
  const PointShape& at(std::int64_t i) const
  {
    static const PointShape unknown;
    return points.empty() ? unknown : points[std::size_t(i)];
  }
};

/// Which neighbours are looked at.
struct LocalShapeSettings
{
  static constexpr int kFewest = 16;
  static constexpr int kMost = 48;
  /// Edge of a pixel in the unit of the coordinates; 0: not known. kFewest neighbours are looked at, or as
  /// many as a disc of five pixels' radius holds where those are more than 24, up to kMost; kFewest in any
  /// case where points are apart.
  double pixel = 0.0;
  /// 0: all points are measured. Else points within this distance of each other, in the unit of the
  /// coordinates, share the shape of one of them, whose neighbours are others that are measured; but spacing
  /// and reach are those among all points. For clouds of many points where a picture shows one.
  double apart = 0.0;
};

/// Measures all points of @p cloud. Points at the same place count once as neighbours. The spacing is
/// max(0.886 r4, 0.627 r8), r_k the distance to the k-th neighbour: 1 on average, within 10 %, where one
/// point a unit square lies at random, and 0.89 in a unit grid. The flatness is a product of three ramps: the
/// neighbourhood is thin (eigenvalues of its covariance l0/l1 from 0.35 down to 0.08), no line (l1/l2 from
/// 0.03 up to 0.12), and its normals agree (mean |n . n_j| from 0.55 up to 0.85); both it and the normal are
/// averaged over the nine nearest places. A point whose spacing is more than 2.5 times that of its
/// surroundings, the median of four of its farther neighbours, is alone: spacing, flatness and reach fall
/// with the square of the ratio. Independent of @p executor.
/// @param query built of @p cloud.
/// @return Empty: no point is finite. Aborted: @p observer said so. InvalidParameter: settings out of range.
/// Cost: O(n log n), on one core for 16 neighbours about 0.6 us a measured point on a plane, up to 1.2 us
/// where two sheets lie close; 1.5 us for 48; 116 bytes a measured point while it runs.
Status measureLocalShape(const PointView& cloud, const NeighborQuery& query,
  const LocalShapeSettings& settings, LocalShape& shape, const Executor& executor = {},
  ProgressObserver* observer = nullptr);

} // namespace pointhaptics
