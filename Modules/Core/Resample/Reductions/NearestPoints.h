/// @file
/// Of the points of each voxel the one nearest to their mean, or to the voxel's centre, by their coordinates.
#pragma once

#include "Core/Base/Buffer.h"
#include "Core/Resample/Reductions/NearestRecords.h"
#include "Core/Resample/Stages/VoxelSink.h"
#include "Core/Resample/VoxelResampler.h"

#include <array>
#include <cstdint>
#include <vector>

namespace pointhaptics
{
namespace simd
{

/// Collects the points of consecutive voxels whose nearest point is not known, and chooses: see
/// Representative.
class NearestPoints
{
public:
  /// @p request must outlive this.
  explicit NearestPoints(const VoxelRequest& request);

  /// Drops all points and makes room for those of @p voxels, @p counts each; not of those whose nearest point
  /// is @p known, which may be null, else must outlive this.
  void prepare(const std::int64_t* counts, std::int64_t voxels, const NearestRecords* known);
  bool needsPoints() const { return needsPoints_; }
  /// Keeps points, of voxels that have room for them. Several threads may add at once if no two have a voxel
  /// in common.
  void add(const std::int64_t* points, const std::int64_t* voxels, int count);
  /// Replaces the means of the voxels from @p first on in @p arena by the nearest points, and writes the
  /// numbers of these. @return false where @p observer, which may be null, aborted the work.
  bool write(std::size_t first, MeanArena& arena, const Executor& executor, ProgressObserver* observer) const;

private:
  struct Member
  {
    Vec3 place; ///< Transformed.
    std::int64_t number;
  };
  using Offset = std::array<std::int64_t, 3>;
  /// Quanta in a unit of length: a product of two factors, as one could overflow.
  struct Scale
  {
    double factors[2];
    double most; ///< Of quanta: rounding of an ill-conditioned transform may put a point far from its voxel.

    Offset quantized(const Vec3& offset) const;
  };

  bool isKnown(std::size_t voxel) const { return known_ && known_->point(voxel) != NearestRecords::kUnknown; }
  const void* addressOf(std::int64_t point) const;
  Member memberOf(std::int64_t point) const;
  Scale scaleOf(int bits) const;
  Vec3 centerOf(std::uint64_t key) const;
  bool goesBefore(const Member& a, const Member& b) const;
  const Member& chosenOf(
    const Member* first, const Member* last, const MeanArena& arena, std::size_t voxel) const;

  const VoxelRequest* request_;
  bool toMean_;
  bool isIdentity_;
  int exponent_;                   ///< Of the longest edge of a voxel, as a power of two.
  Scale scale_;                    ///< Of voxels with few points.
  std::vector<std::int64_t> ends_; ///< Where the next point of each voxel goes.
  bool needsPoints_ = false;
  Buffer<Member> members_;
  const NearestRecords* known_ = nullptr;
};

} // namespace simd
} // namespace pointhaptics
