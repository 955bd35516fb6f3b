/// @file
/// One array on its way from the tuples of the points to those of the voxels.
#pragma once

#include "Core/Base/AffineTransform.h"
#include "Core/Base/Executor.h"
#include "Core/Base/ProgressObserver.h"
#include "Core/Base/Vector3.h"
#include "Core/Resample/AttributeMean.h"
#include "Core/Resample/AttributeTuples.h"
#include "Core/Resample/AttributeView.h"
#include "Core/Resample/PointRows.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace pointhaptics
{

/// Keeps the sums or the tuples of voxels: see isSum().
class AttributeReducer
{
public:
  AttributeReducer(const AttributeRequest& request, const AffineTransform& transform,
    InstructionSet instructions, const Executor& executor);

  /// The tuples that add() needs.
  static TupleSource sourceOf(const AttributeView& view);

  /// Drops all tuples and makes room for those of @p voxels, @p counts each, at most @p mostPoints.
  void prepare(
    const std::int64_t* counts, std::int64_t voxels, std::int64_t mostPoints, const Executor& executor = {});
  /// Adds tuples, each @p stride bytes after the one before. Several threads may add at once if no two have a
  /// voxel in common.
  void add(const void* tuples, std::size_t stride, const std::int64_t* voxels, int count);
  /// Of sums: voxel i becomes places[i] of @p voxels, of at most @p mostPoints points each by then.
  void spread(const std::vector<std::uint32_t>& places, std::int64_t voxels, std::int64_t mostPoints);
  /// For processes that share the points: see AttributeMean and AttributeTuples.
  void serialize(std::int64_t first, std::int64_t last, std::string& bytes) const
  {
    std::visit([&](const auto& ofVoxels) { ofVoxels.serialize(first, last, bytes); }, tuples_);
  }
  bool merge(std::string_view bytes, const std::vector<std::int64_t>& voxels)
  {
    return std::visit([&](auto& ofVoxels) { return ofVoxels.merge(bytes, voxels); }, tuples_);
  }
  /// Voxels become their parents: see VoxelResampler::parents().
  void coarsen(const std::vector<std::int64_t>& parents, std::int64_t voxels);
  /// Writes the tuples of all voxels, @p counts points each. @return false where @p observer, which may be
  /// null, aborted the work.
  bool write(
    const std::int64_t* counts, void* values, const Executor& executor, ProgressObserver* observer) const;

private:
  AttributeStatistic statistic_;
  Vec3 columns_[3]; ///< How normals are turned.
  std::variant<AttributeMean, AttributeTuples> tuples_;
};

} // namespace pointhaptics
