/// @file
/// Memory of output arrays, reused once the arrays are deleted.
#pragma once

#include "Core/Resample/VoxelResampler.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

class vtkDataArray;

namespace pointhaptics
{

/// A filter makes arrays of much the same size at each update, and the first touch of fresh memory takes
/// longer than filling it. The pool gives arrays the memory of deleted ones. An array, and whatever shares
/// its buffer, may outlive the pool and be deleted in any thread. The engine writes its results in memory of
/// the pool, which arrays then take over.
class ArrayPool : public OutputAllocator
{
public:
  ArrayPool();
  ~ArrayPool() override;
  ArrayPool(const ArrayPool&) = delete;
  ArrayPool& operator=(const ArrayPool&) = delete;

  void* allocate(std::size_t part, std::size_t bytes) override;
  /// Gives @p array, of VTK's usual layout and with its components set, the @p results of a part as so many
  /// tuples: in the memory of the part, where they are there.
  void take(std::size_t part, vtkDataArray* array, std::int64_t tuples, const void* results);
  /// Gives @p array, as take() wants it, memory for so many tuples, not initialised.
  void allocateFor(vtkDataArray* array, std::int64_t tuples);
  /// Frees the memory that no array uses.
  void trim();
  /// Bytes that the pool keeps for later arrays.
  std::size_t bytes() const;

private:
  struct State;
  struct Header;
  struct GiveBack
  {
    void operator()(void* data) const;
  };
  /// Given back unless an array takes it.
  using Memory = std::unique_ptr<void, GiveBack>;

  Memory reserve(std::size_t bytes);
  static void give(Memory memory, vtkDataArray* array, std::int64_t tuples);

  std::shared_ptr<State> state_;
  std::vector<Memory> parts_; ///< Memory of each part, or null.
};

} // namespace pointhaptics
