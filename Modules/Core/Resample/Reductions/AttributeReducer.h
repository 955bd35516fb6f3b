/// @file
/// One array on its way from the tuples of the points to those of the voxels.
#pragma once

#include "Core/Base/AffineTransform.h"
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
}

/// Columns that turn normals: the products of a normal's components with these are added.
std::array<Vec3, 3> normalColumns(const AffineTransform& transform);

/// Keeps what a statistic needs of the tuples of each voxel. Nothing it gives depends on the order of the
/// points.
class AttributeReducer
{
public:
  /// A statistic of an array, whose range is known. @p transform turns normals.
  static std::unique_ptr<AttributeReducer> create(
    const AttributeRequest& request, const AffineTransform& transform, InstructionSet instructions);
  virtual ~AttributeReducer() = default;

  /// Drops all tuples and makes room for those of voxels with @p counts points.
  virtual void prepare(const std::vector<std::int64_t>& counts) = 0;
  /// Where tuples lie.
  struct Tuples
  {
    const char* first;
    std::int64_t step; ///< Bytes from one to the next.
  };
  /// Adds tuple numbers[i] to voxels[i].
  virtual void add(
    const Tuples& tuples, const std::int64_t* numbers, const std::int64_t* voxels, int count) = 0;
  /// Takes the sums of the voxels, so that more can be added; nothing is left here.
  virtual simd::VoxelTally takeTally() = 0;
  /// Writes the tuples of all voxels, @p counts points each, in the array's own type.
  virtual void write(const std::int64_t* counts, void* values) const = 0;
};

} // namespace pointhaptics
