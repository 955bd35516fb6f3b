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
  // Copies, which no store can change.
  const std::uint64_t mask = (std::uint64_t(1) << map.fractionBits) - 1;
  const double scale[3] = { map.scale[0], map.scale[1], map.scale[2] };
  fromFourParts(count,
    [=](int i)
    {
      NearestPoint& to = nearest[voxels[i]];
      const double x = (double(std::int64_t(xFraction(records[i], mask))) - to.target[0]) * scale[0];
      const double y = (double(std::int64_t(yFraction(records[i], mask))) - to.target[1]) * scale[1];
      const double z = (double(std::int64_t(zFraction(records[i], mask))) - to.target[2]) * scale[2];
      const double distance = x * x + to.yz * (y * y + z * z);
      const double least = to.least;
      const double farther = distance > least ? distance : least;
      to.second = to.second < farther ? to.second : farther;
      to.least = distance < least ? distance : least;
      // Without a branch, which would be unpredictable.
      to.point ^= (to.point ^ points[i]) & -std::int64_t(distance < least);
    });
}

}
} // namespace simd
} // namespace pointhaptics
