/// @file
/// Modes and medians of the attributes of points, voxel by voxel.
#pragma once

#include "Core/Base/Buffer.h"
#include "Core/Base/ScalarType.h"
#include "Core/Resample/Kernel/OrderedKey.h"
#include "Core/Resample/Kernel/VoxelKernel.h"
#include "Core/Resample/Reductions/AttributeReducer.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace pointhaptics
{

/// Keeps the tuples of the points of each voxel, and finds the mode or the median of each component. Of
/// floating-point numbers all NaNs are one value, the largest, and both zeros are one, which is written as
/// +0; nothing depends on the order of the points.
///
/// Memory: the tuples themselves, and 8 bytes a voxel.
class AttributeTuples : public AttributeReducer
{
public:
  /// @pre @p statistic is Mode or Median
  explicit AttributeTuples(const AttributeView& view, AttributeStatistic statistic = AttributeStatistic::Mode,
    InstructionSet instructions = InstructionSet::Automatic)
    : AttributeReducer(view)
    , statistic_(statistic)
    , kernels_(&simd::kernelsFor(instructions).attributes)
  {
  }

  void prepare(const std::int64_t* counts, std::int64_t voxels, std::int64_t mostPoints,
    const Executor& executor) override;
  void addTuples(
    const Tuples& tuples, const std::int64_t* points, const std::int64_t* voxels, int count) override;
  simd::VoxelTally takeTally() override;
  /// @pre each voxel has as many tuples as it was said to get.
  bool write(const std::int64_t* counts, void* values, const Executor& executor,
    ProgressObserver* observer) const override;

protected:
  /// Calls tupleOf(i) for @p count tuples of the voxels given, and keeps what it returns. @p components:
  /// those of the view, which the compiler may know.
  template <typename T, typename Components, typename TupleOf>
  void keepTuples(const std::int64_t* voxels, int count, Components components, const TupleOf& tupleOf)
  {
    // Copies, which no store can change.
    char* const to = values_.data();
    std::int64_t* const ends = ends_.data();
    const std::size_t apart = componentBytes_;
    for (int i = 0; i < count; ++i)
    {
      const auto& tuple = tupleOf(i);
      char* const first = to + sizeof(T) * std::size_t(ends[voxels[i]]++);
      for (int c = 0; c < components; ++c)
      {
        std::memcpy(first + apart * std::size_t(c), &tuple[c * std::ptrdiff_t(sizeof(T))], sizeof(T));
      }
    }
  }

private:
  std::int64_t voxels() const { return std::int64_t(ends_.size()); }
  /// Of its tuples. @pre all have been added.
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
  void writeValues(std::int64_t first, std::int64_t last, T* to) const;

  AttributeStatistic statistic_;
  const simd::AttributeKernels* kernels_;
  Buffer<char> values_; ///< Those of a component together, and of these those of a voxel.
  std::size_t componentBytes_ = 0;
  std::vector<std::int64_t> ends_; ///< Where the next tuple of each voxel goes.
};

} // namespace pointhaptics
