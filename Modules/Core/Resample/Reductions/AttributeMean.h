/// @file
/// Means of the attributes of points, voxel by voxel, independent of the order of the points. Private to
/// Core.
#pragma once

#include "Core/Base/Vector3.h"
#include "Core/Resample/Reductions/AttributeReducer.h"
#include "Core/Resample/Reductions/VoxelTally.h"

#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace pointhaptics
{

/// Sums an attribute over the points of each voxel, exactly, and divides.
///
/// Numbers are summed as integers: floating-point ones in units of the last bit of the array's smallest, in
/// as many words of 64 bits as its largest magnitude and the most points of a voxel need. That is one for
/// most arrays of floats, two for those of doubles whose magnitudes differ by less than about 2^60. Sums are
/// exact, so a mean is within one rounding of the exact one (half a unit in the last place for the quotient,
/// as much for the sum), a lone point's is its value, and none depends on the order. A voxel with NaN or
/// infinities has the mean that IEEE addition would give. Memory: 8 bytes a voxel, component and word
/// (integers of up to 32 bits: one, of 64: two).
class AttributeMean final : public AttributeReducer
{
public:
  /// @pre @p range is rangeOf() the array as it is; means are wrong otherwise.
  AttributeMean(const AttributeView& view, const AttributeRange& range,
    InstructionSet instructions = InstructionSet::Automatic);
  AttributeMean(const AttributeView& view, const Executor& executor,
    InstructionSet instructions = InstructionSet::Automatic)
    : AttributeMean(view, rangeOf(view, executor, instructions), instructions)
  {
  }

  /// Has write() turn the means, of vectors of three numbers - mean.x times the first column and so on - and
  /// make unit vectors of them, those of integers as long as their mean; 0 where they have no direction, NaN
  /// where they are not finite.
  void turnVectors(const std::array<Vec3, 3>& columns) { columns_ = columns; }

  void prepare(const std::int64_t* counts, std::int64_t voxels, std::int64_t mostPoints,
    const Executor& executor) override;
  void addTuples(
    const Tuples& tuples, const std::int64_t* points, const std::int64_t* voxels, int count) override;
  simd::VoxelTally takeTally() override { return { std::move(sums_), {} }; }
  /// Integers are rounded to the nearest, halves away from zero.
  bool write(const std::int64_t* counts, void* means, const Executor& executor,
    ProgressObserver* observer) const override;
  /// The mean of a component of one voxel in double.
  double mean(std::int64_t voxel, int component, std::int64_t count) const
  {
    return sums_.mean(std::size_t(view_.components * voxel + component), count);
  }

  const AttributeView& view() const { return view_; }

private:
  template <typename Real>
  void addReals(const Tuples& tuples, const std::int64_t* points, const std::int64_t* voxels, int count);
  template <typename Real>
  void addReal(Real value, std::size_t sum);

  AttributeRange range_;
  const simd::AttributeKernels* kernels_;
  std::optional<std::array<Vec3, 3>> columns_; ///< How vectors are turned.
  simd::TallySums sums_;
};

} // namespace pointhaptics
