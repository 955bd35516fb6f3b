/// @file
/// The point nearest to the mean or the centre of each voxel of a partition, as far as point records tell.
#pragma once

#include "Core/Base/Buffer.h"
#include "Core/Resample/Kernel/VoxelKernel.h"
#include "Core/Resample/Stages/VoxelSums.h"
#include "Core/Resample/VoxelResampler.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace pointhaptics
{
namespace simd
{

/// What the sums of a voxel are for this: its points, and their mean offset in it, in quanta.
struct MeanOffset
{
  std::int64_t count;
  double offset[3];

  static MeanOffset of(const PackedSums& sums)
  {
    const double perPoint = 1.0 / double(packedCount(sums));
    return { packedCount(sums),
      { double(std::int64_t(sums.lanes[0])) * perPoint, double(std::int64_t(sums.lanes[1])) * perPoint,
        double(packedZ(sums)) * perPoint } };
  }
  static MeanOffset of(const VoxelSums& voxel)
  {
    const auto count = double(voxel.count);
    return { voxel.count,
      { double(voxel.sums[0]) / count, double(voxel.sums[1]) / count, double(voxel.sums[2]) / count } };
  }
};

/// Compares the quantized distances of points, which are off by less than a known error. Where two are nearer
/// to each other than that, the nearest of the voxel is not known: their coordinates decide.
class NearestRecords
{
public:
  /// For records that @p quantizer makes. @p request: a nearest point is asked for.
  NearestRecords(const VoxelRequest& request, const PointQuantizer& quantizer);

  /// Drops all points. @p meanOf(i): the MeanOffset of voxel i.
  template <typename MeanOf>
  void prepare(std::size_t voxels, const MeanOf& meanOf)
  {
    voxels_ = voxels;
    nearest_.reserve(voxels, Pages::Huge);
    const double unit = std::ldexp(1.0, kNearestBits - map_.fractionBits);
    const auto middle = std::ldexp(0.5f, kNearestBits);
    for (std::size_t v = 0; v < voxels; ++v)
    {
      const MeanOffset mean = meanOf(v);
      // Two points are equally near to their mean: the one with the smaller x is chosen.
      const bool byX = toMean_ && mean.count == 2;
      const double factor = byX ? 0.0 : unit;
      const auto target = [&](int axis) { return toMean_ ? float(factor * mean.offset[axis]) : middle; };
      nearest_[v] = { { target(0), target(1), target(2) }, byX ? 0.0f : 1.0f, kFar, kFar, kUnknown };
    }
  }
  /// Compares the points of records, @p points, with others of their voxels.
  void add(const PointRecord* records, const std::int64_t* points, const std::int64_t* voxels, int count)
  {
    compare_(map_, records, points, voxels, count, nearest_.data());
  }
  /// Once all points are added.
  void finish();
  /// The number of the nearest point, or kUnknown.
  std::int64_t point(std::size_t voxel) const { return nearest_[voxel].point; }
  static constexpr std::int64_t kUnknown = -1;

private:
  static constexpr float kFar = 1e30f;

  bool toMean_;
  NearestMap map_;
  decltype(Kernels::nearest) compare_;
  double error_; ///< Of a distance.
  std::size_t voxels_ = 0;
  Buffer<NearestPoint> nearest_;
};

} // namespace simd
} // namespace pointhaptics
