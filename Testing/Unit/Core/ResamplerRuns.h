/// @file
/// Results of a VoxelResampler, gathered for comparisons, and the exact answer for points on a grid of
/// quanta.
#pragma once

#include "Core/Resample/VoxelResampler.h"

#include "RandomClouds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace pointhaptics
{
namespace trial
{

/// The coarsest quantum of any lattice: points on multiples of it lose nothing where voxels have edge 1.
constexpr double kQuantum = 0x1p-31;

struct VoxelResult
{
  std::vector<double> means;
  std::vector<float> floats;
  std::vector<std::int64_t> counts;
  std::vector<std::uint64_t> keys;
  std::vector<SymMat3> covariances;
};

struct RunResult
{
  std::int64_t clipped = 0;
  std::int64_t invalid = 0;
  VoxelResult voxels;
};

inline VoxelResult voxelsOf(const VoxelResampler& resampler, const VoxelRequest& request)
{
  VoxelResult result;
  const std::int64_t size = resampler.size();
  result.counts.assign(resampler.counts(), resampler.counts() + size);
  if (request.singlePrecision)
  {
    result.floats.assign(resampler.floats(), resampler.floats() + 3 * size);
  }
  else
  {
    result.means.assign(resampler.doubles(), resampler.doubles() + 3 * size);
  }
  if (request.keys)
  {
    result.keys.assign(resampler.keys(), resampler.keys() + size);
  }
  if (request.covariances)
  {
    result.covariances.assign(resampler.covariances(), resampler.covariances() + size);
  }
  return result;
}

inline RunResult runOf(VoxelResampler& resampler, const VoxelRequest& request, const Executor& executor = {})
{
  EXPECT_EQ(resampler.run(request, executor), Status::Ok);
  return { resampler.clippedPoints(), resampler.invalidPoints(), voxelsOf(resampler, request) };
}

inline VoxelRequest requestFor(
  const std::vector<Vec3>& points, const Lattice& lattice, bool covariances = true)
{
  VoxelRequest request;
  request.points = view(points);
  request.lattice = lattice;
  request.keys = true;
  request.covariances = covariances;
  return request;
}

inline RunResult runOf(const VoxelRequest& request, const Executor& executor = {})
{
  VoxelResampler resampler;
  return runOf(resampler, request, executor);
}

inline void expectSameVoxels(const VoxelResult& a, const VoxelResult& b, const std::string& what)
{
  EXPECT_TRUE(sameBits(a.counts, b.counts)) << what;
  EXPECT_TRUE(sameBits(a.means, b.means)) << what;
  EXPECT_TRUE(sameBits(a.floats, b.floats)) << what;
  EXPECT_TRUE(sameBits(a.keys, b.keys)) << what;
  EXPECT_TRUE(sameBits(a.covariances, b.covariances)) << what;
}

inline void expectSame(const RunResult& a, const RunResult& b, const std::string& what)
{
  EXPECT_EQ(a.clipped, b.clipped) << what;
  EXPECT_EQ(a.invalid, b.invalid) << what;
  expectSameVoxels(a.voxels, b.voxels, what);
}

inline Lattice latticeOf(std::int64_t x, std::int64_t y, std::int64_t z)
{
  Lattice lattice;
  lattice.dimensions = { x, y, z };
  return lattice;
}

inline std::string nameOf(const Lattice& lattice)
{
  const auto& d = lattice.dimensions;
  return std::to_string(d[0]) + "x" + std::to_string(d[1]) + "x" + std::to_string(d[2]);
}

/// Lattices of unit voxels for each way through the kernels: cells side by side, sorted records, anything.
inline std::vector<Lattice> latticesOfAllPaths()
{
  return { latticeOf(300, 300, 300), latticeOf(5, 4, 3), latticeOf(4, 1, 1), latticeOf(1, 2, 257),
    latticeOf(1, 4096, 1), latticeOf(64, 3, 500), latticeOf(1024, 1024, 1024), latticeOf(2048, 2048, 300),
    latticeOf(4096, 4096, 4096), latticeOf(4096, 4096, 2), latticeOf(1, 1, 1), latticeOf(2, 2, 1),
    latticeOf(5000, 3, 2), latticeOf(2, 3, kMaximumLatticeDimension) };
}

/// Points on multiples of a quantum, a few of them outside.
inline std::vector<Vec3> quantisedPoints(
  std::size_t n, std::uint64_t seed, const Lattice& lattice, double quantum = kQuantum)
{
  Random random(seed);
  std::vector<Vec3> points(n);
  for (Vec3& p : points)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const double u = random.uniform(-0.001, 1.001) * double(lattice.dimensions[std::size_t(axis)]);
      p[axis] = double(std::int64_t(u * (1.0 / quantum))) * quantum;
    }
  }
  return points;
}

