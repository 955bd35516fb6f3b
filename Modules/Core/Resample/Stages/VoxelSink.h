/// @file
/// What becomes of a partition's sums: the result's numbers, or sums to go on with.
#pragma once

#include "Core/Base/Buffer.h"
#include "Core/Base/Lattice.h"
#include "Core/Base/Vector3.h"
#include "Core/Resample/Kernel/VoxelKernel.h"
#include "Core/Resample/VoxelResampler.h"

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

/// Sums of one voxel over the chunks so far.
struct CarriedSums
{
  std::uint64_t key;
  std::int64_t count;
  std::int64_t sums[3];
};

/// Those of a partition. Where its cells' sums are kept side by side: cells with their packed sums, and in
/// voxels what these could not hold; otherwise voxels by key. Seconds go with the cells, split, or with the
/// voxels, and are there only if covariances are wanted.
struct alignas(kApart) CarriedPartition
{
  std::size_t cellCount = 0; ///< The vectors may have more elements: nothing is said of those.
  std::vector<std::uint32_t> cells;
  std::vector<PackedSums> packed;
  std::vector<SplitSeconds> splitSeconds;
  std::vector<CarriedSums> voxels;
  std::vector<SecondSums> seconds;
  std::int64_t points = 0; ///< In cells; as many or fewer are in their packed sums.

  std::size_t size() const { return cellCount == 0 ? voxels.size() : cellCount; }
  void clear()
  {
    cellCount = 0;
    voxels.clear();
    seconds.clear();
    points = 0;
  }
  /// When it is no longer needed: gives back memory that was mostly of no use.
  void trim()
  {
    constexpr std::size_t kFewCells = 1024;
    if (packed.capacity() > 2 * cellCount + kFewCells)
    {
      *this = CarriedPartition();
    }
  }
  std::size_t bytes() const
  {
    return cells.capacity() * sizeof(std::uint32_t) + packed.capacity() * sizeof(PackedSums) +
      splitSeconds.capacity() * sizeof(SplitSeconds) + voxels.capacity() * sizeof(CarriedSums) +
      seconds.capacity() * sizeof(SecondSums);
  }
};

/// The voxels of a partition, in ascending order.
struct PartitionVoxels
{
  CellMap map{};
  std::uint64_t firstKey = 0;
  const std::uint32_t* cells = nullptr;
  const PackedSums* sums = nullptr;
  const SplitSeconds* seconds = nullptr; ///< Or null.
  std::size_t size = 0;
};

/// Covariance of the points of a voxel, divided by their count, from exact integer sums in quanta.
SymMat3 covarianceOf(
  std::int64_t count, const Int128 sums[3], const SecondSums& seconds, double quantum, const Vec3& spacing);

/// How sums become coordinates in a lattice with places of @p fractionBits bits, rounded to float or double.
MeanMap makeMeanMap(const Lattice& lattice, int fractionBits, bool singlePrecision);

/// Means, counts and on request keys and covariances of active voxels, in the arena's own memory or, where
/// asked for, in the caller's.
class MeanArena
{
public:
  struct Layout
  {
    bool singlePrecision = false;
    bool keys = false;
    bool covariances = false;
  };

  void prepare(std::size_t room, const Layout& layout, const Lattice& lattice, int fractionBits,
    ResultMemory* memory = nullptr);
  /// Writes the voxels of a partition, or a batch of voxels, at @p place.
  void write(const Kernels& kernels, std::size_t place, const PartitionVoxels& voxels);
  void write(const Kernels& kernels, std::size_t place, const MomentBatch<std::int64_t>& batch);
  /// Writes one voxel; seconds are null without covariances.
  void write(std::size_t place, const VoxelSums& voxel, const SecondSums* seconds);
  /// Copies what another arena of the same layout has.
  void write(std::size_t place, const MeanArena& other, std::size_t size);

  const float* floats() const { return floats_; }
  const double* doubles() const { return doubles_; }
  const std::int64_t* counts() const { return counts_; }
  const std::uint64_t* keys() const { return keys_.data(); }
  const SymMat3* covariances() const { return covariances_; }
  std::size_t bytes() const
  {
    return ownFloats_.bytes() + ownDoubles_.bytes() + ownCounts_.bytes() + keys_.bytes() +
      ownCovariances_.bytes();
  }

private:
  void writeCovariances(const Kernels& kernels, std::size_t place, const PartitionVoxels& voxels);

  Layout layout_;
  Lattice lattice_;
  MeanMap map_{};
  float* floats_ = nullptr;
  double* doubles_ = nullptr;
  std::int64_t* counts_ = nullptr;
  SymMat3* covariances_ = nullptr;
  Buffer<float> ownFloats_;
  Buffer<double> ownDoubles_;
  Buffer<std::int64_t> ownCounts_;
  Buffer<SymMat3> ownCovariances_;
  Buffer<std::uint64_t> keys_;
};

/// Appends a batch to a partition that is carried over.
void carry(const Lattice& lattice, const MomentBatch<std::int64_t>& batch, CarriedPartition& partition);

} // namespace kernel
} // namespace pointhaptics
