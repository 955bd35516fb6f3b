#include "Benchmark/Resample/Expected.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace pointhaptics::bench::resample
{
namespace
{

constexpr double kRivalTolerance = 1e-3; // voxels
constexpr std::int64_t kVoxelsPerFault = 1000;
constexpr std::int64_t kPointsPerFault = 10000;

bool keyOf(const Lattice& lattice, const Vec3& p, std::uint64_t& key)
{
  const Vec3 u = lattice.continuousIndex(p);
  if (!lattice.contains(u))
  {
    return false;
  }
  key =
    lattice.key(std::int64_t(std::floor(u.x)), std::int64_t(std::floor(u.y)), std::int64_t(std::floor(u.z)));
  return true;
}

/// Half a unit in the last place of the float coordinate, in voxels, and the promised 2^-31.
double exactTolerance(const Lattice& lattice, const std::array<long double, 3>& mean, int axis)
{
  const double size = std::fabs(double(mean[std::size_t(axis)]));
  const double ulp = double(std::nextafter(float(size), INFINITY)) - double(float(size));
  // A mean that rounds onto its voxel's face is moved back by one unit.
  return 1.5 * ulp / lattice.spacing[axis] + 0x1p-31;
}

struct Comparison
{
  const ResampleAnswer& answer;
  const ExpectedMeans& expected;
  ComparedWith with;

  /// Which expected voxel output point @p i is the mean of; the number of voxels where it is none.
  std::size_t voxelOf(std::size_t i) const
  {
    if (with != ComparedWith::Means)
    {
      return std::min(i, expected.keys.size());
    }
    std::uint64_t key = 0;
    if (!keyOf(answer.lattice, place(i), key))
    {
      return expected.keys.size();
    }
    const auto found = std::lower_bound(expected.keys.begin(), expected.keys.end(), key);
    const bool isThere = found != expected.keys.end() && *found == key;
    return isThere ? std::size_t(found - expected.keys.begin()) : expected.keys.size();
  }
  Vec3 place(std::size_t i) const
  {
    const double* p = &answer.xyz[3 * i];
    return { p[0], p[1], p[2] };
  }
  /// False: the place or the count is wrong.
  bool agrees(std::size_t i, std::size_t voxel, double& worst) const
  {
    bool right = answer.counts.empty() || answer.counts[i] == expected.counts[voxel];
    if (with == ComparedWith::TheirVoxels)
    {
      std::uint64_t key = 0;
      return right && keyOf(answer.lattice, place(i), key) && key == expected.keys[voxel];
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      const long double mean = expected.means[voxel][std::size_t(axis)];
      const double error =
        double(std::fabs(answer.xyz[3 * i + std::size_t(axis)] - mean)) / answer.lattice.spacing[axis];
      const double tolerance = with == ComparedWith::ExactMeans
        ? exactTolerance(answer.lattice, expected.means[voxel], axis)
        : kRivalTolerance;
      right = right && error <= tolerance;
      worst = std::max(worst, error);
    }
    return right;
  }
};

/// Where a point is at a face to within float rounding, its voxel may miss it.
std::int64_t allowedFaults(const ExpectedMeans& expected)
{
  const std::int64_t points =
    std::accumulate(expected.counts.begin(), expected.counts.end(), std::int64_t(0));
  return std::max<std::int64_t>(
    { 1, std::int64_t(expected.keys.size()) / kVoxelsPerFault, points / kPointsPerFault });
}

std::string textOf(const Verdict& verdict, const std::string& fault)
{
  if (!fault.empty())
  {
    return "wrong: " + fault;
  }
  if (verdict.wrongVoxels == 0)
  {
    return "right";
  }
  return fmt::format(
    "{}: {} voxels differ", verdict.right ? "right but for faces" : "wrong", verdict.wrongVoxels);
}

} // namespace

ExpectedMeans expectedMeans(const PointView& points, const Lattice& lattice)
{
  std::vector<std::pair<std::uint64_t, std::int64_t>> members;
  members.reserve(std::size_t(points.size()));
  for (std::int64_t i = 0; i < points.size(); ++i)
  {
    std::uint64_t key = 0;
    if (keyOf(lattice, points[i], key))
    {
      members.emplace_back(key, i);
    }
  }
  std::sort(members.begin(), members.end());
  ExpectedMeans result;
  for (std::size_t begin = 0, end = 0; begin < members.size(); begin = end)
  {
    const Vec3 first = points[members[begin].second];
    std::array<long double, 3> sum = { 0.0L, 0.0L, 0.0L };
    for (end = begin; end < members.size() && members[end].first == members[begin].first; ++end)
    {
      const Vec3 p = points[members[end].second];
      for (int axis = 0; axis < 3; ++axis)
      {
        sum[std::size_t(axis)] += (long double)(p[axis]) - (long double)(first[axis]);
      }
    }
    const auto count = (long double)(end - begin);
    result.keys.push_back(members[begin].first);
    result.counts.push_back(std::int64_t(end - begin));
    result.means.push_back({ first.x + sum[0] / count, first.y + sum[1] / count, first.z + sum[2] / count });
  }
  return result;
}

Verdict judge(const ResampleAnswer& answer, const ExpectedMeans& expected, ComparedWith with)
{
  Verdict verdict;
  verdict.voxels = std::int64_t(answer.xyz.size() / 3);
  verdict.expectedVoxels = std::int64_t(expected.keys.size());
  const Comparison comparison{ answer, expected, with };
  std::vector<bool> taken(expected.keys.size(), false);
  std::int64_t met = 0;
  for (std::size_t i = 0; i < answer.xyz.size() / 3; ++i)
  {
    const std::size_t voxel = comparison.voxelOf(i);
    if (voxel == expected.keys.size() || taken[voxel])
    {
      ++verdict.wrongVoxels;
      continue;
    }
    taken[voxel] = true;
    ++met;
    verdict.wrongVoxels += !comparison.agrees(i, voxel, verdict.worstError);
  }
  verdict.wrongVoxels += verdict.expectedVoxels - met;
  const std::int64_t allowed = with == ComparedWith::Means ? allowedFaults(expected) : 0;
  verdict.right = answer.fault.empty() && verdict.wrongVoxels <= allowed;
  verdict.text = textOf(verdict, answer.fault);
  return verdict;
}

} // namespace pointhaptics::bench::resample
