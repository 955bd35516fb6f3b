/// @file
/// Clouds, cells and frames for the tests of the surface fit.
#pragma once

#include "Core/Surface/SurfaceFit.h"

#include "RandomClouds.h"

#include "Unit/VoxelMeans.h"

#include <gtest/gtest.h>

#include <memory>
#include <utility>
#include <vector>

namespace pointhaptics
{
namespace trial
{

/// z = c0 + c1 x + c2 y + c3 xx + c4 xy + c5 yy in the given frame.
struct Quadric
{
  double c[6];
  double height(double x, double y) const
  {
    return c[0] + c[1] * x + c[2] * y + c[3] * x * x + c[4] * x * y + c[5] * y * y;
  }
};

/// @p n points of @p q at random, to @p halfWidth on either side.
inline std::vector<Vec3> sampled(
  const Quadric& q, const SurfaceFrame& frame, double halfWidth, int n, std::uint64_t seed)
{
  Random random(seed);
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i)
  {
    const double x = random.uniform(-halfWidth, halfWidth);
    const double y = random.uniform(-halfWidth, halfWidth);
    points.push_back(frame.toWorld({ x, y, q.height(x, y) }));
  }
  return points;
}

/// Voxel means of @p points with their covariances, and the levels above them.
inline CellPyramid resampled(const std::vector<Vec3>& points, double voxelSize)
{
  const PointView view(points.data(), std::int64_t(points.size()));
  LatticeSettings settings;
  settings.voxelSize = voxelSize;
  Lattice lattice;
  EXPECT_EQ(makeLattice(settings, transformedBounds(view, {}), lattice), Status::Ok);
  VoxelMeans means;
  EXPECT_EQ(voxelMeans(view, {}, lattice, true, means), Status::Ok);
  std::vector<Cell> cells(means.keys.size());
  for (std::size_t v = 0; v < cells.size(); ++v)
  {
    cells[v].mean = means.means[v];
    cells[v].count = double(means.counts[v]);
    cells[v].covariance = means.covariances[v];
  }
  CellPyramid pyramid;
  EXPECT_EQ(pyramid.build(cells, voxelSize), Status::Ok);
  return pyramid;
}

inline SurfaceFrame frameAlong(const Vec3& normal, const Vec3& origin)
{
  SurfaceFrame frame;
  frame.origin = origin;
  frame.normal = normal;
  frame.a = anyPerpendicular(normal);
  frame.b = cross(normal, frame.a);
  return frame;
}

/// @param noise along the radius, standard deviation.
inline std::vector<Vec3> sphere(int n, double radius, std::uint64_t seed, double noise = 0.0)
{
  Random random(seed);
  std::vector<Vec3> points;
  for (int i = 0; i < n; ++i)
  {
    const Vec3 direction = random.direction();
    points.push_back((radius + noise * random.normal()) * direction);
  }
  return points;
}

/// The fit with memory of its own.
inline SurfaceFit fitOnce(const CellPyramid& pyramid, const SurfaceFrame& frame, const FitSettings& settings)
{
  const auto memory = std::make_unique<FitCells>();
  return pointhaptics::fitSurface(pyramid, frame, settings, *memory);
}

} // namespace trial
} // namespace pointhaptics
