/// @file
/// Sums of the voxels of any lattice that can be addressed, and levels of coarser voxels made of them: plain,
/// in 128-bit integers.
#pragma once

#include "Core/AffineTransform.h"
#include "Core/Executor.h"
#include "Core/Kernel/VoxelKernel.h"
#include "Core/Lattice.h"
#include "Core/PointView.h"

#include <cstdint>
#include <vector>

namespace pointhaptics
{
namespace kernel
{

/// Sums over the points of a voxel of their places in it, in quanta.
struct VoxelSums
{
  std::uint64_t key;
  std::int64_t count;
  Int128 sums[3];
};

/// Voxels in ascending order of their keys. Seconds are empty unless asked for.
struct VoxelSumList
{
  int fractionBits = 0;
  std::vector<VoxelSums> voxels;
  std::vector<SecondSums> seconds;
};

/// Points this path takes at once.
constexpr std::int64_t kGeneralChunk = std::int64_t(1) << 18;

/// Adds a run of points to the voxels' sums by sorting them by key.
class GeneralAdder
{
public:
  GeneralAdder(const Placement& placement, const Lattice& lattice, bool seconds);
  /// @pre count <= kGeneralChunk
  void add(const PointView& points, std::int64_t first, std::int64_t count, const Executor& executor);
  VoxelSumList take() { return std::move(list_); }
  std::int64_t inside() const { return inside_; }
  std::int64_t invalid() const { return invalid_; }

private:
  struct Placed
  {
    std::uint64_t key;
    std::uint64_t place[3];
  };
  struct Entry
  {
    std::uint64_t key;
    std::uint64_t point;
  };
  void mergeEntries();

  Placement placement_;
  Lattice lattice_;
  bool withSeconds_;
  VoxelSumList list_;
  std::vector<Placed> placed_;
  std::vector<Entry> entries_;
  std::vector<Entry> otherEntries_;
  std::int64_t inside_ = 0;
  std::int64_t invalid_ = 0;
};

/// The lattice twice as coarse, from the same corner; one voxel has no coarser one and stays as it is.
Lattice coarserLattice(const Lattice& lattice);
/// Sums of the coarser lattice's voxels, exactly those of its points; @p parents: of each fine voxel, the
/// coarse one it lies in.
VoxelSumList coarserSums(const VoxelSumList& fine, const Lattice& fineLattice, const Lattice& coarseLattice,
  std::vector<std::int64_t>& parents);

} // namespace kernel
} // namespace pointhaptics
