/// @file
/// Means of the attributes of points, voxel by voxel, independent of the order of the points.
#pragma once

#include "Core/Base/Buffer.h"
#include "Core/Base/Vector3.h"
#include "Core/Resample/AttributeReducer.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace pointhaptics
{
namespace simd
{
__extension__ typedef __int128 Int128;
struct AttributeKernels;
struct WordSums;
}

/// Scans the values of a floating-point array once; integers need no range.
AttributeRange rangeOf(const AttributeView& view, const Executor& executor,
  InstructionSet instructions = InstructionSet::Automatic);

/// Sums an attribute over the points of each voxel, exactly, and divides.
///
/// Integers are summed as they are. Floating-point numbers are cut to fixed point, from the array's largest
/// magnitude down to the last bit of its smallest: in one part where sums of the most points of a voxel fit
/// 63 bits, as those of most arrays of floats do, else in parts of up to 40 bits: two for most arrays, more
/// where magnitudes differ by more than 2^50. Sums are exact, so a mean is within one rounding
/// of the exact one (half a unit in the last place for the quotient, as much for the sum), a lone point's is
/// its value, and none depends on the order. A voxel with NaN or infinities has the mean that IEEE addition
/// would give. Memory: 8 bytes a voxel, component and part (integers of up to 32 bits: one part, of 64: two).
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
  void add(const std::int64_t* points, const std::int64_t* voxels, int count) override;
  void regroup(const std::vector<std::int64_t>& parents, std::int64_t voxels) override;
  simd::VoxelTally tally() const override;
  /// Integers are rounded to the nearest, halves away from zero.
  bool write(const std::int64_t* counts, void* means, const Executor& executor,
    ProgressObserver* observer) const override;
  /// The mean of a component of one voxel in double.
  double mean(std::int64_t voxel, int component, std::int64_t count) const;

  const AttributeView& view() const { return view_; }
  const AttributeRange& range() const { return range_; }

private:
  static constexpr int kMostPartBits = 40;
  /// The most parts from the largest double to the last bit of the smallest, at 28 bits each.
  static constexpr int kMostLanes = 80;

  bool isFloating() const { return view_.type == ScalarType::Float || view_.type == ScalarType::Double; }
  void chooseParts();
  void clear(std::int64_t voxels, const Executor& executor);
  template <typename Integer>
  void addIntegers(const std::int64_t* points, const std::int64_t* voxels, int count);
  template <typename Real>
  void addReals(const std::int64_t* points, const std::int64_t* voxels, int count);
  template <typename Real>
  void addInParts(Real value, std::int64_t place);
  int exponentOf(int lane) const;
  bool sumsAreWords() const;
  simd::WordSums wordSums(const std::int64_t* counts, std::int64_t begin, std::int64_t end) const;
  const std::int64_t* lanes(std::int64_t voxel, int component) const
  {
    return sums_.data() + std::int64_t(lanes_) * (std::int64_t(view_.components) * voxel + component);
  }
  simd::Int128 integerSum(std::int64_t voxel, int component) const;
  double realSum(std::int64_t voxel, int component, int& exponent) const;

  AttributeView view_;
  std::optional<std::array<Vec3, 3>> columns_; ///< How vectors are turned.
  const simd::AttributeKernels* kernels_;
  int lanes_ = 1; ///< Of 64 bits for each component.
  int partBits_ = 0;
  double scale_[2] = { 1.0, 1.0 }; ///< Both times a value give its first part, and what is left of it.
  AttributeRange range_;
  std::int64_t voxels_ = 0;
  std::int64_t mostPoints_ = 0;
  Buffer<std::int64_t> sums_;        ///< [voxel][component][lane]
  Buffer<NonFiniteCount> nonFinite_; ///< [voxel][component], where there are any.
};

} // namespace pointhaptics
