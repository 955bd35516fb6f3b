#include "Core/Resample/Stages/VoxelSink.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

namespace pointhaptics
{
namespace simd
{
namespace
{

std::uint64_t keyOf(const Lattice& lattice, const MomentBatch<std::int64_t>& batch, int i)
{
  return lattice.key(batch.indices[0][i], batch.indices[1][i], batch.indices[2][i]);
}

/// Rounded once, as the compiler's own conversion of 128 bits is; nearly all values take the quick way.
double toDouble(Int128 value)
{
  constexpr std::int64_t kExact = std::int64_t(1) << 53;
  const auto high = std::int64_t(value >> 32);
  if (Int128(high) == value >> 32 && high > -kExact && high < kExact)
  {
    return double(high) * 0x1p32 + double(std::uint32_t(value));
  }
  return double(value);
}

/// Memory for a part of the result, from the caller's allocator or the arena's own.
template <typename T>
T* memoryFor(OutputAllocator::Part part, std::size_t count, OutputAllocator* allocator, Buffer<T>& own)
{
  if (allocator)
  {
    return static_cast<T*>(allocator->allocate(part, count * sizeof(T)));
  }
  own.reserve(count);
  return own.data();
}

template <typename Real>
void keepInVoxels(
  const Lattice& lattice, const MomentBatch<std::int64_t>& batch, const int* list, int size, Real* xyz)
{
  for (int j = 0; j < size; ++j)
  {
    const int i = list[j];
    for (int axis = 0; axis < 3; ++axis)
    {
      xyz[3 * i + axis] = lattice.keptInVoxel(xyz[3 * i + axis], axis, batch.indices[axis][i]);
    }
  }
}

template <typename Real>
void keepInVoxels(const Lattice& lattice, const PartitionVoxels& voxels, std::size_t first, const int* list,
  int size, Real* xyz)
{
  for (int j = 0; j < size; ++j)
  {
    const auto index = lattice.indexOf(voxels.firstKey + voxels.cells[first + std::size_t(list[j])]);
    for (int axis = 0; axis < 3; ++axis)
    {
      Real& coordinate = xyz[3 * list[j] + axis];
      coordinate = lattice.keptInVoxel(coordinate, axis, index[std::size_t(axis)]);
    }
  }
}

}

SymMat3 covarianceOf(std::int64_t count, const Int128 sums[3], const SecondMoments& secondMoments,
  double quantum, const Vec3& spacing)
{
  if (count == 1)
  {
    return {};
  }
  // About an integer m near the mean nothing is large, and what is left of the sums is small:
  // sums = count m + rest.
  const double perPoint = 1.0 / double(count);
  std::int64_t m[3];
  std::int64_t rest[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    m[axis] = std::int64_t(toDouble(sums[axis]) * perPoint);
    rest[axis] = std::int64_t(sums[axis] - Int128(m[axis]) * count);
  }
  const Vec3 unit = quantum * spacing;
  const auto moment = [&](int i, int a, int b)
  {
    const auto central =
      Int128(secondMoments.lanes[i] - UInt128(m[a]) * UInt128(sums[b]) - UInt128(Int128(m[b]) * rest[a]));
    const double value = (toDouble(central) - double(rest[a]) * double(rest[b]) * perPoint) * perPoint;
    return (a == b ? std::max(value, 0.0) : value) * unit[a] * unit[b];
  };
  return { moment(0, 0, 0), moment(1, 1, 1), moment(2, 2, 2), moment(3, 0, 1), moment(4, 1, 2),
    moment(5, 0, 2) };
}

MeanMap makeMeanMap(const Lattice& lattice, int fractionBits, bool singlePrecision)
{
  MeanMap map;
  map.quantum = std::ldexp(1.0, -fractionBits);
  for (int axis = 0; axis < 3; ++axis)
  {
    map.origin[axis] = lattice.origin[axis];
    map.spacing[axis] = lattice.spacing[axis];
    const double cells = double(lattice.dimensions[std::size_t(axis)]);
    const double largest = std::abs(lattice.origin[axis]) / lattice.spacing[axis] + cells;
    // A smallest normal number stands for what denormals lose.
    map.faceMargin[axis] = singlePrecision
      ? 4.0 * (double(FLT_EPSILON) * largest + double(FLT_MIN) / lattice.spacing[axis])
      : 4.0 * (DBL_EPSILON * largest + DBL_MIN / lattice.spacing[axis]);
  }
  return map;
}

void MeanArena::prepare(std::size_t room, const Layout& layout, const Lattice& lattice, int fractionBits,
  OutputAllocator* allocator)
{
  layout_ = layout;
  lattice_ = lattice;
  map_ = makeMeanMap(lattice, fractionBits, layout.singlePrecision);
  floats_ = nullptr;
  doubles_ = nullptr;
  covariances_ = nullptr;
  if (layout.singlePrecision)
  {
    floats_ = memoryFor(OutputAllocator::Part::Means, 3 * room, allocator, ownFloats_);
  }
  else
  {
    doubles_ = memoryFor(OutputAllocator::Part::Means, 3 * room, allocator, ownDoubles_);
  }
  counts_ = memoryFor(OutputAllocator::Part::Counts, room, allocator, ownCounts_);
  if (layout.covariances)
  {
    covariances_ = memoryFor(OutputAllocator::Part::Covariances, room, allocator, ownCovariances_);
  }
  if (layout.keys)
  {
    keys_.reserve(room);
  }
  prepareAttributes(room, layout.attributeBytes, allocator);
}

void MeanArena::prepareAttributes(
  std::size_t room, const std::vector<std::size_t>& bytes, OutputAllocator* allocator)
{
  attributes_.resize(bytes.size());
  for (std::size_t i = 0; i < bytes.size(); ++i)
  {
    Attribute& attribute = attributes_[i];
    attribute.bytes = bytes[i];
    void* given = allocator ? allocator->allocateAttribute(i, room * bytes[i]) : nullptr;
    if (!given)
    {
      attribute.own.reserve(room * bytes[i]);
    }
    attribute.values = given ? static_cast<char*>(given) : attribute.own.data();
  }
}

void MeanArena::write(std::size_t offset, const MeanArena& other, std::size_t size)
{
  const auto copy = [&](const auto* from, auto* to, std::size_t components)
  {
    if (from)
    {
      std::copy(from, from + components * size, to + components * offset);
    }
  };
  copy(other.floats_, floats_, 3);
  copy(other.doubles_, doubles_, 3);
  copy(other.counts_, counts_, 1);
  copy(other.covariances_, covariances_, 1);
  if (layout_.keys)
  {
    copy(other.keys_.data(), keys_.data(), 1);
  }
  for (std::size_t i = 0; i < attributes_.size(); ++i)
  {
    std::copy_n(other.attribute(i, 0), attributes_[i].bytes * size, attribute(i, offset));
  }
}

void MeanArena::write(const Kernels& kernels, std::size_t offset, const MomentBatch<std::int64_t>& batch)
{
  int nearFace[kBatch];
  if (layout_.singlePrecision)
  {
    float* xyz = floats_ + 3 * offset;
    keepInVoxels(lattice_, batch, nearFace, kernels.meansFloat(map_, batch, xyz, nearFace), xyz);
  }
  else
  {
    double* xyz = doubles_ + 3 * offset;
    keepInVoxels(lattice_, batch, nearFace, kernels.meansDouble(map_, batch, xyz, nearFace), xyz);
  }
  std::copy(batch.counts, batch.counts + batch.size, counts_ + offset);
  for (int i = 0; layout_.keys && i < batch.size; ++i)
  {
    keys_[offset + std::size_t(i)] = keyOf(lattice_, batch, i);
  }
  for (int i = 0; layout_.covariances && i < batch.size; ++i)
  {
    const Int128 sums[3] = { batch.sums[0][i], batch.sums[1][i], batch.sums[2][i] };
    covariances_[offset + std::size_t(i)] =
      covarianceOf(batch.counts[i], sums, batch.secondMoments[i], map_.quantum, lattice_.spacing);
  }
}

void MeanArena::write(const Kernels& kernels, std::size_t offset, const PartitionVoxels& voxels)
{
  int nearFace[kBatch];
  for (std::size_t first = 0; first < voxels.size; first += kBatch)
  {
    const int size = int(std::min<std::size_t>(voxels.size - first, kBatch));
    const std::uint32_t* cells = voxels.cells + first;
    const PackedSums* sums = voxels.sums + first;
    std::int64_t* counts = counts_ + offset + first;
    if (layout_.singlePrecision)
    {
      float* xyz = floats_ + 3 * (offset + first);
      const int found = kernels.packedMeansFloat(map_, voxels.map, cells, sums, size, xyz, counts, nearFace);
      keepInVoxels(lattice_, voxels, first, nearFace, found, xyz);
    }
    else
    {
      double* xyz = doubles_ + 3 * (offset + first);
      const int found = kernels.packedMeansDouble(map_, voxels.map, cells, sums, size, xyz, counts, nearFace);
      keepInVoxels(lattice_, voxels, first, nearFace, found, xyz);
    }
  }
  for (std::size_t i = 0; layout_.keys && i < voxels.size; ++i)
  {
    keys_[offset + i] = voxels.firstKey + voxels.cells[i];
  }
  if (layout_.covariances)
  {
    writeCovariances(kernels, offset, voxels);
  }
}

void MeanArena::writeCovariances(const Kernels& kernels, std::size_t offset, const PartitionVoxels& voxels)
{
  static_assert(sizeof(SymMat3) == 6 * sizeof(double), "six numbers, xx yy zz xy yz xz");
  const int fractionBits = voxels.map.fractionBits;
  const Vec3 unit = map_.quantum * lattice_.spacing;
  const CovarianceMap map = { fractionBits, { unit.x, unit.y, unit.z } };
  int full[kBatch];
  for (std::size_t first = 0; first < voxels.size; first += kBatch)
  {
    const int size = int(std::min<std::size_t>(voxels.size - first, kBatch));
    const PackedSums* packed = voxels.sums + first;
    const SplitSecondMoments* secondMoments = voxels.secondMoments + first;
    SymMat3* to = covariances_ + offset + first;
    const int found = kernels.covariances(map, packed, secondMoments, size, &to->xx, full);
    for (int j = 0; j < found; ++j)
    {
      const int i = full[j];
      const Int128 sums[3] = { Int128(packed[i].lanes[0]), Int128(packed[i].lanes[1]), packedZ(packed[i]) };
      to[i] = covarianceOf(
        packedCount(packed[i]), sums, whole(secondMoments[i], fractionBits), map_.quantum, lattice_.spacing);
    }
  }
}

void MeanArena::write(std::size_t offset, const VoxelSums& voxel, const SecondMoments* secondMoments)
{
  const auto index = lattice_.indexOf(voxel.key);
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::int64_t i = index[std::size_t(axis)];
    const double inVoxel = double(voxel.sums[axis]) / double(voxel.count) * map_.quantum;
    const double coordinate = map_.origin[axis] + (double(i) + inVoxel) * map_.spacing[axis];
    const std::size_t to = 3 * offset + std::size_t(axis);
    if (layout_.singlePrecision)
    {
      floats_[to] = lattice_.keptInVoxel(float(coordinate), axis, i);
    }
    else
    {
      doubles_[to] = lattice_.keptInVoxel(coordinate, axis, i);
    }
  }
  counts_[offset] = voxel.count;
  if (layout_.keys)
  {
    keys_[offset] = voxel.key;
  }
  if (layout_.covariances)
  {
    covariances_[offset] =
      covarianceOf(voxel.count, voxel.sums, *secondMoments, map_.quantum, lattice_.spacing);
  }
}

} // namespace simd
} // namespace pointhaptics
