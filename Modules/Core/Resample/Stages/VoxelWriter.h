/// @file
/// From the sums of voxels to means in the result.
#pragma once

#include "Core/Base/Buffer.h"
#include "Core/Base/Lattice.h"
#include "Core/Base/Vector3.h"
#include "Core/Resample/Stages/VoxelRun.h"
#include "Core/Resample/VoxelResampler.h"

#include <array>
#include <cstdint>
#include <vector>

namespace pointhaptics::simd
{

/// The voxels of a partition, in ascending order.
struct PartitionVoxels
{
  CellMap map{};
  std::uint64_t firstKey = 0;
  const std::uint32_t* cells = nullptr;
  const PackedSums* sums = nullptr;
  const SecondMoments* secondMoments = nullptr; ///< Or null.
  std::size_t size = 0;
};

/// Means, counts and on request keys, covariances, chosen points and attributes of active voxels, an array
/// each: in the writer's own memory or, where asked for, in the caller's.
class VoxelWriter
{
public:
  /// Room for so many voxels of what is asked for.
  void prepare(const VoxelRequest& request, std::size_t room, int fractionBits);
  /// Writes the voxels of a partition, or voxels @p first to before @p last of a run, at @p offset.
  void write(const Kernels& kernels, std::size_t offset, const PartitionVoxels& voxels);
  void write(std::size_t offset, const VoxelRun& run, std::size_t first, std::size_t last);

  /// Replaces the coordinates of a voxel's mean.
  void setPoint(std::size_t voxel, const Vec3& point)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      setCoordinate(voxel, axis, point[axis]);
    }
  }
  /// The coordinates from a voxel on, of the type that was asked for.
  void* pointsFrom(std::size_t voxel) const { return arrays_[kMeans].values + arrays_[kMeans].bytes * voxel; }
  /// Null where the others were asked for.
  float* floats() const { return singlePrecision_ ? of<float>(kMeans) : nullptr; }
  double* doubles() const { return singlePrecision_ ? nullptr : of<double>(kMeans); }
  std::int64_t* counts() const { return of<std::int64_t>(kCounts); }
  SymMat3* covariances() const { return of<SymMat3>(kCovariances); }
  std::uint64_t* keys() const { return of<std::uint64_t>(kKeys); }
  /// Numbers of the points that stand for voxels.
  std::int64_t* chosen() const { return of<std::int64_t>(kChosen); }
  std::size_t attributes() const { return arrays_.size() - kAttributes; }
  /// The tuples of an attribute from a voxel on.
  char* attribute(std::size_t attribute, std::size_t voxel) const
  {
    return arrays_[kAttributes + attribute].values + arrays_[kAttributes + attribute].bytes * voxel;
  }

private:
  struct Array
  {
    std::size_t bytes = 0; ///< Bytes of a voxel; 0: not requested.
    char* values = nullptr;
    Buffer<char> own;
  };
  static constexpr std::size_t kKeys = 0;
  static constexpr std::size_t kChosen = 1;
  static constexpr std::size_t kParts = 2; ///< From here on those of OutputAllocator.
  static constexpr std::size_t kMeans = kParts + OutputAllocator::Means;
  static constexpr std::size_t kCounts = kParts + OutputAllocator::Counts;
  static constexpr std::size_t kCovariances = kParts + OutputAllocator::Covariances;
  static constexpr std::size_t kAttributes = kParts + OutputAllocator::Attributes;

  template <typename T>
  T* of(std::size_t array) const
  {
    return reinterpret_cast<T*>(arrays_[array].values);
  }
  void setCoordinate(std::size_t voxel, int axis, double x)
  {
    const std::size_t to = 3 * voxel + std::size_t(axis);
    singlePrecision_ ? void(floats()[to] = float(x)) : void(doubles()[to] = x);
  }
  template <typename Real>
  void writeMeans(const Kernels& kernels, std::size_t offset, const PartitionVoxels& voxels, Real* xyz);

  bool singlePrecision_ = false;
  Lattice lattice_;
  MeanMap map_{};
  std::vector<Array> arrays_ = std::vector<Array>(kAttributes);
};

} // namespace pointhaptics::simd
