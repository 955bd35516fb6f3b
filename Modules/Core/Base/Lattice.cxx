#include "Core/Base/Lattice.h"

#include <algorithm>

namespace pointhaptics
{
namespace
{

/// Smaller extents are none: of denormal numbers too few bits are left to part them.
constexpr double kSmallestExtent = 1e-290;
/// Voxels on an axis of the workspace invented for a cloud without extent, at most.
constexpr double kInventedVoxels = 1024.0;

/// Cube about the cloud with half a voxel to spare on each side, of the axis that has most of them.
Status automaticBounds(const LatticeSettings& settings, const Bounds& cloud, Bounds& box) noexcept
{
  const Vec3 center = cloud.empty() ? Vec3() : cloud.center();
  const Vec3 extent = cloud.empty() ? Vec3() : cloud.extent();
  double edge = std::max({ extent.x, extent.y, extent.z });
  const double coordinate = std::max({ std::abs(center.x), std::abs(center.y), std::abs(center.z) });
  if (!std::isfinite(edge) || !std::isfinite(coordinate))
  {
    return Status::InvalidWorkspace;
  }
  // An extent lost in the rounding of the coordinates is no extent.
  if (!(edge > std::max(1e-13 * coordinate, kSmallestExtent)))
  {
    const double invented = settings.voxelSize > 0.0
      ? std::min(kDefaultWorkspaceEdge, kInventedVoxels * settings.voxelSize)
      : kDefaultWorkspaceEdge;
    edge = std::max({ edge, invented, 1e-6 * coordinate });
  }
  const std::int64_t most =
    std::max({ settings.dimensions[0], settings.dimensions[1], settings.dimensions[2] });
  const double margin = settings.voxelSize > 0.0 ? 0.5 * settings.voxelSize
                                                 : 0.5 * edge / double(std::max<std::int64_t>(most - 1, 1));
  const double half = 0.5 * edge + margin;
  const Vec3 corner{ half, half, half };
  box.minimum = center - corner;
  box.maximum = center + corner;
  return Status::Ok;
}

}

Status Lattice::check() const noexcept
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!std::isfinite(origin[axis]))
    {
      return Status::InvalidWorkspace;
    }
    if (!(spacing[axis] > 0.0) || !std::isfinite(spacing[axis]))
    {
      return Status::InvalidVoxelSize;
    }
    if (dimensions[axis] < 1 || dimensions[axis] > kMaximumLatticeDimension)
    {
      return Status::InvalidDimensions;
    }
  }
  return Status::Ok;
}

Bounds defaultWorkspace() noexcept
{
  const double half = 0.5 * kDefaultWorkspaceEdge;
  return { { -half, -half, -half }, { half, half, half } };
}

Status makeLattice(const LatticeSettings& settings, const Bounds& cloud, Lattice& lattice) noexcept
{
  if (!std::isfinite(settings.voxelSize) || settings.voxelSize < 0.0)
  {
    return Status::InvalidVoxelSize;
  }
  for (std::int64_t n : settings.dimensions)
  {
    if (settings.voxelSize == 0.0 && (n < 1 || n > kMaximumLatticeDimension))
    {
      return Status::InvalidDimensions;
    }
  }
  Bounds box = settings.workspace;
  if (settings.automaticWorkspace)
  {
    const Status status = automaticBounds(settings, cloud, box);
    if (status != Status::Ok)
    {
      return status;
    }
  }
  Lattice made;
  made.origin = box.minimum;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double extent = box.maximum[axis] - box.minimum[axis];
    if (!(extent > 0.0) || !std::isfinite(extent))
    {
      return Status::InvalidWorkspace;
    }
    made.dimensions[axis] = settings.dimensions[axis];
    made.spacing[axis] = extent / double(settings.dimensions[axis]);
    if (settings.voxelSize > 0.0)
    {
      // A workspace that is a whole number of voxels up to rounding does not get one more.
      const double count = std::ceil(extent / settings.voxelSize * (1.0 - 1e-12));
      if (!(count <= double(kMaximumLatticeDimension)))
      {
        return Status::LatticeNotAddressable;
      }
      made.dimensions[axis] = std::max<std::int64_t>(1, std::int64_t(count));
      made.spacing[axis] = settings.voxelSize;
      if (!settings.automaticWorkspace)
      {
        made.end[axis] = extent / settings.voxelSize;
      }
    }
  }
  const Status status = made.check();
  if (status == Status::Ok)
  {
    lattice = made;
  }
  return status;
}

Status alignedLattice(
  const Vec3& spacing, const Bounds& cloud, Lattice& lattice, std::array<std::int64_t, 3>& first) noexcept
{
  // Beyond, the corner would no longer be a multiple of a float's spacing in double.
  constexpr double kMostVoxelsFromOrigin = double(std::int64_t(1) << 28);
  Lattice made;
  std::array<std::int64_t, 3> start{};
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto a = std::size_t(axis);
    const double edge = spacing[axis];
    if (!(edge > 0.0) || !std::isfinite(edge))
    {
      return Status::InvalidVoxelSize;
    }
    const double low = std::floor(cloud.minimum[axis] / edge);
    const double high = std::floor(cloud.maximum[axis] / edge);
    if (!(low <= high) || !std::isfinite(cloud.minimum[axis]) || !std::isfinite(cloud.maximum[axis]))
    {
      return Status::InvalidWorkspace;
    }
    if (!(high - low < double(kMaximumLatticeDimension)) || std::abs(low) > kMostVoxelsFromOrigin ||
      std::abs(high) > kMostVoxelsFromOrigin)
    {
      return Status::LatticeNotAddressable;
    }
    start[a] = std::int64_t(low);
    made.origin[axis] = low * edge;
    made.spacing[axis] = edge;
    made.dimensions[a] = std::int64_t(high - low) + 1;
  }
  lattice = made;
  first = start;
  return Status::Ok;
}

} // namespace pointhaptics
