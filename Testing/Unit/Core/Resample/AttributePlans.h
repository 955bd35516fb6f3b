/// @file
/// Shared by the tests of attributes: the tuples of each voxel.
#pragma once

#include "Core/Base/ScalarType.h"

#include "RandomClouds.h"

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace pointhaptics
{
namespace trial
{

template <typename T>
ScalarType typeOf()
{
  if constexpr (std::is_floating_point_v<T>)
  {
    return sizeof(T) == 4 ? ScalarType::Float : ScalarType::Double;
  }
  else
  {
    const int width = sizeof(T) == 1 ? 0 : sizeof(T) == 2 ? 1 : sizeof(T) == 4 ? 2 : 3;
    return ScalarType(2 * width + (std::is_unsigned_v<T> ? 1 : 0));
  }
}

/// Which voxel each tuple is in, and in which order tuples are added.
struct Plan
{
  std::vector<std::int64_t> voxels;
  std::vector<std::int64_t> order;
  std::int64_t size = 1;
};

inline Plan planFor(std::size_t tuples, std::int64_t size, std::uint64_t seed)
{
  Plan plan;
  plan.size = size;
  trial::Random random(seed);
  for (std::size_t i = 0; i < tuples; ++i)
  {
    plan.voxels.push_back(
      i < std::size_t(size) ? std::int64_t(i) : std::int64_t(random.below(std::size_t(size))));
    plan.order.push_back(std::int64_t(i));
  }
  return plan;
}

inline std::vector<std::int64_t> countsOf(const Plan& plan)
{
  std::vector<std::int64_t> counts(std::size_t(plan.size), 0);
  for (const std::int64_t voxel : plan.voxels)
  {
    ++counts[std::size_t(voxel)];
  }
  return counts;
}

} // namespace trial
} // namespace pointhaptics
