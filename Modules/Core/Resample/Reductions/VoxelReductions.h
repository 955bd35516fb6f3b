/// @file
/// What else becomes of the points of voxels, next to their sums.
#pragma once

#include "Core/Resample/Kernel/PointRecordWriter.h"
#include "Core/Resample/Reductions/AttributeReducer.h"
#include "Core/Resample/Reductions/NearestPoints.h"
#include "Core/Resample/Reductions/NearestRecords.h"
#include "Core/Resample/Reductions/VoxelTally.h"
#include "Core/Resample/VoxelResampler.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace pointhaptics
{
namespace simd
{

/// The payload of the records of a request whose points are kept: the tuples that have room there, and
/// which are so read once, in the order of their memory; the number of the point where others, or the point
/// itself, are of use. Arrays are in the order of the attributes; last are the points, for medians.
PayloadLayout payloadLayoutOf(const VoxelRequest& request);

/// The attributes of voxels and the points that stand for them: of the voxels of a partition while its points
/// are summed, or of all by another pass.
class VoxelReductions
{
public:
  VoxelReductions() = default; ///< Nothing.
  /// What @p request asks for, which must outlive this. @pre the ranges of its attributes are known
  explicit VoxelReductions(const VoxelRequest& request);

  /// Drops all points and makes room for those of @p voxels, @p counts each, at most @p mostPoints. @p
  /// nearest points that are known may be null, else must outlive this.
  void prepare(const std::int64_t* counts, std::int64_t voxels, std::int64_t mostPoints,
    const Executor& executor = {}, const NearestRecords* nearest = nullptr);
  /// Whether anything is to be added.
  bool needsPoints() const { return !reducers_.empty() || (nearest_ && nearest_->needsPoints()); }
  /// Fetches what add() reads of points, in time for that; not of so many arrays.
  void fetch(const std::int64_t* points, int count, int without = 0) const;
  /// Adds points. Several threads may at once if no two have a voxel in common.
  void add(const std::int64_t* points, const std::int64_t* voxels, int count)
  {
    addPayloads({}, nullptr, points, voxels, count);
  }
  /// The same, of at most kBlockRecords points; tuples that are in @p payloads are taken from there.
  void addPayloads(const PayloadLayout& layout, const std::uint32_t* payloads, const std::int64_t* points,
    const std::int64_t* voxels, int count);
  /// Writes what becomes of the voxels, from @p first on in @p arena. @pre their means and counts are there.
  /// @return false where @p observer, which may be null, aborted the work.
  bool write(MeanArena& arena, std::size_t first, const Executor& executor = {},
    ProgressObserver* observer = nullptr) const;
  /// What the arrays have in the voxels, one for each; nothing is left here.
  std::vector<VoxelTally> takeTallies();

private:
  const VoxelRequest* request_ = nullptr;
  std::vector<AttributeView> views_; ///< What add() reads.
  std::vector<std::unique_ptr<AttributeReducer>>
    reducers_; ///< One for each attribute, one for median places.
  std::optional<NearestPoints> nearest_;
};

} // namespace simd
} // namespace pointhaptics
