#include "ProgressiveOrder.h"

#include "SmpExecutor.h"

#include "Core/Resample/VoxelMean.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace pointhaptics
{
namespace
{

constexpr int kDepth = 6; // levels of the octree
constexpr std::uint32_t kCubes = 1u << (3 * kDepth);

/// Spreads the low kDepth bits of @p value to every third bit.
std::uint32_t spread(std::uint32_t value)
{
  std::uint32_t result = 0;
  for (int bit = 0; bit < kDepth; ++bit)
  {
    result |= ((value >> bit) & 1u) << (3 * bit);
  }
  return result;
}

/// Place of the cube of @p p along the curve that visits every cube of the octree whole.
std::uint32_t cubeOf(const Vec3& p, const Bounds& bounds, double perEdge)
{
  std::uint32_t cube = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double cell = (p[axis] - bounds.minimum[axis]) * perEdge;
    const double limited = std::min(std::max(cell, 0.0), double((1 << kDepth) - 1));
    cube |= spread(std::isfinite(limited) ? std::uint32_t(limited) : 0u) << axis;
  }
  return cube;
}

/// The lowest @p bits of @p value, at most 32, in reverse.
std::uint64_t reversedBits(std::uint64_t value, int bits)
{
  value = (value >> 1 & 0x55555555u) | (value & 0x55555555u) << 1;
  value = (value >> 2 & 0x33333333u) | (value & 0x33333333u) << 2;
  value = (value >> 4 & 0x0f0f0f0fu) | (value & 0x0f0f0f0fu) << 4;
  value = (value >> 8 & 0x00ff00ffu) | (value & 0x00ff00ffu) << 8;
  value = value >> 16 | (value & 0xffffu) << 16;
  return value >> (32 - bits);
}

/// Indices in the order of the curve.
std::vector<std::uint32_t> alongCurve(const PointView& points)
{
  const SmpExecutor executor;
  const Bounds bounds = transformedBounds(points, AffineTransform(), executor);
  const Vec3 extent = bounds.empty() ? Vec3() : bounds.extent();
  const double longest = std::max({ extent.x, extent.y, extent.z });
  const double perEdge = longest > 0.0 ? double(1 << kDepth) / longest : 0.0;
  std::vector<std::uint32_t> cubes(std::size_t(points.size()));
  forRange(executor, points.size(),
    [&](std::int64_t begin, std::int64_t end)
    {
      for (; begin < end; ++begin)
      {
        cubes[std::size_t(begin)] = cubeOf(points[begin], bounds, perEdge);
      }
    });
  std::vector<std::int64_t> starts(std::size_t(kCubes) + 1, 0);
  for (const std::uint32_t cube : cubes)
  {
    ++starts[cube + 1];
  }
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  std::vector<std::uint32_t> order(cubes.size());
  for (std::size_t i = 0; i < cubes.size(); ++i)
  {
    order[std::size_t(starts[cubes[i]]++)] = std::uint32_t(i);
  }
  return order;
}

} // namespace

std::vector<std::uint32_t> progressiveOrder(const PointView& points)
{
  const std::vector<std::uint32_t> curve = alongCurve(points);
  const std::uint64_t size = curve.size();
  int bits = 0;
  while ((std::uint64_t(1) << bits) < size)
  {
    ++bits;
  }
  // Numbers with their bits reversed fill an interval evenly, however many of them are taken.
  std::vector<std::uint32_t> order;
  order.reserve(curve.size());
  for (std::uint64_t i = 0; i < std::uint64_t(1) << bits; ++i)
  {
    const std::uint64_t place = reversedBits(i, bits);
    if (place < size)
    {
      order.push_back(curve[place]);
    }
  }
  return order;
}

} // namespace pointhaptics
