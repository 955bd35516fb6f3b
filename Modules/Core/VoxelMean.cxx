#include "Core/VoxelMean.h"

#include <algorithm>
#include <array>
#include <mutex>

namespace pointhaptics
{
namespace
{

__extension__ typedef __int128 Int128;

constexpr double kQuanta = 4294967296.0; // 2^32 per voxel
constexpr std::uint64_t kClipped = ~std::uint64_t(0);
constexpr std::uint64_t kInvalid = kClipped - 1;

struct Record
{
  std::uint64_t key;
  std::int64_t point;
};

std::uint64_t keyOf(const Vec3& point, const AffineTransform& transform, const Lattice& lattice)
{
  if (!isFinite(point))
  {
    return kInvalid;
  }
  const Vec3 u = lattice.continuousIndex(transform.apply(point));
  if (!lattice.contains(u))
  {
    return kClipped;
  }
  // Inside the lattice u is not negative: the cast is the floor.
  return lattice.key(std::int64_t(u.x), std::int64_t(u.y), std::int64_t(u.z));
}

/// Stable least-significant-digit radix sort by key; only the digits that differ anywhere are sorted by.
void sortByKey(std::vector<Record>& records)
{
  constexpr int kDigitBits = 11;
  constexpr std::size_t kDigits = std::size_t(1) << kDigitBits;
  std::uint64_t differing = 0;
  for (const Record& r : records)
  {
    differing |= r.key ^ records.front().key;
  }
  std::vector<Record> other(records.size());
  for (int shift = 0; shift < 64 && differing >> shift != 0; shift += kDigitBits)
  {
    if ((differing >> shift & (kDigits - 1)) == 0)
    {
      continue;
    }
    std::array<std::size_t, kDigits> offsets{};
    for (const Record& r : records)
    {
      ++offsets[r.key >> shift & (kDigits - 1)];
    }
    std::size_t sum = 0;
    for (std::size_t& offset : offsets)
    {
      const std::size_t here = offset;
      offset = sum;
      sum += here;
    }
    for (const Record& r : records)
    {
      other[offsets[r.key >> shift & (kDigits - 1)]++] = r;
    }
    records.swap(other);
  }
}

/// Sums of the offsets from a voxel's centre, in quanta; exact and so free of any order.
struct OffsetSums
{
  std::int64_t first[3] = { 0, 0, 0 };
  Int128 second[6] = { 0, 0, 0, 0, 0, 0 }; // in the order of SymMat3

  void add(const std::int64_t q[3], bool withSecond)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      first[axis] += q[axis];
    }
    if (withSecond)
    {
      second[0] += Int128(q[0]) * q[0];
      second[1] += Int128(q[1]) * q[1];
      second[2] += Int128(q[2]) * q[2];
      second[3] += Int128(q[0]) * q[1];
      second[4] += Int128(q[1]) * q[2];
      second[5] += Int128(q[0]) * q[2];
    }
  }
};

void quantizedOffset(const Vec3& u, const std::array<std::int64_t, 3>& index, std::int64_t q[3])
{
  for (int axis = 0; axis < 3; ++axis)
  {
    q[axis] = std::int64_t(std::llrint((u[axis] - double(index[std::size_t(axis)]) - 0.5) * kQuanta));
  }
}

Vec3 meanOf(
  const OffsetSums& sums, double count, const std::array<std::int64_t, 3>& index, const Lattice& lattice)
{
  Vec3 mean;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double offset = double(sums.first[axis]) / (count * kQuanta);
    const double rounded =
      lattice.origin[axis] + (double(index[std::size_t(axis)]) + 0.5 + offset) * lattice.spacing[axis];
    mean[axis] = lattice.keptInVoxel(rounded, axis, index[std::size_t(axis)]);
  }
  return mean;
}

/// (n S2 - S1 S1') / n^2, the difference taken exactly in integers as long as it fits, then scaled to metres.
SymMat3 covarianceOf(const OffsetSums& sums, std::int64_t count, const Vec3& spacing)
{
  const int rows[6] = { 0, 1, 2, 0, 1, 0 };
  const int columns[6] = { 0, 1, 2, 1, 2, 2 };
  double values[6];
  for (int i = 0; i < 6; ++i)
  {
    const Int128 product = Int128(sums.first[rows[i]]) * sums.first[columns[i]];
    double difference;
    if (count < (std::int64_t(1) << 31))
    {
      difference = double(Int128(count) * sums.second[i] - product);
    }
    else
    {
      difference = double(count) * double(sums.second[i]) - double(product);
    }
    values[i] = difference / (double(count) * double(count) * kQuanta * kQuanta) * spacing[rows[i]] *
      spacing[columns[i]];
  }
  return { values[0], values[1], values[2], values[3], values[4], values[5] };
}

