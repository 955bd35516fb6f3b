/// @file
/// Memory of output arrays.
#pragma once

#include "Core/Base/Buffer.h"
#include "Core/Resample/VoxelResampler.h"

#include "vtkDataArray.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <utility>
#include <vector>

namespace pointhaptics
{

/// The memory that the engine writes its results in, and that arrays then take over.
class OutputMemory : public OutputAllocator
{
public:
  void* allocate(std::size_t part, std::size_t bytes) override
  {
    parts_.resize(std::max(parts_.size(), part + 1));
    parts_[part].reset(); // first: memory may be short
    parts_[part] = newMemory(bytes);
    return parts_[part].get();
  }
  /// Gives @p array, of VTK's usual layout and with its components set, the results of a part as so many
  /// tuples.
  /// @pre the engine has written them here.
  void take(std::size_t part, vtkDataArray* array, std::int64_t tuples)
  {
    give(std::move(parts_[part]), array, tuples);
  }
  /// Gives @p array, as take() wants it, memory for so many tuples, not initialised.
  static void allocateFor(vtkDataArray* array, std::int64_t tuples)
  {
    give(newMemory(bytesOf(array, tuples)), array, tuples);
  }

private:
  struct Free
  {
    void operator()(void* memory) const { std::free(memory); }
  };
  using Memory = std::unique_ptr<void, Free>;

  static std::size_t bytesOf(vtkDataArray* array, std::int64_t tuples)
  {
    return std::size_t(tuples * array->GetNumberOfComponents() * array->GetDataTypeSize());
  }
  static Memory newMemory(std::size_t bytes) { return Memory(allocatePages(bytes + 1)); }
  static void give(Memory memory, vtkDataArray* array, std::int64_t tuples)
  {
    array->SetVoidArray(memory.release(), vtkIdType(tuples * array->GetNumberOfComponents()), 0,
      vtkAbstractArray::VTK_DATA_ARRAY_FREE);
  }

  std::vector<Memory> parts_; ///< Memory of each part, or null.
};

} // namespace pointhaptics
