/// @file
/// What else becomes of the points of voxels, next to their sums.
#pragma once

#include "Core/Resample/AttributeReducer.h"
#include "Core/Resample/PointRows.h"
#include "Core/Resample/Stages/VoxelRepresentatives.h"
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

/// The attributes of voxels and the points that stand for them, from rows: for the voxels of a partition
/// while its points are summed, or for those of all levels by another pass.
class VoxelReductions
{
public:
  VoxelReductions() = default; ///< Nothing.
  /// What @p request asks for, which must outlive this. @pre its rows were chosen
  explicit VoxelReductions(const VoxelRequest& request);
  /// Has the rows of a request hold what its reductions need behind its own tuples: attributes, coordinates,
  /// and last the numbers of the points, for VoxelRequest::voxelIndex too. Finds the ranges of its
  /// attributes.
  static void chooseRows(VoxelRequest& request, const Executor& executor);

  bool empty() const { return reducers_.empty() && !representatives_; }

  /// Drops all points and makes room for those of @p voxels, @p counts each, at most @p mostPoints.
  void prepare(
    const std::int64_t* counts, std::int64_t voxels, std::int64_t mostPoints, const Executor& executor = {});
  /// See AttributeReducer. @pre no representatives
  void regroup(const std::vector<std::int64_t>& places, std::int64_t voxels, std::int64_t mostPoints);
  /// Several threads may add at once if no two have a voxel in common.
  void add(const PointRows& rows, const std::int64_t* voxels, int count);
  /// Writes what becomes of the voxels, from @p first on in @p arena. @pre their means and counts are there.
  /// @return false where @p observer, which may be null, aborted the work.
  bool write(MeanArena& arena, std::size_t first, const Executor& executor = {},
    ProgressObserver* observer = nullptr) const;

private:
  std::vector<std::unique_ptr<AttributeReducer>> reducers_; ///< One for each attribute.
  std::optional<VoxelRepresentatives> representatives_;
  std::size_t firstSource_ = 0; ///< Of the rows: the first attribute's.
};

} // namespace simd
} // namespace pointhaptics
