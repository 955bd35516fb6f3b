/// @file
/// The points of each voxel, together, and which of them stands for all.
#pragma once

#include "Core/Base/Buffer.h"
#include "Core/Resample/AttributeTuples.h"
#include "Core/Resample/Stages/VoxelSink.h"
#include "Core/Resample/VoxelResampler.h"

#include <cstdint>
#include <vector>

namespace pointhaptics
{
namespace simd
{

/// Collects the points of consecutive voxels, and chooses for each. @pre the request's representative is not
/// Representative::Mean.
class VoxelRepresentatives
{
public:
  /// @p request must outlive this.
  explicit VoxelRepresentatives(const VoxelRequest& request);

  /// Drops all points and makes room for those of @p voxels, @p counts each.
  void prepare(const std::int64_t* counts, std::int64_t voxels);
  /// Keeps the points of rows with their coordinates and their number, and what the voxels are. Several
  /// threads may add at once if no two have a voxel in common.
  void add(
    const void* coordinates, const void* numbers, std::size_t stride, const std::int64_t* voxels, int count);
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

  template <typename Real>
  void keep(const char* xyz, const char* numbers, std::size_t stride, const std::int64_t* voxels, int count);
  Scale scaleOf(int bits) const;
  static Offset quantized(const Vec3& place, const Vec3& pivot, const Scale& scale);
  /// The middle of the voxel, and a short number near it: differences of coordinates from this are exact.
  struct Middle
  {
    Vec3 center;
    Vec3 pivot;
  };
  Middle middleOf(const MeanArena& arena, std::size_t voxel) const;
  const Member& chosenOf(
    const Member* first, const Member* last, const MeanArena& arena, std::size_t voxel) const;
  const Member& exactlyChosenOf(const Member* first, const Member* last, const Middle& middle) const;
  bool goesBefore(const Member& a, const Member& b) const;

  const VoxelRequest* request_;
  bool isIdentity_;
  int exponent_;                   ///< Of the longest edge of a voxel, as a power of two.
  double unit_;                    ///< That power of two.
  Scale scale_;                    ///< Of voxels with few points.
  std::vector<std::int64_t> ends_; ///< Where the next point of each voxel goes.
  Buffer<Member> members_;
  AttributeTuples medians_;
};

} // namespace simd
} // namespace pointhaptics
