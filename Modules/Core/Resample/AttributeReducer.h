/// @file
/// One array on its way from the tuples of the points to those of the voxels.
#pragma once

#include "Core/Base/AffineTransform.h"
#include "Core/Base/Executor.h"
#include "Core/Base/ProgressObserver.h"
#include "Core/Resample/AttributeView.h"
#include "Core/Simd/InstructionSet.h"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace pointhaptics
{

/// Keeps what a statistic needs of the tuples of each voxel. Nothing it gives depends on the order of the
/// points.
class AttributeReducer
{
public:
  /// A statistic of an array. @p transform turns normals.
  static std::unique_ptr<AttributeReducer> create(const AttributeRequest& request,
    const AffineTransform& transform, InstructionSet instructions, const Executor& executor);
  virtual ~AttributeReducer() = default;

  /// Drops all tuples and makes room for those of @p voxels, @p counts each (sums do without), at most @p
  /// mostPoints, at coarser levels too.
  virtual void prepare(
    const std::int64_t* counts, std::int64_t voxels, std::int64_t mostPoints, const Executor& executor) = 0;
  /// Adds the tuples of points of the array. Several threads may add at once if no two have a voxel in
  /// common.
  virtual void add(const std::int64_t* points, const std::int64_t* voxels, int count) = 0;
  /// What voxel i has goes to voxel parents[i] of @p voxels (VoxelResampler::parents()).
  virtual void regroup(const std::vector<std::int64_t>& parents, std::int64_t voxels) = 0;

  ///@{
  /// For another process, which has the rest of the array: what voxels @p first to before @p last have,
  /// appended to @p bytes. @pre of both: the same request, and mostPoints of prepare().
  virtual void serialize(std::int64_t first, std::int64_t last, std::string& bytes) const = 0;
  /// Adds what serialize() appended to @p voxels, which are as many. @return false for bytes that are not
  /// theirs, or more tuples than there is room for; what was added then is of no use.
  virtual bool merge(std::string_view bytes, const std::vector<std::int64_t>& voxels) = 0;
  ///@}

  /// Writes the tuples of all voxels, @p counts points each, in the array's own type. @return false where
  /// @p observer, which may be null, aborted the work.
  virtual bool write(
    const std::int64_t* counts, void* values, const Executor& executor, ProgressObserver* observer) const = 0;
};

} // namespace pointhaptics
