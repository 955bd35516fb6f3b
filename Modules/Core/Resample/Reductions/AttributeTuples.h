/// @file
/// Modes and medians of the attributes of points, voxel by voxel.
#pragma once

#include "Core/Base/Buffer.h"
#include "Core/Resample/Kernel/VoxelKernel.h"
#include "Core/Resample/Reductions/AttributeReducer.h"
#include "Core/Resample/Stages/VoxelTally.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pointhaptics
{

/// Keeps the tuples of the points of each voxel, and finds the mode or the median of each component. Of
/// floating-point numbers all NaNs are one value, the largest, and both zeros are one, which is written as
/// +0; nothing depends on the order of the points.
///
/// Memory: the tuples themselves, and 8 bytes a voxel.
class AttributeTuples final : public AttributeReducer
{
public:
  /// @pre the statistic is Mode or Median
  explicit AttributeTuples(
    const AccumulatedArray& kind, InstructionSet instructions = InstructionSet::Automatic)
    : kind_(kind)
    , kernels_(&simd::kernelsFor(instructions))
  {
  }

  void prepare(const std::vector<std::int64_t>& counts) override;
  void add(const Tuples& tuples, const std::int64_t* numbers, const std::int64_t* voxels, int count) override;
  simd::VoxelTally takeTally() override;
  /// @pre each voxel has as many tuples as it was said to get.
  void write(const std::int64_t* counts, void* values) const override;

private:
  template <typename T, typename Components>
  void keepTuples(const Tuples& tuples, const std::int64_t* numbers, const std::int64_t* voxels, int count,
    Components components);
  std::int64_t voxels() const { return std::int64_t(ends_.size()); }
  /// Begin of a voxel's tuples. @pre all have been added.
  std::int64_t begin(std::int64_t voxel) const { return voxel == 0 ? 0 : ends_[std::size_t(voxel - 1)]; }
  std::int64_t end(std::int64_t voxel) const { return ends_[std::size_t(voxel)]; }
  /// Those of a component, of all points.
  template <typename T>
  T* values(int component) const
  {
    return reinterpret_cast<T*>(values_.data() + std::size_t(component) * componentBytes_);
  }
  template <typename T>
  void tallyValues(simd::TallyValues& to) const;
  template <typename T>
  void writeValues(T* to) const;

  AccumulatedArray kind_;
  const simd::Kernels* kernels_;
  Buffer<char> values_; ///< Those of a component together, and of these those of a voxel.
  std::size_t componentBytes_ = 0;
  std::vector<std::int64_t> ends_; ///< Where the next tuple of each voxel goes.
};

} // namespace pointhaptics
