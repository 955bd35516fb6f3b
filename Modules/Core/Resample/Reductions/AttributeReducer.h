/// @file
/// One array on its way from the tuples of the points to those of the voxels.
#pragma once

#include "Core/Base/AffineTransform.h"
#include "Core/Base/Executor.h"
#include "Core/Base/ProgressObserver.h"
#include "Core/Base/Vector3.h"
#include "Core/Resample/AttributeView.h"
#include "Core/Simd/InstructionSet.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace pointhaptics
{
namespace simd
{
class VoxelTally;
struct TallyValues;
}

/// What turns normals: the products of their components with these are added.
std::array<Vec3, 3> normalColumns(const AffineTransform& transform);

/// Keeps what a statistic needs of the tuples of each voxel. Nothing it gives depends on the order of the
/// points.
class AttributeReducer
{
public:
  /// A statistic of an array. @p transform turns normals.
  static std::unique_ptr<AttributeReducer> create(const AttributeRequest& request,
    const AffineTransform& transform, InstructionSet instructions, const Executor& executor);
  explicit AttributeReducer(const AttributeView& view)
    : view_(view)
  {
  }
  virtual ~AttributeReducer() = default;

  /// Drops all tuples and makes room for those of @p voxels, @p counts each (sums do without), at most @p
  /// mostPoints.
  virtual void prepare(
    const std::int64_t* counts, std::int64_t voxels, std::int64_t mostPoints, const Executor& executor) = 0;
  /// Where tuples lie.
  struct Tuples
  {
    const char* first;
    std::int64_t step; ///< Bytes from one to the next.
  };
  /// Adds the tuples of points of the array. Several threads may add at once if no two have a voxel in
  /// common.
  void add(const std::int64_t* points, const std::int64_t* voxels, int count)
  {
    addTuples({ static_cast<const char*>(view_.values), view_.step() }, points, voxels, count);
  }
  /// Adds tuples that lie elsewhere, of the same type.
  virtual void addTuples(
    const Tuples& tuples, const std::int64_t* points, const std::int64_t* voxels, int count) = 0;
  /// What the voxels have, for more to be added; nothing is left here.
  virtual simd::VoxelTally takeTally() = 0;

  /// Writes the tuples of all voxels, @p counts points each, in the array's own type. @return false where
  /// @p observer, which may be null, aborted the work.
  virtual bool write(
    const std::int64_t* counts, void* values, const Executor& executor, ProgressObserver* observer) const = 0;

protected:
  AttributeView view_;
};

} // namespace pointhaptics