/// Turns the sorted records into members and voxel ranges.
void groupRecords(const std::vector<Record>& records, VoxelMeans& result)
{
  result.members.resize(records.size());
  for (std::size_t i = 0; i < records.size(); ++i)
  {
    result.members[i] = records[i].point;
    if (i == 0 || records[i].key != records[i - 1].key)
    {
      result.keys.push_back(records[i].key);
      result.begin.push_back(std::int64_t(i));
    }
  }
  result.begin.push_back(std::int64_t(records.size()));
}

std::vector<Record> insideRecords(const PointView& points, const AffineTransform& transform,
  const Lattice& lattice, VoxelMeans& result, const Executor& executor)
{
  std::vector<std::uint64_t> keys(std::size_t(points.size()));
  forRange(executor, points.size(),
    [&](std::int64_t begin, std::int64_t end)
    {
      for (std::int64_t i = begin; i < end; ++i)
      {
        keys[std::size_t(i)] = keyOf(points[i], transform, lattice);
      }
    });
  std::vector<Record> records;
  for (const std::uint64_t key : keys)
  {
    result.invalidPoints += key == kInvalid;
    result.clippedPoints += key == kClipped;
  }
  records.reserve(keys.size() - std::size_t(result.invalidPoints + result.clippedPoints));
  for (std::size_t i = 0; i < keys.size(); ++i)
  {
    if (keys[i] < kInvalid)
    {
      records.push_back({ keys[i], std::int64_t(i) });
    }
  }
  return records;
}

}

Bounds transformedBounds(const PointView& points, const AffineTransform& transform, const Executor& executor)
{
  Bounds box;
  std::mutex mutex;
  forRange(executor, points.size(),
    [&](std::int64_t begin, std::int64_t end)
    {
      Bounds local;
      for (std::int64_t i = begin; i < end; ++i)
      {
        const Vec3 p = points[i];
        const Vec3 moved = transform.apply(p);
        if (isFinite(p) && isFinite(moved))
        {
          local.include(moved);
        }
      }
      if (!local.empty())
      {
        const std::lock_guard<std::mutex> lock(mutex);
        box.include(local.minimum);
        box.include(local.maximum);
      }
    });
  return box;
}

Status voxelMeans(const PointView& points, const AffineTransform& transform, const Lattice& lattice,
  bool withCovariances, VoxelMeans& result, const Executor& executor)
{
  result = VoxelMeans();
  const Status transformStatus = transform.check();
  if (transformStatus != Status::Ok)
  {
    return transformStatus;
  }
  const Status latticeStatus = lattice.check();
  if (latticeStatus != Status::Ok)
  {
    return latticeStatus;
  }
  result.lattice = lattice;
  {
    std::vector<Record> records = insideRecords(points, transform, lattice, result, executor);
    if (!records.empty())
    {
      sortByKey(records);
    }
    groupRecords(records, result);
  }

  result.means.resize(result.keys.size());
  result.covariances.resize(withCovariances ? result.keys.size() : 0);
  forRange(executor, std::int64_t(result.keys.size()),
    [&](std::int64_t first, std::int64_t last)
    {
      for (std::size_t v = std::size_t(first); v < std::size_t(last); ++v)
      {
        const auto index = lattice.indexOf(result.keys[v]);
        OffsetSums sums;
        for (std::int64_t m = result.begin[v]; m < result.begin[v + 1]; ++m)
        {
          const Vec3 moved = transform.apply(points[result.members[std::size_t(m)]]);
          std::int64_t q[3];
          quantizedOffset(lattice.continuousIndex(moved), index, q);
          sums.add(q, withCovariances);
        }
        result.means[v] = meanOf(sums, double(result.count(v)), index, lattice);
        if (withCovariances)
        {
          result.covariances[v] = covarianceOf(sums, result.count(v), lattice.spacing);
        }
      }
    });
  return Status::Ok;
}

} // namespace pointhaptics
