#include "ProgressiveOrder.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

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

std::int64_t reversedBits(std::int64_t value, int bits)
{
  std::int64_t result = 0;
  for (int bit = 0; bit < bits; ++bit)
  {
    result |= ((value >> bit) & 1) << (bits - 1 - bit);
  }
  return result;
}

/// Indices in the order of the curve.
std::vector<std::uint32_t> alongCurve(const PointView& points)
{
  Bounds bounds;
  for (std::int64_t i = 0; i < points.size(); ++i)
  {
    const Vec3 p = points[i];
    if (isFinite(p))
    {
      bounds.include(p);
    }
  }
  const Vec3 extent = bounds.empty() ? Vec3() : bounds.extent();
  const double longest = std::max({ extent.x, extent.y, extent.z });
  const double perEdge = longest > 0.0 ? double(1 << kDepth) / longest : 0.0;
  std::vector<std::uint32_t> cubes(std::size_t(points.size()));
  std::vector<std::int64_t> starts(std::size_t(kCubes) + 1, 0);
  for (std::size_t i = 0; i < cubes.size(); ++i)
  {
    cubes[i] = cubeOf(points[std::int64_t(i)], bounds, perEdge);
    ++starts[cubes[i] + 1];
  }
  for (std::size_t cube = 0; cube < kCubes; ++cube)
  {
    starts[cube + 1] += starts[cube];
  }
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
  const auto size = std::int64_t(curve.size());
  int bits = 0;
  while ((std::int64_t(1) << bits) < size)
  {
    ++bits;
  }
  // Numbers with their bits reversed fill an interval evenly, however many of them are taken.
  std::vector<std::uint32_t> order;
  order.reserve(curve.size());
  for (std::int64_t i = 0; i < std::int64_t(1) << bits; ++i)
  {
    const std::int64_t place = reversedBits(i, bits);
    if (place < size)
    {
      order.push_back(curve[std::size_t(place)]);
    }
  }
  return order;
}

} // namespace pointhaptics
