/// @file
/// The points of each voxel, together, and which of them stands for all.
#pragma once

#include "Core/Base/Buffer.h"
#include "Core/Resample/AttributeTuples.h"
#include "Core/Resample/Stages/NearestRecords.h"
#include "Core/Resample/Stages/VoxelSink.h"
#include "Core/Resample/VoxelResampler.h"

#include <cstdint>
#include <vector>

namespace pointhaptics
{
namespace simd
{

/// Chooses for each of consecutive voxels. @pre the request's representative is not Representative::Mean.
class VoxelRepresentatives
{
public:
  /// @p request must outlive this.
  explicit VoxelRepresentatives(const VoxelRequest& request);

  /// Drops all points and makes room for those of @p voxels, @p counts each; not of those whose nearest point
  /// is @p known, which may be null, else must outlive this.
  void prepare(const std::int64_t* counts, std::int64_t voxels, const NearestRecords* known);
  bool needsPoints() const { return needsPoints_; }
  /// Keeps points, of voxels that have room for them. Several threads may add at once if no two have a voxel
  /// in common.
  void add(const std::int64_t* points, const std::int64_t* voxels, int count);
  /// Replaces the means of the voxels from @p first on in @p arena by the points that stand for them, and
  /// writes the numbers of these (not of medians). @return false where @p observer, which may be null,
  /// aborted the work.
  bool write(std::size_t first, MeanArena& arena, const Executor& executor, ProgressObserver* observer) const;

private:
  struct Member
  {
    Vec3 place; ///< Transformed.
    std::int64_t number;
  };
  /// Quanta in a unit of length: a product of two factors, as one could overflow.
  struct Scale
  {
    double factors[2];
    double most; ///< Of quanta: rounding of an ill-conditioned transform may put a point far from its voxel.
  };
  struct Offset
  {
    std::int64_t quanta[3];
  };

  const void* addressOf(std::int64_t point) const
  {
    const std::int64_t number = request_->points.stride() * point;
    return request_->points.floats() ? static_cast<const void*>(request_->points.floats() + number)
                                     : request_->points.doubles() + number;
  }
  Vec3 placeOf(std::int64_t point) const
  {
    return isIdentity_ ? request_->points[point] : request_->transform.apply(request_->points[point]);
  }
  template <typename Real>
  void addMedians(const std::int64_t* points, const std::int64_t* voxels, int count);
  Scale scaleOf(int bits) const;
  static Offset quantized(const Vec3& place, const Vec3& pivot, const Scale& scale);
  /// The middle of the voxel, and a short number near it: differences of coordinates from this are exact.
  struct Middle
  {
    Vec3 center;
    Vec3 pivot;
  };
  Middle middleOf(const MeanArena& arena, std::size_t voxel) const;
  const Member& chosenOf(std::int64_t v, const MeanArena& arena, std::size_t voxel) const;
  const Member& exactlyChosenOf(const Member* first, const Member* last, const Middle& middle) const;
  bool goesBefore(const Member& a, const Member& b) const;

  const VoxelRequest* request_;
  bool isIdentity_;
  int exponent_;                   ///< Of the longest edge of a voxel, as a power of two.
  double unit_;                    ///< That power of two.
  Scale scale_;                    ///< Of voxels with few points.
  std::vector<std::int64_t> ends_; ///< Where the next point of each voxel goes.
  Buffer<Member> members_;
  const NearestRecords* known_ = nullptr;
  bool needsPoints_ = true;
  AttributeTuples medians_;
};

} // namespace simd
} // namespace pointhaptics
