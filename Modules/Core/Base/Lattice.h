/// @file
/// The regular lattice of voxels over the workspace, and the only definition of the floor index.
#pragma once

#include "Core/Base/PointView.h"
#include "Core/Base/SettingsMembers.h"
#include "Core/Base/Status.h"

#include <array>
#include <cstdint>
#include <tuple>

namespace pointhaptics
{

/// Voxels on one axis that a 64-bit key of three axes can hold (2^21).
constexpr std::int64_t kMaximumLatticeDimension = std::int64_t(1) << 21;
/// Voxels on each axis unless the user says otherwise (the paper's 300^3).
constexpr std::int64_t kDefaultLatticeDimension = 300;
/// Edge of the haptic workspace in metres: the paper's 10 cm cube.
constexpr double kDefaultWorkspaceEdge = 0.1;

/// Half-open voxels [origin + i spacing, origin + (i + 1) spacing), i from 0 to dimensions - 1 on each axis.
/// Units: those of the coordinates (metres in the workspace frame). Plain data: copy and read freely.
struct Lattice
{
  Vec3 origin;
  Vec3 spacing{ 1.0, 1.0, 1.0 };
  std::array<std::int64_t, 3> dimensions{ 1, 1, 1 };
  /// Upper end of the workspace as a continuous index, where it cuts through the last voxels.
  Vec3 end{ INFINITY, INFINITY, INFINITY };

  /// (x - origin) / spacing, in double.
  Vec3 continuousIndex(const Vec3& p) const noexcept
  {
    return { (p.x - origin.x) / spacing.x, (p.y - origin.y) / spacing.y, (p.z - origin.z) / spacing.z };
  }
  /// True where 0 <= u < dimensions and u < end on every axis; false for NaN.
  bool contains(const Vec3& continuous) const noexcept
  {
    return continuous.x >= 0.0 && continuous.x < double(dimensions[0]) && continuous.y >= 0.0 &&
      continuous.y < double(dimensions[1]) && continuous.z >= 0.0 && continuous.z < double(dimensions[2]) &&
      continuous.x < end.x && continuous.y < end.y && continuous.z < end.z;
  }
  /// The voxel of a continuous index. @pre contains() holds for it.
  static std::array<std::int64_t, 3> voxelAt(const Vec3& continuous) noexcept
  {
    return { std::int64_t(std::floor(continuous.x)), std::int64_t(std::floor(continuous.y)),
      std::int64_t(std::floor(continuous.z)) };
  }
  /// Linear index, x fastest. @pre contains() held for the continuous index these were floored from.
  std::uint64_t key(std::int64_t i, std::int64_t j, std::int64_t k) const noexcept
  {
    return std::uint64_t(i) +
      std::uint64_t(dimensions[0]) * (std::uint64_t(j) + std::uint64_t(dimensions[1]) * std::uint64_t(k));
  }
  std::array<std::int64_t, 3> indexOf(std::uint64_t key) const noexcept
  {
    const std::uint64_t nx = std::uint64_t(dimensions[0]);
    const std::uint64_t ny = std::uint64_t(dimensions[1]);
    return { std::int64_t(key % nx), std::int64_t((key / nx) % ny), std::int64_t(key / nx / ny) };
  }
  /// @p coordinate, which lies in voxel @p i of @p axis up to rounding, moved by single units in the last
  /// place until it does: a mean that is rounded to its voxel's upper face would belong to the next voxel.
  template <typename Real>
  Real keptInVoxel(Real coordinate, int axis, std::int64_t i) const noexcept
  {
    const auto voxel = [&](Real c) { return std::floor((double(c) - origin[axis]) / spacing[axis]); };
    for (int step = 0; step < 4 && voxel(coordinate) > double(i); ++step)
    {
      coordinate = std::nextafter(coordinate, Real(-INFINITY));
    }
    for (int step = 0; step < 4 && voxel(coordinate) < double(i); ++step)
    {
      coordinate = std::nextafter(coordinate, Real(INFINITY));
    }
    return coordinate;
  }
  Bounds bounds() const noexcept
  {
    Bounds box;
    box.include(origin);
    box.include({ origin.x + spacing.x * double(dimensions[0]), origin.y + spacing.y * double(dimensions[1]),
      origin.z + spacing.z * double(dimensions[2]) });
    return box;
  }
  /// Ok, InvalidWorkspace, InvalidVoxelSize, InvalidDimensions.
  Status check() const noexcept;
};

/// The user's settings of the lattice; makeLattice turns them into one.
struct LatticeSettings
{
  std::array<std::int64_t, 3> dimensions{ kDefaultLatticeDimension, kDefaultLatticeDimension,
    kDefaultLatticeDimension };
  double voxelSize = 0.0;         ///< Edge of a cubic voxel in metres; above 0 it overrides dimensions.
  bool automaticWorkspace = true; ///< A cube about the transformed cloud instead of workspace.
  Bounds workspace;               ///< Used when automaticWorkspace is false.

  static constexpr auto members()
  {
    using S = LatticeSettings;
    return std::make_tuple(settingsMember("dimensions", &S::dimensions,
                             { "--dims", "Voxels on each axis of the lattice; default 300", "N|Nx,Ny,Nz" }),
      settingsMember("voxelSize", &S::voxelSize,
        { "--voxel", "Edge of a cubic voxel, instead of --dims", "METRES", { 0.0, 1e300, true } }),
      settingsMember("automaticWorkspace", &S::automaticWorkspace), // cleared by --workspace
      settingsMember("workspace", &S::workspace,
        { "--workspace", "Box of the lattice; default: a cube about the transformed cloud",
          "x0,x1,y0,y1,z0,z1" }));
  }
};
static_assert(listsEveryMember<LatticeSettings>());

/// The paper's workspace: a cube of kDefaultWorkspaceEdge about the origin.
Bounds defaultWorkspace() noexcept;

/// The lattice for a cloud whose transformed, finite points lie in @p cloud (which may be empty).
/// An automatic workspace is a cube about the cloud, half a voxel (on its finest axis) wider on each side,
/// so that no point lies on a face; a cloud without extent, which one below 1e-290 is too, gets
/// kDefaultWorkspaceEdge, with voxelSize at most 1024 voxels, or 1e-6 of its coordinates if that is more.
/// With voxelSize the number of voxels is rounded up. Errors: InvalidWorkspace, InvalidDimensions,
/// InvalidVoxelSize, LatticeNotAddressable; @p lattice is then unchanged.
Status makeLattice(const LatticeSettings& settings, const Bounds& cloud, Lattice& lattice) noexcept;

/// The lattice whose voxels have their faces at whole multiples of @p spacing, as those of pcl::VoxelGrid and
/// of many map servers have, and which holds the points in @p cloud. @p first gets the multiple at which it
/// starts on each axis. Errors: InvalidWorkspace (an empty cloud, one that is not finite), InvalidVoxelSize,
/// LatticeNotAddressable (more than kMaximumLatticeDimension voxels on an axis, or coordinates of more than
/// 2^28 voxels); @p lattice is then unchanged.
Status alignedLattice(
  const Vec3& spacing, const Bounds& cloud, Lattice& lattice, std::array<std::int64_t, 3>& first) noexcept;

} // namespace pointhaptics
