#include "Core/Resample/Stages/VoxelWriter.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

namespace pointhaptics::simd
{
namespace
{

/// Covariance of the points of a voxel, divided by their count, from exact integer sums in quanta.
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
    rest[axis] = std::int64_t(std::uint64_t(sums[axis]) - std::uint64_t(m[axis]) * std::uint64_t(count));
  }
  const Vec3 unit = quantum * spacing;
  const auto moment = [&](int i, int a, int b)
  {
    const auto central = Int128(
      secondMoments.lanes[i] - UInt128(sums[b]) * std::uint64_t(m[a]) - UInt128(Int128(m[b]) * rest[a]));
    const double value = (toDouble(central) - double(rest[a]) * double(rest[b]) * perPoint) * perPoint;
    return (a == b ? std::max(value, 0.0) : value) * unit[a] * unit[b];
  };
  return { moment(0, 0, 0), moment(1, 1, 1), moment(2, 2, 2), moment(3, 0, 1), moment(4, 1, 2),
    moment(5, 0, 2) };
}

/// How sums become coordinates in a lattice with offsets of @p fractionBits bits, rounded to float or double.
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
    const double margin = singlePrecision
      ? 4.0 * (double(FLT_EPSILON) * largest + double(FLT_MIN) / lattice.spacing[axis])
      : 4.0 * (DBL_EPSILON * largest + DBL_MIN / lattice.spacing[axis]);
    map.margin[axis] = margin / map.quantum;
    map.clearance[axis] = std::max(1.0 - 2.0 * margin, 0.0) / map.quantum;
  }
  return map;
}

}

void VoxelWriter::prepare(const VoxelRequest& request, std::size_t room, int fractionBits)
{
  singlePrecision_ = request.singlePrecision;
  lattice_ = request.lattice;
  map_ = makeMeanMap(lattice_, fractionBits, singlePrecision_);
  OutputAllocator* const allocator = request.allocator;
  std::vector<std::size_t> bytes = { request.keys ? sizeof(std::uint64_t) : 0,
    keepsPoints(request.representative) ? sizeof(std::int64_t) : 0,
    3 * (singlePrecision_ ? sizeof(float) : sizeof(double)), sizeof(std::int64_t),
    request.covariances ? sizeof(SymMat3) : 0 };
  for (const AttributeRequest& attribute : request.attributes)
  {
    bytes.push_back(std::size_t(attribute.view.tupleBytes()));
  }
  arrays_.resize(bytes.size());
  for (std::size_t i = 0; i < bytes.size(); ++i)
  {
    Array& array = arrays_[i];
    const bool isPart = allocator && i >= kParts && bytes[i] > 0;
    void* const given = isPart ? allocator->allocate(i - kParts, room * bytes[i]) : nullptr;
    array.bytes = bytes[i];
    array.own.reserve(given ? 0 : room * bytes[i]);
    array.values = given ? static_cast<char*>(given) : array.own.data();
  }
}

template <typename Real>
void VoxelWriter::writeMeans(
  const Kernels& kernels, std::size_t offset, const PartitionVoxels& voxels, Real* xyz)
{
  int nearFace[kBatch];
  for (std::size_t first = 0; first < voxels.size; first += kBatch)
  {
    const int size = int(std::min<std::size_t>(voxels.size - first, kBatch));
    const std::uint32_t* cells = voxels.cells + first;
    const PackedSums* sums = voxels.sums + first;
    std::int64_t* to = counts() + offset + first;
    Real* means = xyz + 3 * (offset + first);
    const int found =
      kernels.of<Real>().packedMeans(map_, voxels.map, cells, sums, size, means, to, nearFace);
    for (int j = 0; j < found; ++j)
    {
      const auto index = lattice_.indexOf(voxels.firstKey + cells[nearFace[j]]);
      for (int axis = 0; axis < 3; ++axis)
      {
        Real& coordinate = means[3 * nearFace[j] + axis];
        coordinate = lattice_.keptInVoxel(coordinate, axis, index[std::size_t(axis)]);
      }
    }
  }
}

void VoxelWriter::write(const Kernels& kernels, std::size_t offset, const PartitionVoxels& voxels)
{
  singlePrecision_ ? writeMeans(kernels, offset, voxels, floats())
                   : writeMeans(kernels, offset, voxels, doubles());
  std::uint64_t* const to = keys() + offset;
  for (std::size_t i = 0; arrays_[kKeys].bytes > 0 && i < voxels.size; ++i)
  {
    to[i] = voxels.firstKey + voxels.cells[i];
  }
  for (std::size_t i = 0; arrays_[kCovariances].bytes > 0 && i < voxels.size; ++i)
  {
    const PackedSums& packed = voxels.sums[i];
    const Int128 sums[3] = { Int128(packed.lanes[0]), Int128(packed.lanes[1]), packedZ(packed) };
    covariances()[offset + i] =
      covarianceOf(packedCount(packed), sums, voxels.secondMoments[i], map_.quantum, lattice_.spacing);
  }
}

void VoxelWriter::write(std::size_t offset, const VoxelRun& run, std::size_t first, std::size_t last)
{
  std::array<std::int64_t, 3> index{};
  std::uint64_t row = 0;    // The first key of a row: only a new row takes divisions.
  std::uint64_t rowEnd = 0; // None before the first voxel.
  for (std::size_t v = first; v < last; ++v, ++offset)
  {
    const WideSums& voxel = run.voxels[v];
    if (voxel.key >= rowEnd)
    {
      index = lattice_.indexOf(voxel.key);
      row = voxel.key - std::uint64_t(index[0]);
      rowEnd = row + std::uint64_t(lattice_.dimensions[0]);
    }
    index[0] = std::int64_t(voxel.key - row);
    const Int128 sums[3] = { voxel.sum(0), voxel.sum(1), voxel.sum(2) };
    for (int axis = 0; axis < 3; ++axis)
    {
      const std::int64_t i = index[std::size_t(axis)];
      const double fraction = toDouble(sums[axis]) / double(voxel.count);
      double coordinate = map_.origin[axis] + (double(i) + fraction * map_.quantum) * map_.spacing[axis];
      const double above = fraction - map_.margin[axis];
      if (!(above >= 0.0 && above < map_.clearance[axis]))
      {
        coordinate = singlePrecision_ ? double(lattice_.keptInVoxel(float(coordinate), axis, i))
                                      : lattice_.keptInVoxel(coordinate, axis, i);
      }
      setCoordinate(offset, axis, coordinate);
    }
    counts()[offset] = voxel.count;
    if (arrays_[kKeys].bytes > 0)
    {
      keys()[offset] = voxel.key;
    }
    if (arrays_[kCovariances].bytes > 0)
    {
      covariances()[offset] =
        covarianceOf(voxel.count, sums, run.secondMoments[v], map_.quantum, lattice_.spacing);
    }
  }
}

} // namespace pointhaptics::simd
