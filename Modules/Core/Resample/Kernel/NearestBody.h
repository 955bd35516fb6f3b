/// @file
/// Part of VoxelKernelBody.h: compares the distances of records to a place in their voxel.
#pragma once

#include "Core/Resample/Kernel/InFours.h"
#include "Core/Resample/Kernel/VoxelKernel.h"

namespace pointhaptics
{
namespace simd
{
namespace
{

void nearest(const NearestMap& map, const PointRecord* records, const std::int64_t* points,
  const std::int64_t* voxels, int count, NearestPoint* nearest)
{
  typedef float Floats __attribute__((vector_size(16), may_alias));
  typedef std::int32_t Ints __attribute__((vector_size(16)));
  // Copies, which no store can change.
  const int left = map.fractionBits - kNearestBits;
  const std::uint64_t mask = (std::uint64_t(1) << kNearestBits) - 1;
  const Floats scale = { map.scale[0], map.scale[1], map.scale[2], 0.0f };
  fromFourParts(count,
    [=](int i)
    {
      NearestPoint& to = nearest[voxels[i]];
      const PointRecord& r = records[i];
      const std::uint64_t z = (r.first & kLowMask) | ((r.second & kLowMask) << kLowBits);
      const Ints offset = { std::int32_t((r.first >> (kLowBits + left)) & mask),
        std::int32_t((r.second >> (kLowBits + left)) & mask), std::int32_t((z >> left) & mask), 0 };
      const Floats d =
        (__builtin_convertvector(offset, Floats) - reinterpret_cast<const Floats&>(to)) * scale;
      const Floats squares = d * d;
      const float distance = squares[0] + to.yz * (squares[1] + squares[2]);
      const float least = to.least;
      const float farther = distance > least ? distance : least;
      to.second = to.second < farther ? to.second : farther;
      to.least = distance < least ? distance : least;
      // Without a branch, which would be unpredictable: numbers that are not negative ascend as their bits
      // do.
      std::int32_t bits[2];
      __builtin_memcpy(&bits[0], &distance, sizeof distance);
      __builtin_memcpy(&bits[1], &least, sizeof least);
      to.point ^= (to.point ^ points[i]) & ((bits[0] - bits[1]) >> 31);
    });
}

}
} // namespace simd
} // namespace pointhaptics
