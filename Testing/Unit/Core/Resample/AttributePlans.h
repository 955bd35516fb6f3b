/// @file
/// Shared by the tests of attributes: the tuples of each voxel.
#pragma once

#include "Core/Base/ScalarType.h"
#include "Core/Resample/VoxelResampler.h"

#include "RandomClouds.h"

#include <gtest/gtest.h>

#include <algorithm>
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

/// Which voxel each tuple is in, -1: none, and in which order tuples are added.
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

/// How tuples are reduced beside the plan.
struct Reduction
{
  InstructionSet instructions = InstructionSet::Automatic;
  AffineTransform transform = {}; ///< Turns normals.
  std::int64_t chunkPoints = 0;
};

/// Tuples of the voxels of the plan: points are resampled that stand in the middle of their voxels, in the
/// order of the tuples.
inline std::vector<char> reducedTuples(
  const AttributeRequest& attribute, const Plan& plan, const Reduction& how = {})
{
  constexpr std::int64_t kRow = 16;
  const AffineTransform back = how.transform.inverse();
  std::vector<Vec3> points;
  for (const std::int64_t v : plan.voxels)
  {
    const Vec3 place(double(v % kRow), double(v / kRow % kRow), double(v / kRow / kRow));
    points.push_back(back.apply(place + Vec3(0.5, 0.5, v < 0 ? -99.0 : 0.5)));
  }
  VoxelRequest request;
  request.points = { points.data(), std::int64_t(points.size()) };
  request.lattice.dimensions = { kRow, kRow, 3 + plan.size / kRow / kRow };
  request.lattice.spacing = { 1, 1, 1 };
  request.transform = how.transform;
  request.attributes = { attribute };
  request.instructions = how.instructions;
  request.chunkPoints = how.chunkPoints;
  VoxelResampler resampler;
  EXPECT_EQ(resampler.run(request), Status::Ok);
  EXPECT_EQ(resampler.size(), plan.size);
  const auto* const tuples = static_cast<const char*>(resampler.attribute(0));
  return { tuples, tuples + plan.size * attribute.view.tupleBytes() };
}

/// Those of an array, taken in the order of the plan.
template <typename T>
std::vector<T> reducedValues(const std::vector<T>& values, int components, const Plan& plan,
  AttributeStatistic statistic = AttributeStatistic::Mean, const Reduction& how = {})
{
  const auto width = std::size_t(components);
  std::vector<T> ordered;
  Plan other = plan;
  other.voxels.clear();
  for (const std::int64_t i : plan.order)
  {
    const auto first = values.begin() + i * components;
    ordered.insert(ordered.end(), first, first + components);
    other.voxels.push_back(plan.voxels[std::size_t(i)]);
  }
  const AttributeView view = { ordered.data(), typeOf<T>(), components, std::int64_t(plan.order.size()) };
  const std::vector<char> bytes = reducedTuples({ view, statistic }, other, how);
  std::vector<T> reduced(std::size_t(plan.size) * width);
  std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char*>(reduced.data()));
  return reduced;
}

} // namespace trial
} // namespace pointhaptics
