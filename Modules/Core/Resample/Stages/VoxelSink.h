/// @file
/// Outputs of a partition's sums: means in the result, or accumulated sums for the next chunk.
#pragma once

#include "Core/Base/Buffer.h"
#include "Core/Base/Lattice.h"
#include "Core/Base/Vector3.h"
#include "Core/Resample/AttributeReducer.h"
#include "Core/Resample/Kernel/VoxelKernel.h"
#include "Core/Resample/VoxelResampler.h"

#include <cstdint>
#include <numeric>
#include <vector>

namespace pointhaptics
{
namespace simd
{

/// Sums over the points of a voxel of their offsets in it, in quanta.
struct VoxelSums
{
  std::uint64_t key;
  std::int64_t count;
  Int128 sums[3];
};

/// Accumulated sums: those of one voxel over the chunks so far.
struct AccumulatedSums
{
  std::uint64_t key;
  std::int64_t count;
  std::int64_t sums[3];
};

/// The accumulated sums of a partition: cells with packed sums, and in voxels the sums of overfull cells.
/// Second moments are kept with the cells; they exist only if covariances are wanted.
struct alignas(kApart) AccumulatedPartition
{
  std::size_t cellCount = 0; ///< The vectors may have more elements, which are unused.
  std::vector<std::uint32_t> cells;
  std::vector<PackedSums> packed;
  std::vector<SplitSecondMoments> splitSecondMoments;
  std::vector<AccumulatedSums> voxels;
  std::vector<AttributeReducer> attributes; ///< Of the cells, where attributes are summed with the points.
  std::int64_t points = 0;                  ///< In cells; as many or fewer are in their packed sums.

  void clear()
  {
    cellCount = 0;
    voxels.clear();
    attributes.clear();
    points = 0;
  }
  /// Frees memory that is mostly unused. The sums are dropped then: call it when they are no longer needed.
  void trim()
  {
    constexpr std::size_t kFewCells = 1024;
    if (packed.capacity() > 2 * cellCount + kFewCells)
    {
      *this = AccumulatedPartition();
    }
  }
  std::size_t bytes() const
  {
    return cells.capacity() * sizeof(std::uint32_t) + packed.capacity() * sizeof(PackedSums) +
      splitSecondMoments.capacity() * sizeof(SplitSecondMoments) +
      voxels.capacity() * sizeof(AccumulatedSums);
  }
};

/// The voxels of a partition, in ascending order.
struct PartitionVoxels
{
  CellMap map{};
  std::uint64_t firstKey = 0;
  const std::uint32_t* cells = nullptr;
  const PackedSums* sums = nullptr;
  const SplitSecondMoments* secondMoments = nullptr; ///< Or null.
  std::size_t size = 0;
};

/// Covariance of the points of a voxel, divided by their count, from exact integer sums in quanta.
SymMat3 covarianceOf(std::int64_t count, const Int128 sums[3], const SecondMoments& secondMoments,
  double quantum, const Vec3& spacing);

/// How sums become coordinates in a lattice with offsets of @p fractionBits bits, rounded to float or double.
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
    std::vector<std::size_t> attributeBytes = {}; ///< Of a voxel's tuple of each.
  };

  void prepare(std::size_t room, const Layout& layout, const Lattice& lattice, int fractionBits,
    OutputAllocator* allocator = nullptr);
  /// Room for attributes alone, of voxels that are written.
  void prepareAttributes(
    std::size_t room, const std::vector<std::size_t>& bytes, OutputAllocator* allocator = nullptr);
  /// Writes the voxels of a partition, or a batch of voxels, at @p offset.
  void write(const Kernels& kernels, std::size_t offset, const PartitionVoxels& voxels);
  void write(const Kernels& kernels, std::size_t offset, const MomentBatch<std::int64_t>& batch);
  /// Writes one voxel; second moments are null without covariances.
  void write(std::size_t offset, const VoxelSums& voxel, const SecondMoments* secondMoments);
  /// Copies what another arena of the same layout has.
  void write(std::size_t offset, const MeanArena& other, std::size_t size);

  Vec3 point(std::size_t voxel) const
  {
    return layout_.singlePrecision ? PointView(floats_, std::int64_t(voxel) + 1)[std::int64_t(voxel)]
                                   : PointView(doubles_, std::int64_t(voxel) + 1)[std::int64_t(voxel)];
  }
  /// Replaces the coordinates of a voxel's mean.
  void setPoint(std::size_t voxel, const Vec3& point)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const std::size_t to = 3 * voxel + std::size_t(axis);
      layout_.singlePrecision ? void(floats_[to] = float(point[axis])) : void(doubles_[to] = point[axis]);
    }
  }
  /// The coordinates from a voxel on, of the type that was asked for.
  void* pointsFrom(std::size_t voxel)
  {
    return layout_.singlePrecision ? static_cast<void*>(floats_ + 3 * voxel) : doubles_ + 3 * voxel;
  }
  const float* floats() const { return floats_; }
  const double* doubles() const { return doubles_; }
  const std::int64_t* counts() const { return counts_; }
  const std::uint64_t* keys() const { return keys_.data(); }
  const SymMat3* covariances() const { return covariances_; }
  std::size_t attributes() const { return attributes_.size(); }
  /// The tuples of an attribute from a voxel on.
  char* attribute(std::size_t attribute, std::size_t voxel) const
  {
    return attributes_[attribute].values + attributes_[attribute].bytes * voxel;
  }
  std::size_t attributeBytes(std::size_t attribute) const { return attributes_[attribute].bytes; }
  std::size_t bytes() const
  {
    const std::size_t ofAttributes = std::accumulate(attributes_.begin(), attributes_.end(), std::size_t(0),
      [](std::size_t sum, const Attribute& attribute) { return sum + attribute.own.bytes(); });
    return ofAttributes + ownFloats_.bytes() + ownDoubles_.bytes() + ownCounts_.bytes() + keys_.bytes() +
      ownCovariances_.bytes();
  }

private:
  struct Attribute
  {
    std::size_t bytes; ///< Of a tuple.
    char* values;
    Buffer<char> own;
  };
  void writeCovariances(const Kernels& kernels, std::size_t offset, const PartitionVoxels& voxels);

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
  std::vector<Attribute> attributes_;
};

} // namespace simd
} // namespace pointhaptics
