/// @file
/// Means of the attributes of points, voxel by voxel, independent of the order of the points. Private to
/// Core.
#pragma once

#include "Core/Base/Vector3.h"
#include "Core/Resample/Reductions/AttributeReducer.h"
#include "Core/Resample/Stages/VoxelTally.h"

#include <array>
#include <cstdint>
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
/// as much for the sum), a lone point's is its value, and none depends on the order. NaN stands for no value:
/// it is left out, and where there is nothing else the mean is NaN. Infinities count as in IEEE addition.
/// Memory: 8 bytes a voxel, component and word (integers of up to 32 bits: one, of 64: two).
class AttributeMean final : public AttributeReducer
{
public:
  /// @pre @p range is that of all tuples; means are wrong otherwise. @p columns: what turns the means of
  /// AttributeStatistic::Normal.
  AttributeMean(
    const AccumulatedArray& kind, const AttributeRange& range, const std::array<Vec3, 3>& columns = {});

  void prepare(const std::vector<std::int64_t>& counts) override;
  void add(const Tuples& tuples, const std::int64_t* numbers, const std::int64_t* voxels, int count) override;
  simd::VoxelTally takeTally() override { return { std::move(sums_), {} }; }
  void write(const std::int64_t* counts, void* means) const override;

private:
  template <typename Real>
  void addReals(const Tuples& tuples, const std::int64_t* numbers, const std::int64_t* voxels, int count);
  template <typename Real>
  void addReal(Real value, std::size_t sum);

  AccumulatedArray kind_;
  AttributeRange range_;
  std::array<Vec3, 3> columns_;
  simd::TallySums sums_;
};

} // namespace pointhaptics