/// The exact sums of the points of a voxel, of their offsets in it in quanta.
class ExactVoxel
{
public:
  explicit ExactVoxel(const std::array<std::int64_t, 3>& index)
    : index_(index)
  {
  }
  void add(const Vec3& point)
  {
    Wide place[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      place[axis] = Wide((point[axis] - double(index_[std::size_t(axis)])) / kQuantum);
      first_[axis] += place[axis];
    }
    for (int m = 0; m < 6; ++m)
    {
      second_[m] += place[kRows[m]] * place[kColumns[m]];
    }
    ++count_;
  }
  std::int64_t count() const { return count_; }
  double mean(int axis) const
  {
    return double(
      (long double)index_[std::size_t(axis)] + (long double)first_[axis] / (long double)count_ * kQuantum);
  }
  /// In the order of SymMat3.
  double covariance(int m) const
  {
    const Wide central = second_[m] * count_ - first_[kRows[m]] * first_[kColumns[m]];
    return double((long double)central / (long double)count_ / (long double)count_) * kQuantum * kQuantum;
  }

private:
  __extension__ typedef __int128 Wide;
  static constexpr int kRows[6] = { 0, 1, 2, 0, 1, 0 };
  static constexpr int kColumns[6] = { 0, 1, 2, 1, 2, 2 };

  std::array<std::int64_t, 3> index_;
  std::int64_t count_ = 0;
  Wide first_[3] = { 0, 0, 0 };
  Wide second_[6] = { 0, 0, 0, 0, 0, 0 };
};

inline void expectExact(const ExactVoxel& exact, const VoxelResult& voxels, std::size_t v)
{
  ASSERT_EQ(voxels.counts[v], exact.count()) << "voxel " << v;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double expected = exact.mean(axis);
    ASSERT_NEAR(voxels.means[3 * v + std::size_t(axis)], expected, 4e-16 * (expected + 1.0)) << "voxel " << v;
  }
  if (voxels.covariances.empty())
  {
    return;
  }
  const SymMat3& c = voxels.covariances[v];
  const double got[6] = { c.xx, c.yy, c.zz, c.xy, c.yz, c.xz };
  for (int m = 0; m < 6; ++m)
  {
    const double expected = exact.covariance(m);
    ASSERT_NEAR(got[m], expected, 1e-15 * std::fabs(expected) + 1e-18) << "voxel " << v << " moment " << m;
  }
}

/// Compares with sums in integers of quanta. @pre unit voxels from the origin, quantised points.
inline void expectExact(const std::vector<Vec3>& points, const Lattice& lattice, const RunResult& result)
{
  std::vector<std::pair<std::uint64_t, std::size_t>> members;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (lattice.contains(points[i]))
    {
      const Vec3& p = points[i];
      members.emplace_back(lattice.key(std::int64_t(p.x), std::int64_t(p.y), std::int64_t(p.z)), i);
    }
  }
  std::sort(members.begin(), members.end());
  const VoxelResult& voxels = result.voxels;
  EXPECT_EQ(result.clipped, std::int64_t(points.size() - members.size()));
  std::size_t v = 0;
  for (std::size_t begin = 0; begin < members.size(); ++v)
  {
    const std::uint64_t key = members[begin].first;
    ExactVoxel exact(lattice.indexOf(key));
    for (; begin < members.size() && members[begin].first == key; ++begin)
    {
      exact.add(points[members[begin].second]);
    }
    ASSERT_LT(v, voxels.counts.size());
    ASSERT_EQ(voxels.keys[v], key);
    ASSERT_NO_FATAL_FAILURE(expectExact(exact, voxels, v));
  }
  EXPECT_EQ(v, voxels.counts.size());
}

} // namespace trial
} // namespace pointhaptics
