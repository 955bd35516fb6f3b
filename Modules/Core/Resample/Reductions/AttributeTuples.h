/// @file
/// Modes and medians of the attributes of points, voxel by voxel.
#pragma once

#include "Core/Base/Buffer.h"
#include "Core/Resample/AttributeView.h"
#include "Core/Resample/Kernel/VoxelKernel.h"
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
class AttributeTuples
{
public:
  /// Drops all tuples and makes room for those of voxels with @p counts points. @pre the statistic of the
  /// array is Mode or Median.
  void prepare(const AccumulatedArray& kind, const std::vector<std::int64_t>& counts);
  /// Adds tuple numbers[i] to voxels[i].
  void add(const simd::Tuples& tuples, const std::int64_t* numbers, const std::int64_t* voxels, int count);
  /// @pre each voxel has as many tuples as it was said to get.
  simd::TallyValues tally() const;
  void write(const simd::Kernels& kernels, void* to) const;

private:
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

  AccumulatedArray kind_;
  Buffer<char> values_; ///< Those of a component together, and of these those of a voxel.
  std::size_t componentBytes_ = 0;
  std::vector<std::int64_t> ends_; ///< Where the next tuple of each voxel goes.
};

} // namespace pointhaptics
